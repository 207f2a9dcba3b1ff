eikonal_room(optics SOURCES bands.cpp materials.cpp spectrum.cpp tracing.cpp)
