eikonal_room(optics SOURCES bands.cpp spectrum.cpp tracing.cpp)
