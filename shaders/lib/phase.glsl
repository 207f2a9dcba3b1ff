// Phase functions, normalised over the sphere.
// SPDX-License-Identifier: GPL-3.0-or-later

// 1/(4π): isotropic scattering.
const float kIsotropicPhase = 0.07957747154594767;

// Henyey–Greenstein for mean cosine g in (−1, 1); cosine between the directions of travel before
// and after. [1/sr]
float henyeyGreenstein(float g, float cosine) {
    // Written without the cancellation of 1 + g² − 2g cosθ near g = ±1; a cosine of rounded
    // directions may exceed 1.
    float a = abs(g);
    float c = g < 0.0 ? -cosine : cosine;
    float d = (1.0 - a) * (1.0 - a) + 2.0 * a * max(1.0 - c, 0.0);
    return kIsotropicPhase * (1.0 - g * g) / (d * sqrt(d));
}
