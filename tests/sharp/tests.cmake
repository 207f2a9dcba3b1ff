# Sharp boundaries against the judge: a truth that shares no code with what it holds.
eikonal_test(test_sharp SOURCES sharp/along_test.cpp sharp/ball_test.cpp sharp/fine_test.cpp
             sharp/flat_test.cpp
             sharp/fluence_test.cpp sharp/fluence.cpp sharp/graded_test.cpp sharp/many_test.cpp
             sharp/mesh_test.cpp
             sharp/objects_test.cpp sharp/paged_test.cpp sharp/unlit_test.cpp
             LIBRARIES test_support
             LONG "Paged.SharpMedia*" "Paged.BlurredMediaLookTheSame" "SharpMany.IdleObjects*"
                  "SharpFine.Packed*" "SharpGraded.*" "SharpMany.FortyShells"
                  "SharpMany.SixtyFourBalls*" "SharpObjects.AShellAndWhatFillsIt"
                  "SharpBall.FirstFourOrdersAreFresnels" "SharpBall.LimitsAre*" "Unlit.*" "SharpObjects.AB*" "SharpObjects.Wine*"
                  "SharpMany.AnEyeInEach*" "SharpMany.Grazing*" "SharpMany.OpaqueAnd*")
