# Lit floors against exact pictures of them; pipelines/caustic_compare.mk calls the program.
eikonal_program(caustic SOURCES caustic/main.cpp caustic/compare.cpp LIBRARIES judge)
eikonal_test(test_caustic SOURCES caustic/caustic_test.cpp caustic/compare.cpp LIBRARIES judge
             LONG "Caustic.OfABall*")
