eikonal_room(lightsim SOURCES lightsim.cpp octree.cpp params.cpp photon_map.cpp plan.cpp
             plan_sharp.cpp upload.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
