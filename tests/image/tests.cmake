eikonal_test(test_image SOURCES image/exr_test.cpp image/exr_input_test.cpp
                                image/exr_whole_test.cpp image/environment_test.cpp
                                image/lat_long_test.cpp
                                image/picture_test.cpp)
# Loaded by dlopen, hence not linked.
add_dependencies(test_image eikonal_oiio)
# exr_whole_test.cpp stands before zlib.
set_target_properties(test_image PROPERTIES ENABLE_EXPORTS ON)
