eikonal_room(view SOURCES background.cpp overlaps.cpp camera.cpp domains.cpp ground.cpp params.cpp pattern.cpp picture.cpp plan.cpp rays.cpp view.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
