// A ball of glass before an environment map, as pipelines/povray.mk renders it with render too.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// POV-Ray's z points away from the viewer: all z have the other sign here.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 9 adc_bailout 0.001 }
camera {
  perspective
  location <0.9, 0.6, -2.4>
  right x up y
  angle 28
  look_at <0, 0, 0>
}
sky_sphere {
  // OpenEXR's convention: +Z in the middle, +X a quarter to the left of it.
  pigment { image_map { exr "environment.exr" map_type 1 interpolate 2 } rotate y*90 scale <1, 1, -1> }
}
sphere {
  0, 0.5
  pigment { rgbt 1 }
  finish { ambient 0 diffuse 0 specular 0 reflection { 1 fresnel } conserve_energy }
  interior { ior 1.5 }
}
