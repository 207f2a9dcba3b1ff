eikonal_test(test_mesh
    SOURCES mesh/shapes_test.cpp mesh/read_test.cpp mesh/dialects_test.cpp mesh/check_test.cpp
            mesh/repair_test.cpp mesh/weld_test.cpp mesh/parts_test.cpp mesh/plate_test.cpp
            mesh/triangle_tree_test.cpp mesh/walls_test.cpp mesh/smooth_test.cpp mesh/nearest_test.cpp
            mesh/corpus_test.cpp fuzz/mesh_fuzz.cpp
    LIBRARIES test_support)
