eikonal_room(voxelize SOURCES accept.cpp coverage.cpp facets.cpp grids.cpp mixer.cpp params.cpp
                              plan.cpp voxelize.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
