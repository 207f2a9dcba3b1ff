eikonal_test(test_volpaint SOURCES volpaint/noise_test.cpp volpaint/paint_test.cpp
                                   volpaint/seen_test.cpp LIBRARIES test_support)

eikonal_manners(volpaint_manners volpaint/volpaint_test.sh)
