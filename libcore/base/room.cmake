eikonal_room(base SOURCES atomic_file.cpp history.cpp text.cpp)
