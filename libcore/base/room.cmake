eikonal_room(base SOURCES atomic_file.cpp history.cpp input_file.cpp text.cpp)
