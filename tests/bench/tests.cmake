# The benchmark is no test: it times, and asserts nothing.
eikonal_program(bench SOURCES bench/main.cpp bench/kernels.cpp bench/sharp.cpp
                              bench/stages.cpp bench/scenes.cpp bench/steps.cpp bench/floors.cpp bench/fronts.cpp bench/surfaces.cpp
                              bench/hierarchy.cpp bench/image_space.cpp
                      LIBRARIES test_support)
