eikonal_room(voxelize SOURCES accept.cpp brick_distances.cpp coverage.cpp curve.cpp distances.cpp facets.cpp grids.cpp ground.cpp
                              insides.cpp mixer.cpp near_faces.cpp params.cpp plan.cpp voxelize.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
