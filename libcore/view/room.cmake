eikonal_room(view SOURCES camera_ray.cpp domains.cpp ground.cpp overlaps.cpp params.cpp picture.cpp plan.cpp plate.cpp rays.cpp view.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
