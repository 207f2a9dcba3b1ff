eikonal_room(base SOURCES atomic_file.cpp history.cpp input_file.cpp last_line.cpp resources.cpp
             standard_error.cpp text.cpp)
