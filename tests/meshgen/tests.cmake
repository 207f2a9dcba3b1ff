eikonal_test(test_shapes SOURCES meshgen/solids_test.cpp meshgen/revolve_test.cpp
                                 meshgen/implicit_test.cpp meshgen/logo_test.cpp)

eikonal_manners(meshgen_manners meshgen/meshgen_test.sh LONG mesh2vol_takes_all)
