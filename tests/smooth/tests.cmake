eikonal_test(test_smooth SOURCES smooth/smooth_test.cpp smooth/plan_test.cpp smooth/sides_test.cpp)

eikonal_manners(volsmooth_manners smooth/volsmooth_test.sh)
