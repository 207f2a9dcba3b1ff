eikonal_test(test_base SOURCES base/text_test.cpp base/history_test.cpp base/atomic_file_test.cpp
                               base/resources_test.cpp)
