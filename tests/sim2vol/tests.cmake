eikonal_test(test_sim2vol SOURCES sim2vol/laws_test.cpp sim2vol/plume_test.cpp LIBRARIES test_support)

eikonal_run(sim2vol_manners COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/sim2vol/sim2vol_test.sh
                                      ${CMAKE_BINARY_DIR})
