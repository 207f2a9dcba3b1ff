eikonal_run(tutorial LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/tutorial/tutorial_test.sh ${CMAKE_BINARY_DIR})
