eikonal_test(test_gpu SOURCES gpu/device_test.cpp gpu/program_test.cpp gpu/resources_test.cpp)
