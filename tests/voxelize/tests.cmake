eikonal_test(test_voxelize SOURCES voxelize/coverage_test.cpp voxelize/distances_test.cpp voxelize/near_faces_test.cpp voxelize/curve_test.cpp
                                   voxelize/scene_test.cpp voxelize/accept_test.cpp voxelize/sheet_test.cpp
                            LIBRARIES test_support LONG "Distances.OfAScanned*")
# For the structs that facets share with the shaders.
target_include_directories(test_voxelize SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
eikonal_run(mesh2vol_manners LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/voxelize/mesh2vol_test.sh ${CMAKE_BINARY_DIR})
