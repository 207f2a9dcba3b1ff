eikonal_room(optics SOURCES air.cpp bands.cpp materials.cpp metal_fit.cpp spectrum.cpp tracing.cpp)
