# Uniaxial crystals, end to end.
eikonal_test(test_crystals SOURCES crystals/view_test.cpp crystals/varying_test.cpp crystals/light_test.cpp LIBRARIES judge test_support
             LONG "CrystalLight.E*" "CrystalLight.Modes*" "CrystalLight.RaysTurn*" "CrystalLight.A*" "CrystalLight.Glass*" "VaryingCrystal.WhatDoesNot*" "VaryingCrystal.Rays*" "VaryingCrystal.Modes*" "VaryingCrystal.Axes*" "CrystalView.ABall*" "CrystalView.Polarisers*" "CrystalView.AThin*")
# Makes what pipelines/crystals.mk shows.
eikonal_program(stressed_disc SOURCES crystals/stressed_disc.cpp LIBRARIES test_support)
