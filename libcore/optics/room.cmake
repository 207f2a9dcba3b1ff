eikonal_room(optics SOURCES air.cpp bands.cpp materials.cpp spectrum.cpp tracing.cpp)
