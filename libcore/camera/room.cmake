eikonal_room(camera SOURCES background.cpp camera.cpp pattern.cpp)
