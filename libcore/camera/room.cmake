eikonal_room(camera SOURCES background.cpp camera.cpp irradiance.cpp pattern.cpp)
