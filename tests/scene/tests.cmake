eikonal_test(test_scene SOURCES scene/field_test.cpp scene/many_test.cpp
             scene/warnings_test.cpp LIBRARIES test_support)
