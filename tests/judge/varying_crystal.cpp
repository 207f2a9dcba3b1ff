// Rays through crystals that vary, by Hamilton's equations in long doubles.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/varying_crystal.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace judge {

namespace {

using Real = long double;
using Vector = glm::tvec3<Real>;

struct State {
    Vector x, k;
};

State operator+(const State& a, const State& b) {
    return {a.x + b.x, a.k + b.k};
}
State operator*(Real f, const State& a) {
    return {f * a.x, f * a.k};
}

Real hamiltonian(const Crystals& at, char mode, const Vector& x, const Vector& k) {
    const Tensor here = at(dvec3(x));
    const Real o2 = static_cast<Real>(here.o) * here.o, e2 = static_cast<Real>(here.e) * here.e;
    if (mode == 'o') return (glm::dot(k, k) / o2 - 1) / 2;
    const Vector axis = glm::normalize(Vector(here.axis));
    const Real along = glm::dot(k, axis);
    return (along * along / o2 + (glm::dot(k, k) - along * along) / e2 - 1) / 2;
}

State slopeOf(const Crystals& at, char mode, const State& s) {
    const Real h = 1e-4L;
    State slope{};
    for (int i = 0; i < 3; ++i) {
        Vector step(0);
        step[i] = h;
        slope.x[i] =
            (hamiltonian(at, mode, s.x, s.k + step) - hamiltonian(at, mode, s.x, s.k - step)) /
            (2 * h);
        slope.k[i] =
            (hamiltonian(at, mode, s.x - step, s.k) - hamiltonian(at, mode, s.x + step, s.k)) /
            (2 * h);
    }
    return slope;
}

State stepped(const Crystals& at, char mode, const State& s, Real tau) {
    const State a = slopeOf(at, mode, s), b = slopeOf(at, mode, s + tau / 2 * a),
                c = slopeOf(at, mode, s + tau / 2 * b), d = slopeOf(at, mode, s + tau * c);
    return s + tau / 6 * (a + 2 * b + 2 * c + d);
}

} // namespace

CrystalRay throughCrystal(const Crystals& at, char mode, const dvec3& x, const dvec3& k,
                          const std::function<double(const dvec3&)>& distance, double step) {
    State s{Vector(x), Vector(k)};
    const Real first = hamiltonian(at, mode, s.x, s.k);
    Real drift = 0;
    for (int i = 0; i < 1000000; ++i) {
        const Real tau = step / glm::length(slopeOf(at, mode, s).x);
        const State next = stepped(at, mode, s, tau);
        drift = std::max(drift, std::abs(hamiltonian(at, mode, next.x, next.k) - first));
        if (i > 0 && distance(dvec3(next.x)) > 0) {
            Real low = 0, high = tau;
            for (int j = 0; j < 60; ++j) {
                const Real middle = (low + high) / 2;
                (distance(dvec3(stepped(at, mode, s, middle).x)) > 0 ? high : low) = middle;
            }
            s = stepped(at, mode, s, low);
            break;
        }
        s = next;
    }
    return {dvec3(s.x), dvec3(s.k), static_cast<double>(drift)};
}

} // namespace judge
