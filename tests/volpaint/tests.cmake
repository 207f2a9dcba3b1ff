eikonal_test(test_volpaint SOURCES volpaint/noise_test.cpp volpaint/paint_test.cpp
                                   volpaint/seen_test.cpp LIBRARIES test_support)

eikonal_run(volpaint_manners COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/volpaint/volpaint_test.sh
                                       ${CMAKE_BINARY_DIR})
