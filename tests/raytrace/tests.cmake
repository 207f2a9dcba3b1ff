eikonal_test(test_raytrace
    SOURCES raytrace/faces_test.cpp raytrace/bodies_test.cpp raytrace/slab_test.cpp raytrace/normal_distances_test.cpp
            raytrace/limits_test.cpp
    LIBRARIES test_support)
