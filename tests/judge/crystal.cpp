// Uniaxial crystals by Maxwell's equations alone: long doubles, a tensor, four unknown amplitudes.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "judge/crystal.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace judge {

namespace {

using Real = long double;
using Complex = std::complex<Real>;
using Matrix = std::array<Field, 3>;

Field fieldOf(const dvec3& v) {
    return {Complex(v.x), Complex(v.y), Complex(v.z)};
}

Complex dotOf(const Field& a, const Field& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Field crossOf(const Field& a, const Field& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Field scaled(const Field& a, Complex s) {
    return {s * a[0], s * a[1], s * a[2]};
}

Field conjugate(const Field& a) {
    return {std::conj(a[0]), std::conj(a[1]), std::conj(a[2])};
}

Real lengthOf(const Field& a) {
    return std::sqrt(std::norm(a[0]) + std::norm(a[1]) + std::norm(a[2]));
}

/// Re(E × H*) of a wave, H = k × E.
dvec3 poynting(const Field& k, const Field& e) {
    const Field s = crossOf(e, conjugate(crossOf(k, e)));
    return {static_cast<double>(s[0].real()), static_cast<double>(s[1].real()),
            static_cast<double>(s[2].real())};
}

Matrix tensorOf(const Tensor& medium) {
    const dvec3 a = glm::normalize(medium.axis);
    const Real o = medium.o, e = medium.e;
    Matrix m{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m[i][j] = Complex((i == j ? o * o : 0) +
                              (e * e - o * o) * static_cast<Real>(a[i]) * static_cast<Real>(a[j]));
    return m;
}

/// k (k·E) − k² E + ε E = 0 as a matrix.
Matrix waveMatrix(const Matrix& epsilon, const Field& k) {
    Matrix m = epsilon;
    const Complex square = dotOf(k, k);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[i][j] += k[i] * k[j] - (i == j ? square : Complex(0));
    return m;
}

Complex determinant(const Matrix& m) {
    return dotOf(m[0], crossOf(m[1], m[2]));
}

/// What the matrix makes nothing of: across all its rows.
Field nullVector(const Matrix& m) {
    Field best{};
    for (int i = 0; i < 3; ++i) {
        const Field v = crossOf(m[i], m[(i + 1) % 3]);
        if (lengthOf(v) > lengthOf(best)) best = v;
    }
    return scaled(best, 1 / lengthOf(best));
}

struct Candidate {
    Field k, e;
};

/// The four k_z that a tangential k allows, by Durand and Kerner's iteration on the determinant.
std::vector<Candidate> candidates(const Tensor& medium, const Field& along, const Field& normal) {
    const Matrix epsilon = tensorOf(medium);
    const auto kOf = [&](Complex z) {
        return Field{along[0] + z * normal[0], along[1] + z * normal[1], along[2] + z * normal[2]};
    };
    const auto value = [&](Complex z) { return determinant(waveMatrix(epsilon, kOf(z))); };
    // The leading coefficient: a quartic's fourth difference over 24.
    const Complex lead =
        (value(-2) - Real(4) * value(-1) + Real(6) * value(0) - Real(4) * value(1) + value(2)) /
        Real(24);
    std::array<Complex, 4> root;
    for (int i = 0; i < 4; ++i) root[i] = std::pow(Complex(0.9L, 1.3L), i);
    for (int round = 0; round < 400; ++round)
        for (int i = 0; i < 4; ++i) {
            Complex others = lead;
            for (int j = 0; j < 4; ++j)
                if (j != i) others *= root[i] - root[j];
            if (std::abs(others) > 0) root[i] -= value(root[i]) / others;
        }
    std::vector<Candidate> found;
    for (const Complex z : root) {
        // Real where rounding alone makes it complex.
        const Complex clean = std::abs(z.imag()) < 1e-14L ? Complex(z.real()) : z;
        found.push_back({kOf(clean), nullVector(waveMatrix(epsilon, kOf(clean)))});
    }
    return found;
}

/// Of an isotropic medium: both polarisations, both ways.
std::vector<Candidate> isotropicCandidates(double index, const Field& along, const Field& normal) {
    const Complex q2 = dotOf(along, along);
    const Complex z = std::sqrt(Complex(static_cast<Real>(index) * index) - q2);
    Field s = crossOf(normal, along);
    if (lengthOf(s) < 1e-12L)
        s = crossOf(normal, fieldOf(std::abs(normal[0]) < 0.8L ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    s = scaled(s, 1 / lengthOf(s));
    std::vector<Candidate> found;
    for (const Complex side : {z, -z}) {
        const Field k{along[0] + side * normal[0], along[1] + side * normal[1],
                      along[2] + side * normal[2]};
        const Field p = crossOf(s, k);
        found.push_back({k, s});
        found.push_back({k, scaled(p, 1 / lengthOf(p))});
    }
    return found;
}

/// The two that go towards +normal, or fade there.
std::vector<Candidate> goingOn(const Tensor& medium, const Field& along, const Field& normal,
                               const dvec3& n) {
    std::vector<Candidate> two;
    for (const Candidate& c : medium.isotropic() ? isotropicCandidates(medium.o, along, normal)
                                                 : candidates(medium, along, normal)) {
        const Real fades = dotOf(c.k, normal).imag();
        const bool on = fades != 0 ? fades > 0 : glm::dot(poynting(c.k, c.e), n) > 0;
        if (on) two.push_back(c);
    }
    if (two.size() != 2) throw std::runtime_error("not two waves go on from a boundary");
    return two;
}

/// Gauss, with pivots.
std::array<Complex, 4> solved(std::array<std::array<Complex, 5>, 4> m) {
    for (int i = 0; i < 4; ++i) {
        int best = i;
        for (int j = i + 1; j < 4; ++j)
            if (std::abs(m[j][i]) > std::abs(m[best][i])) best = j;
        std::swap(m[i], m[best]);
        for (int j = 0; j < 4; ++j) {
            if (j == i) continue;
            const Complex f = m[j][i] / m[i][i];
            for (int c = i; c < 5; ++c) m[j][c] -= f * m[i][c];
        }
    }
    return {m[0][4] / m[0][0], m[1][4] / m[1][1], m[2][4] / m[2][2], m[3][4] / m[3][3]};
}

dvec3 realOf(const Field& k) {
    return {static_cast<double>(k[0].real()), static_cast<double>(k[1].real()),
            static_cast<double>(k[2].real())};
}

char modeOf(const Tensor& medium, const Field& k) {
    if (medium.isotropic()) return 'i';
    const Real o2 = static_cast<Real>(medium.o) * medium.o;
    const Real axial = glm::dot(realOf(k), glm::normalize(medium.axis));
    const Real square = dotOf(k, k).real();
    const Real e2 = static_cast<Real>(medium.e) * medium.e;
    const Real offE = std::abs(axial * axial / o2 + (square - axial * axial) / e2 - 1);
    return std::abs(square / o2 - 1) < offE ? 'o' : 'e';
}

} // namespace

LightWave isotropicWave(double index, const dvec3& direction, const dvec3& field) {
    const dvec3 d = glm::normalize(direction);
    const dvec3 e = glm::normalize(field - glm::dot(field, d) * d);
    return {index * d, d, fieldOf(e), 1, 'i', false};
}

LightWave crystalWave(const Tensor& medium, char mode, const dvec3& direction) {
    const dvec3 d = glm::normalize(direction), a = glm::normalize(medium.axis);
    const double c = glm::dot(d, a);
    const double n =
        mode == 'o'
            ? medium.o
            : 1 / std::sqrt(c * c / (medium.o * medium.o) + (1 - c * c) / (medium.e * medium.e));
    const Field k = fieldOf(n * d);
    const Field e = nullVector(waveMatrix(tensorOf(medium), k));
    return {n * d, glm::normalize(poynting(k, e)), e, 1, mode, false};
}

std::vector<LightWave> scattered(const LightWave& wave, const dvec3& normal, const Tensor& near,
                                 const Tensor& beyond) {
    const dvec3 n = glm::normalize(normal);
    const Field up = fieldOf(n), down = fieldOf(-n);
    const Field along = fieldOf(wave.k - glm::dot(wave.k, n) * n);
    std::vector<Candidate> all = goingOn(near, along, down, -n);
    for (const Candidate& c : goingOn(beyond, along, up, n)) all.push_back(c);
    // Two directions along the boundary.
    const dvec3 t1 =
        glm::normalize(glm::cross(n, std::abs(n.x) < 0.8 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const dvec3 t2 = glm::cross(n, t1);
    const auto rows = [&](const Field& k, const Field& e) {
        const Field h = crossOf(k, e);
        return std::array<Complex, 4>{dotOf(e, fieldOf(t1)), dotOf(e, fieldOf(t2)),
                                      dotOf(h, fieldOf(t1)), dotOf(h, fieldOf(t2))};
    };
    std::array<std::array<Complex, 5>, 4> system{};
    for (size_t i = 0; i < 4; ++i) {
        const auto column = rows(all[i].k, all[i].e);
        for (size_t r = 0; r < 4; ++r) system[r][i] = i < 2 ? -column[r] : column[r];
    }
    const Field arriving = fieldOf(wave.k);
    const auto given = rows(arriving, wave.field);
    for (size_t r = 0; r < 4; ++r) system[r][4] = given[r];
    const auto amplitude = solved(system);
    const double brought = glm::dot(poynting(arriving, wave.field), n);
    std::vector<LightWave> out;
    const auto add = [&](const Field& k, const Field& e, const Tensor& medium, bool isBeyond) {
        const dvec3 s = poynting(k, e);
        out.push_back({realOf(k), glm::normalize(s), e, std::abs(glm::dot(s, n)) / brought,
                       modeOf(medium, k), isBeyond});
    };
    for (size_t side = 0; side < 2; ++side) {
        const Tensor& medium = side == 0 ? near : beyond;
        const Candidate &first = all[2 * side], &second = all[2 * side + 1];
        const Field e1 = scaled(first.e, amplitude[2 * side]);
        const Field e2 = scaled(second.e, amplitude[2 * side + 1]);
        if (medium.isotropic()) { // one wave
            if (dotOf(first.k, up).imag() != 0) continue;
            add(first.k, {e1[0] + e2[0], e1[1] + e2[1], e1[2] + e2[2]}, medium, side == 1);
            continue;
        }
        if (dotOf(first.k, up).imag() == 0) add(first.k, e1, medium, side == 1);
        if (dotOf(second.k, up).imag() == 0) add(second.k, e2, medium, side == 1);
    }
    return out;
}

namespace {

struct BallTracer {
    Tensor medium;
    dvec3 centre;
    double radius;
    int boundaries;
    std::vector<LeftBall> left;

    /// Within the ball, from x on its surface.
    void follow(const dvec3& x, const LightWave& wave, double power, const std::string& course) {
        if (static_cast<int>(course.size()) >= boundaries || power < 1e-9) return;
        const dvec3 end = x - 2 * glm::dot(x - centre, wave.ray) * wave.ray;
        const dvec3 normal = (end - centre) / radius;
        const std::string here = course + wave.mode;
        for (const LightWave& next : scattered(wave, normal, medium, Tensor{})) {
            if (next.beyond)
                left.push_back({end, next.ray, power * next.power, here});
            else
                follow(end, next, power * next.power, here);
        }
    }
};

} // namespace

std::vector<LeftBall> throughBall(const Tensor& medium, const dvec3& centre, double radius,
                                  const dvec3& x, const dvec3& direction, int boundaries) {
    const dvec3 d = glm::normalize(direction);
    const dvec3 across = x - centre - glm::dot(x - centre, d) * d;
    const dvec3 start = centre + across - std::sqrt(radius * radius - glm::dot(across, across)) * d;
    const dvec3 normal = (centre - start) / radius;
    BallTracer tracer{medium, centre, radius, boundaries, {}};
    const dvec3 one =
        glm::normalize(glm::cross(d, std::abs(d.x) < 0.8 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    for (const dvec3& field : {one, glm::cross(d, one)})
        for (const LightWave& next : scattered(isotropicWave(1, d, field), normal, {}, medium)) {
            if (!next.beyond)
                tracer.left.push_back({start, next.ray, 0.5 * next.power, ""});
            else
                tracer.follow(start, next, 0.5 * next.power, "");
        }
    return tracer.left;
}

double lossAlongRay(const Tensor& medium, double sigmaO, double sigmaE, const dvec3& direction) {
    const dvec3 d = glm::normalize(direction);
    const Real c = glm::dot(d, glm::normalize(medium.axis));
    const Complex o(medium.o, sigmaO / 2), e(medium.e, sigmaE / 2);
    const Complex n = Real(1) / std::sqrt(c * c / (o * o) + (1 - c * c) / (e * e));
    const LightWave wave = crystalWave(medium, 'e', d);
    return static_cast<double>(2 * n.imag() * static_cast<Real>(glm::dot(d, wave.ray)));
}

} // namespace judge
