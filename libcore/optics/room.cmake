eikonal_room(optics SOURCES tracing.cpp)
