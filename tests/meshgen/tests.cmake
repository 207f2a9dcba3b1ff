eikonal_test(test_shapes SOURCES meshgen/solids_test.cpp meshgen/revolve_test.cpp
                                 meshgen/implicit_test.cpp meshgen/logo_test.cpp)

eikonal_run(meshgen_manners COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/meshgen/meshgen_test.sh
                                      ${CMAKE_BINARY_DIR})
