eikonal_test(test_optics SOURCES optics/library_test.cpp optics/materials_test.cpp optics/metal_fit_test.cpp
             optics/microfacet_test.cpp optics/plane_light_test.cpp optics/ray_test.cpp
             optics/spectrum_test.cpp)
# shader_lib.h reads the shaders' library from there.
target_include_directories(test_optics SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
