eikonal_room(lightsim SOURCES aims.cpp beams.cpp bounces.cpp emission.cpp energy.cpp environment.cpp front_cells.cpp fronts.cpp
                              lightsim.cpp media.cpp octree.cpp opaque_surfaces.cpp params.cpp
                              photon_map.cpp photons.cpp plan.cpp points.cpp receivers.cpp receiving.cpp result.cpp scan.cpp sources.cpp
                              surfaces.cpp voxels.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
