eikonal_test(test_optics SOURCES optics/library_test.cpp optics/materials_test.cpp optics/metal_fit_test.cpp
             optics/microfacet_test.cpp optics/plane_light_test.cpp optics/ray_test.cpp
             optics/spectrum_test.cpp optics/crystal_test.cpp optics/varying_crystal_test.cpp
             optics/crystal_float.cpp LIBRARIES judge)
# shader_lib.h reads the shaders' library from there.
target_include_directories(test_optics SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
# As GLSL has it: literals of float.
set_source_files_properties(optics/crystal_float.cpp PROPERTIES COMPILE_OPTIONS
    -fsingle-precision-constant SKIP_PRECOMPILE_HEADERS ON)
