# Hard cases: each is named for a fact of physics that must hold where it is hardest to keep.
find_package(rapidcheck REQUIRED)
eikonal_test(test_hard
    SOURCES hard/main.cpp hard/interface_test.cpp hard/contrast_test.cpp hard/orbit_test.cpp
            hard/invariant_test.cpp hard/float_walk.cpp hard/depth_test.cpp hard/range_test.cpp
            hard/walk_test.cpp hard/shape_test.cpp hard/mesh_test.cpp hard/bad_value_test.cpp
            hard/sharp_ball_test.cpp hard/sharp_interface_test.cpp hard/sharp_shape_test.cpp
            hard/sharp_value_test.cpp hard/random_scene_test.cpp
    LIBRARIES test_support rapidcheck rapidcheck_gtest LONG "*")
target_include_directories(test_hard SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
# The shaders' library in float: its numbers without a suffix are floats there, too.
set_source_files_properties(hard/float_walk.cpp PROPERTIES
                            COMPILE_OPTIONS -fsingle-precision-constant
                            SKIP_PRECOMPILE_HEADERS ON)
# They are run as users run them.
add_dependencies(test_hard mesh2vol volsmooth lightsim render eikonal_oiio)

eikonal_run(hard_manners LONG COMMAND bash ${CMAKE_CURRENT_LIST_DIR}/hard_test.sh ${CMAKE_BINARY_DIR})
