eikonal_test(test_scenefile SOURCES scenefile/gltf_test.cpp scenefile/mtl_test.cpp)
eikonal_run(scene_files LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/scenefile/scene_test.sh ${CMAKE_BINARY_DIR})
