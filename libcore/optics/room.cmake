eikonal_room(optics SOURCES materials.cpp tracing.cpp)
