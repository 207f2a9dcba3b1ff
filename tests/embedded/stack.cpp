// Layers one below the other, and what becomes of light in them, on paper.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack.h"

#include <cmath>
#include <glm/exponential.hpp>

namespace eikonal::embedded {

using glm::dvec3;

namespace {

double tangentIn(double n, double sine) {
    return sine / std::sqrt(n * n - sine * sine);
}

double cosineIn(double n, double sine) {
    return std::sqrt(std::max(1 - sine * sine / (n * n), 0.0));
}

/// What a layer adds to what comes up through it, and what it leaves of it.
struct Passed {
    dvec3 emitted, through;
};
Passed passed(const dvec3& absorption, const dvec3& emission, double n, double length) {
    Passed out{};
    for (int c = 0; c < 3; ++c) {
        const double depth = absorption[c] * length;
        const double mean = depth > 0 ? -std::expm1(-depth) / depth : 1;
        out.emitted[c] = emission[c] * length * mean / (n * n);
        out.through[c] = std::exp(-depth);
    }
    return out;
}

/// The value of a step function of the height below the first boundary, blurred.
double blurred(const std::vector<Layer>& layers, double depth, double softness) {
    double value = layers.front().ior, at = 0;
    for (size_t i = 1; i < layers.size(); ++i) {
        const double share = 0.5 * std::erfc((at - depth) / (softness * std::sqrt(2.0)));
        value += share * (layers[i].ior - layers[i - 1].ior);
        at += layers[i].thickness;
    }
    return value;
}

} // namespace

double fresnel(double before, double beyond, double sine) {
    if (sine >= beyond) return 1;
    const double ci = cosineIn(before, sine), ct = cosineIn(beyond, sine);
    const double s = (before * ci - beyond * ct) / (before * ci + beyond * ct);
    const double p = (beyond * ci - before * ct) / (beyond * ci + before * ct);
    return 0.5 * (s * s + p * p);
}

Upward sharpStack(const std::vector<Layer>& layers, double sine, const dvec3& below) {
    Upward up{below, dvec3(0)};
    for (size_t i = layers.size() - 1; i > 0; --i) {
        const Layer& above = layers[i - 1];
        const double R = fresnel(above.ior, layers[i].ior, sine);
        const dvec3 again = 1.0 - R * up.mirrored; // what goes back and forth below the boundary
        up.mirrored = R + (1 - R) * (1 - R) * up.mirrored / again;
        up.own = (1 - R) * up.own / again;
        if (i == 1) break;
        up.shift += above.thickness * tangentIn(above.ior, sine);
        const Passed layer = passed(above.absorption, above.emission, above.ior,
                                    above.thickness / cosineIn(above.ior, sine));
        up.own = layer.emitted + layer.through * (up.own + up.mirrored * layer.emitted);
        up.mirrored *= layer.through * layer.through;
    }
    return up;
}

Upward blurredStack(const std::vector<Layer>& layers, double sine, const dvec3& below,
                    double softness) {
    Upward up{below, dvec3(0)};
    const int kParts = 4000; // of a layer
    double bottom = 0;
    for (size_t i = 1; i + 1 < layers.size(); ++i) bottom += layers[i].thickness;
    for (size_t i = layers.size() - 2; i > 0; --i) {
        const Layer& layer = layers[i];
        const double part = layer.thickness / kParts;
        for (int k = 0; k < kParts; ++k) {
            const double n = blurred(layers, bottom - (k + 0.5) * part, softness);
            up.shift += part * tangentIn(n, sine);
            const Passed thin =
                passed(layer.absorption, layer.emission, n, part / cosineIn(n, sine));
            up.own = thin.emitted + thin.through * up.own;
        }
        bottom -= layer.thickness;
    }
    // It turns before the first boundary already, as far up as the blur reaches.
    const double part = 5 * softness / kParts;
    for (int k = 0; k < kParts; ++k)
        up.shift += part * (tangentIn(blurred(layers, -(k + 0.5) * part, softness), sine) -
                            tangentIn(layers.front().ior, sine));
    return up;
}

} // namespace eikonal::embedded
