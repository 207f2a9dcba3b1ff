eikonal_room(lightsim SOURCES emission.cpp energy.cpp lights.cpp lightsim.cpp media.cpp octree.cpp params.cpp
                              photon_map.cpp photons.cpp plan.cpp receivers.cpp receiving.cpp voxels.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
