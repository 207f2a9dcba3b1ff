// A ball of glass over an endless checkered ground in the sun, as pipelines/ball_ground.mk has it.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// POV-Ray's z points away from the viewer: all z have the other sign here.
#version 3.7;
global_settings {
  assumed_gamma 1 max_trace_level 10 adc_bailout 0.0005
  photons { spacing 0.004 autostop 0 }
}
camera {
  perspective
  location <0.4, 0.45, -2.3>
  right x*image_width/image_height up y
  // POV-Ray's angle is horizontal: 38 degrees vertically.
  angle 2*degrees(atan2(tan(radians(19))*image_width/image_height, 1))
  look_at <0, -0.12, 0>
}
background { rgb <0.3, 0.4, 0.55> }
// Its colour is irradiance over pi: a diffuse floor shows its pigment times that times the cosine. Without its
// disc, which blurs edges of light alone.
light_source {
  <-0.7, 0.8, 0.3>*100 rgb 3/pi
  parallel point_at 0
  photons { reflection on refraction on }
}
sphere {
  0, 0.5
  pigment { rgbt 1 }
  finish { ambient 0 diffuse 0 specular 0 reflection { 1 fresnel } conserve_energy }
  interior { ior 1.5 }
  photons { target reflection on refraction on collect off }
}
plane {
  y, -0.52
  // Squares of a quarter along x and z; across y there is no second layer of them at the plane.
  pigment { checker rgb <0.8, 0.75, 0.65> rgb <0.4, 0.375, 0.325> scale <0.25, 1000, 0.25> translate 500*y }
  finish { ambient 0 diffuse 1 specular 0 }
}
