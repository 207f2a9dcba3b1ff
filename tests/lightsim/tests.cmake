eikonal_test(test_lightsim SOURCES lightsim/vacuum_test.cpp lightsim/medium_test.cpp
             lightsim/lens_test.cpp lightsim/run_test.cpp)
