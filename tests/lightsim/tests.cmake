eikonal_test(test_lightsim SOURCES lightsim/vacuum_test.cpp lightsim/medium_test.cpp
             lightsim/lens_test.cpp lightsim/receiving_test.cpp lightsim/run_test.cpp
             lightsim/sharp_test.cpp lightsim/surfaces_test.cpp lightsim/points_test.cpp lightsim/lights_test.cpp lightsim/bounces_test.cpp
             lightsim/fronts_test.cpp lightsim/bounces_truth_test.cpp
             lightsim/dispersion_test.cpp lightsim/rough_test.cpp
             LIBRARIES test_support LONG "LightSharp.AGradedBall*" "LightSharp.FortyLayers*"
                                          "LightRun.BatchesChange*" "LightRun.AutomaticPhotonsAreEnough" "LightReceivingLong.*"
                                          "LightSurfaces.BeamsDraw*" "LightSurfaces.ABall*"
                                          "LightSharp.ABallGathers*" "LightMedium.SmoothingKeeps*"
                                          "LightPoints.FlowIs*" "LightPoints.BeamsToOther*"
                                          "LightSurfaces.WideBeams*" "LightSurfaces.WhatAbsorbs*"
                                          "LightReceiving.WhatPictures*" "LightReceiving.WhatMeetsNothingAnd*" "LightLens.Orbits*"
                                          "Lights.ASphere*" "Lights.AnEven*" "Lights.ADisc*" "Lights.Apart*"
                                          "LightBounces.ABlurredBox*" "LightBounces.GlassOn*" "LightBounces.TheFirst*"
                                          "LightBounces.AddTo*" "BouncesTruth.MorePhotons*" "BouncesTruth.AWallGets*"
                                          "BouncesTruth.ALoneBall*" "BouncesTruth.WhatVoxels*" "LightBounces.AClosedBox*"
                                          "BouncesTruth.AWallOfOne*" "BouncesTruth.AHollowBall*"
                                          "LightFronts.ASharpBalls*" "LightFronts.ABlurredBalls*"
                                          "LightFronts.ASecondRun*" "LightFronts.Surfaces*"
                                          "LightFronts.AnOpaque*" "LightPoints.GetWhat*"
                                          "LightDispersion.EightParts*" "LightDispersion.PointsGet*" "LightDispersion.LinesLand*"
                                          "LightMetal.ACylinders*" "LightRough.ARough*"
                                          "LightRough.PhotonsTake*" "LightCoat.ItsBases*" "LightPoints.OfLightsApart*" "LightDispersion.White*"
                                          "Lights.ARect*" "LightSurfaces.TheSameRun*"
                                          "LightSurfaces.DimLight*" "LightSharp.OutOfGlass*" "LightLens.ATurned*")

eikonal_manners(lightsim_manners lightsim/lightsim_test.sh LONG bad_usage old_names lights points)

eikonal_manners(lightsim_fronts lightsim/fronts_test.sh)

# shader_lib.h reads the shaders' library from there.
target_include_directories(test_lightsim SYSTEM PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
