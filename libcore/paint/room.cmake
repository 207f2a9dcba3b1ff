eikonal_room(paint SOURCES noise.cpp paint.cpp strokes.cpp)
