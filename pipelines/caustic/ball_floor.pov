// A ball of glass over a floor in the sun with photons, as pipelines/caustic_compare.mk has it.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// POV-Ray's z points away from the viewer: all z have the other sign here. Declare=Spacing=... sets
// how far apart photons are on the ball.
#version 3.7;
global_settings {
  assumed_gamma 1 max_trace_level 10 adc_bailout 0.0005
  photons { spacing Spacing autostop 0 }
}
camera {
  perspective
  location <0, 0.9, -2.6>
  right x*image_width/image_height up y
  // POV-Ray's angle is horizontal: 40 degrees vertically.
  angle 2*degrees(atan2(tan(radians(20))*image_width/image_height, 1))
  look_at <0, -0.15, 0>
}
background { rgb 0 }
// Its colour is irradiance over pi: a diffuse floor shows its pigment times that times the cosine.
light_source {
  <0.3, 1, -0.2>*100 rgb 3/pi
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
box {
  <-3, -0.85, -3>, <3, -0.75, 3>
  pigment { rgb 0.8 }
  finish { ambient 0 diffuse 1 specular 0 }
}
