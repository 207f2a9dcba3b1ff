// The wine glass before an environment map, as pipelines/wineglass.mk renders it with render too.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// POV-Ray's z points away from the viewer: all z have the other sign here.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 32 adc_bailout 0.001 }
#include "glass.inc"
camera {
  perspective
  location <-150, 95, 420>
  right x*image_width/image_height up y
  angle 2*degrees(atan(tan(radians(17/2))*image_width/image_height)) // 17° from top to bottom
  look_at <0, 60, 0>
}
sky_sphere {
  // OpenEXR's convention: +Z in the middle, +X a quarter to the left of it.
  pigment { image_map { exr "environment.exr" map_type 1 interpolate 2 } rotate y*90 scale <1, 1, -1> }
}
object {
  Glass
  pigment { rgbt 1 }
  finish { ambient 0 diffuse 0 specular 0 reflection { 1 fresnel } conserve_energy }
  interior { ior 1.5 }
}
