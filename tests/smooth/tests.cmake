eikonal_test(test_smooth SOURCES smooth/smooth_test.cpp smooth/plan_test.cpp smooth/sides_test.cpp)

eikonal_run(volsmooth_manners COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/smooth/volsmooth_test.sh
                                        ${CMAKE_BINARY_DIR})
