eikonal_room(view SOURCES domains.cpp ground.cpp overlaps.cpp params.cpp picture.cpp plan.cpp rays.cpp view.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
