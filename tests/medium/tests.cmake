eikonal_test(test_medium SOURCES medium/field_test.cpp)
