eikonal_test(test_imagespace SOURCES imagespace/exits_test.cpp imagespace/geometry_test.cpp imagespace/layers_test.cpp imagespace/picture_test.cpp LIBRARIES test_support)

eikonal_run(render_meshes LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/imagespace/render_meshes_test.sh
                                       ${CMAKE_BINARY_DIR})
