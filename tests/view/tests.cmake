eikonal_test(test_view SOURCES view/camera_test.cpp view/light_test.cpp view/curved_test.cpp)
