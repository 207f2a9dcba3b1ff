eikonal_room(medium SOURCES medium.cpp SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
