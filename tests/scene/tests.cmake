eikonal_test(test_scene SOURCES scene/field_test.cpp scene/warnings_test.cpp LIBRARIES test_support)
# The structs that shaders read are from there.
target_include_directories(test_scene SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
