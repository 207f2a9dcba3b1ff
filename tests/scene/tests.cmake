eikonal_test(test_scene SOURCES scene/field_test.cpp scene/lattice_test.cpp scene/ground_test.cpp scene/many_test.cpp scene/warnings_test.cpp
             LIBRARIES test_support)
# What shaders and C++ share is read from there.
target_include_directories(test_scene SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
