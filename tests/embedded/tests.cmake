# Media within media: each stage in its turn, against closed forms and small computations of their
# own.
eikonal_test(test_embedded
             SOURCES embedded/stage.cpp embedded/stack.cpp embedded/insect_test.cpp
                     embedded/cavity_test.cpp embedded/glow_test.cpp embedded/anisotropy_test.cpp
                     embedded/priority_test.cpp
             LIBRARIES test_support LONG "*Priorities*Sharp")
