# A wine glass with a wall of 1 mm against rays through its exact surface; pipelines/wineglass.mk
# calls the program.
eikonal_program(wineglass SOURCES wineglass/main.cpp wineglass/compare.cpp LIBRARIES judge)
eikonal_test(test_wineglass SOURCES wineglass/wineglass_test.cpp wineglass/compare.cpp
             LIBRARIES judge LONG "*")
