// Uniaxial crystals by Maxwell's equations alone: long doubles, a tensor, four unknown amplitudes.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace judge {

using glm::dvec3;

/// What is on one side of a boundary; isotropic where both indices are the same.
struct Tensor {
    double o = 1, e = 1; ///< n_o, n_e
    dvec3 axis{0, 0, 1}; ///< of any length
    bool isotropic() const { return o == e; }
};

using Field = std::array<std::complex<long double>, 3>;

/// A plane wave that carries light.
struct LightWave {
    dvec3 k;     ///< in units of ω/c
    dvec3 ray;   ///< of length 1, along Poynting's vector
    Field field; ///< E, in units that make its power `power`
    double power = 1;
    char mode = 'i'; ///< o, e, or i in what is isotropic
    bool beyond = false;
};

/// The wave of an isotropic medium along a direction whose E is along `field`, made transverse.
LightWave isotropicWave(double index, const dvec3& direction, const dvec3& field);
/// The wave of a crystal, mode o or e, whose k has that direction.
LightWave crystalWave(const Tensor& medium, char mode, const dvec3& direction);

/// All waves that carry light away from a plane boundary: E and H along it are continuous. `wave`
/// arrives from `near`; `normal` points beyond. Powers are shares of what arrives.
std::vector<LightWave> scattered(const LightWave& wave, const dvec3& normal, const Tensor& near,
                                 const Tensor& beyond);

/// A ray of light that has left a ball.
struct LeftBall {
    dvec3 x, direction;
    double power;
    std::string course; ///< a letter a boundary: the mode on its way to it, capital once reflected
};

/// What becomes of unpolarised light of power 1 that meets a crystal ball in vacuum, through up to
/// so many boundaries; modes are followed by their powers alone.
std::vector<LeftBall> throughBall(const Tensor& medium, const dvec3& centre, double radius,
                                  const dvec3& x, const dvec3& direction, int boundaries);

/// What light loses per length along its ray in a crystal whose indices are complex, 2 Im k·t for
/// a k of that direction.
double lossAlongRay(const Tensor& medium, double sigmaO, double sigmaE, const dvec3& direction);

} // namespace judge
