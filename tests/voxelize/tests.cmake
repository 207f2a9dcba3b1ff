eikonal_test(test_voxelize SOURCES voxelize/coverage_test.cpp)
# For the structs that facets share with the shaders.
target_include_directories(test_voxelize SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
