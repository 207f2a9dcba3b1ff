eikonal_test(test_volume SOURCES volume/fine_test.cpp volume/volume_test.cpp volume/bad_volume_test.cpp
                     volume/damage_test.cpp volume/objects_test.cpp
             LIBRARIES test_support)

# Small analytic scenes for the tests of every stage.
add_executable(make_volume ${CMAKE_CURRENT_SOURCE_DIR}/volume/make_volume.cpp)
target_link_libraries(make_volume PRIVATE libcore)
