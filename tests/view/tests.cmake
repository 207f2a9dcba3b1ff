eikonal_test(test_view SOURCES view/camera_test.cpp view/light_test.cpp view/curved_test.cpp
             view/sharp_test.cpp view/length_test.cpp view/kink_test.cpp view/pattern_test.cpp
             view/samples_test.cpp view/points_test.cpp view/dispersion_test.cpp view/rough_test.cpp view/coat_test.cpp
             view/ground_test.cpp view/plate_test.cpp view/domains_test.cpp view/overlaps_test.cpp LIBRARIES judge test_support
             LONG "LinearSamples.AreNoWorseThanPlainOnesAtEdges*" "ViewKink.*" "ViewGround.Meets*" "Domains.RaysGo*" "Domains.WhatIs*" "Domains.AnEye*"
             "Overlaps.A*" "Overlaps.Opaque*"
             "RoughView.Samples*" "Dispersion.FewShifted*")

# The structs that shaders and C++ share are from there.
target_include_directories(test_view SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)

eikonal_manners(render_manners view/render_test.sh LONG bad_usage boundaries plate light_of_points several_outputs)
eikonal_run(render_files LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/view/render_files_test.sh
                                 ${CMAKE_BINARY_DIR})
eikonal_run(ground_files LONG COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/view/ground_test.sh
                                 ${CMAKE_BINARY_DIR})
