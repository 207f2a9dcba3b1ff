eikonal_room(scene SOURCES bias.cpp block_table.cpp boundaries.cpp clearance.cpp crystal_field.cpp crystals.cpp distance_atlas.cpp
                           effects.cpp field.cpp files.cpp ground.cpp index.cpp objects.cpp object_sets.cpp
                           lights.cpp merge.cpp merge_light.cpp recorded_lights.cpp regions.cpp resample.cpp samples.cpp scene.cpp surface_light.cpp surface_voxels.cpp transport.cpp voxel_layout.cpp
                           voxel_textures.cpp
             SYSTEM_INCLUDES ${PROJECT_SOURCE_DIR}/shaders)
set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/scene/bias.cpp
                            ${CMAKE_CURRENT_SOURCE_DIR}/scene/samples.cpp PROPERTIES COMPILE_OPTIONS -O3
                            SKIP_PRECOMPILE_HEADERS ON)
