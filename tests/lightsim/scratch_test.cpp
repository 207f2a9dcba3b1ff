#include "support/lit.h"
#include <chrono>
#include <cstdlib>
using namespace eikonal;
using namespace eikonal::lightsim;
using glm::dvec3;
using glm::ivec3;
static double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
static void compare(const char* name, const TestVolume& scene, const Light& light) {
    Params ref = paramsOf({light}, 1 << 21);
    ref.outputs = Output::fluence; ref.smoothing = 1;
    if (const char* out = std::getenv("DIR")) if (*out == '1') ref.outputs = Output::both;
    Params fine = ref;
    if (std::getenv("FINE")) { fine.tracing.integrator = optics::Integrator::sharma; fine.stepMin = 0.5; fine.stepLimit = 1; fine.octreeTolerance = fine.octreeTolerance2 = 0; }
    if (std::getenv("CUBIC")) ref.tracing.interpolation = optics::Interpolation::cubic;
    const Lit truth(scene.volume(), fine);
    double mean = 0, n = 0;
    forEachVoxel(truth.plan.scene.size(), [&](ivec3 p) { mean += truth.fluence(p); n += 1; });
    mean /= n;
    const auto tell = [&](const char* what, const Params& params) {
        const double a = now();
        const Lit lit(scene.volume(), params);
        const double b = now();
        if (std::getenv("ROW") && *what == 'w' && what[9] != ' ') {
            for (int y : {28, 12, 5, 1}) { std::printf("y %d\n", y); for (int x = 0; x < 40; ++x) std::printf("%d %.4f %.4f %.4f\n", x, truth.fluence({x, y, 24 - (28-y)/5}), lit.fluence({x, y, 24-(28-y)/5}), lit.fluence({x, y, 24-(28-y)/5}) - truth.fluence({x, y, 24-(28-y)/5})); }
        }
        if (std::getenv("MAP") && *what == 'w') {
            for (int b = 0; b < 8; ++b) {
                double e2 = 0, m = 0, k = 0, bias = 0;
                forEachVoxel(truth.plan.scene.size(), [&](ivec3 p) {
                    const dvec3 q = dvec3(p) + 0.5 - 20.0, d = glm::normalize(dvec3(0.3, -1, 0.2));
                    const double along = glm::dot(q, d), off = glm::length(q - along * d);
                    const int bin = (off < 16 ? 0 : off > 20 ? 2 : 1) * 2 + (along > 0);
                    if (bin != b) return;
                    const double t = truth.fluence(p), e = lit.fluence(p) - t;
                    if (t > 5 * mean) return;
                    e2 += e * e; m += t; k += 1; bias += e;
                });
                if (k > 0) std::printf("   bin off %d along %d: rms/mean %.4f bias/mean %.4f mean %.3f n %.0f\n", b / 2, b % 2, std::sqrt(e2 / k) / (m / k), bias / m, m / k, k);
            }
        }
        double sum = 0, all = 0, dark = 0;
        forEachVoxel(truth.plan.scene.size(), [&](ivec3 p) {
            const double t = truth.fluence(p), e = std::pow(lit.fluence(p) - t, 2);
            sum += e / (t * t + 0.01 * mean * mean); all += 1;
            if (t < 2 * mean) { dark += e; }
        });
        std::fflush(stdout); std::printf("%-10s %-22s rms rel %.4f  rms abs(t<2m)/m %.4f  time %.2f  deposits %.3g patches %.3g closed %g\n", name, what, std::sqrt(sum / all), std::sqrt(dark / all) / mean, b - a,
                    lit.counter("deposits"), lit.counter("front_patches"), 1 - (lit.stats.energy.escaped[0] + lit.stats.energy.lost[0] + lit.stats.energy.absorbed[0] + lit.stats.energy.scattered[0]) / lit.stats.energy.entered[0]);
        if (std::getenv("PASSES")) for (const PassTime& t : lit.stats.passes) std::printf("      %s gpu %.0f cpu %.0f\n", t.name.c_str(), t.gpuMs, t.cpuMs);
    };
    for (const int k : {14, 16}) {
        Params p = ref; p.photons = 1 << k;
        tell(("photons 2^" + std::to_string(k)).c_str(), p);
    }
    { Params p = ref; p.photons = 0; tell("photons auto", p); }
    Params p = ref; p.photons = 0; p.method = Method::wavefront;
    tell("wavefront", p);
    { Params q = p; q.tracing.step = 1; tell("wavefront step 1", q); q.tracing.step = 0.5; tell("wavefront step .5", q); q.tracing.step = 4;  tell("wavefront step 4", q); }
    p.photons = 4 * 40 * 40 * 9;
    tell("wavefront fine", p);
}
TEST(Scratch, Compare) {
    const int s = 40;
    TestVolume vac{ivec3(s)}; vac.constant("ior", 1);
    if (!std::getenv("LUNE")) compare("point", vac, lamp({-15, 20, 25}));
    if (!std::getenv("LUNE")) compare("beam", vac, beam({0.3, -1, 0.2}));
    TestVolume lune{ivec3(s)}; lune.index([](dvec3 p) { const double r2 = glm::dot(p - 20.0, p - 20.0) / (18 * 18); return std::sqrt(2 - std::min(r2, 1.0)); });
    compare("luneburg", lune, beam({0.3, -1, 0.2}));
    TestVolume ball{ivec3(s)}; ball.index([](dvec3 p) { const double d = 13 - glm::length(p - dvec3(20)); return 1 + 0.25 * std::erfc(-d / (1.5 * std::sqrt(2.0))); });
    if (std::getenv("BALL")) compare("ball", ball, beam({0.3, -1, 0.2}));
}
