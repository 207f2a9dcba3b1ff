eikonal_test(test_image SOURCES image/exr_test.cpp image/exr_input_test.cpp
                                image/picture_test.cpp)
# Loaded by dlopen, hence not linked.
add_dependencies(test_image eikonal_oiio)
