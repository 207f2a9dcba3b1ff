eikonal_room(imagespace SOURCES follow.cpp geometry.cpp imagespace.cpp params.cpp picture.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
