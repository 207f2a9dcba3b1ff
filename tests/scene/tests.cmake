eikonal_test(test_scene SOURCES scene/field_test.cpp)
