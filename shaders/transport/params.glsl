// What the transport core is told.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/bindings.h"
#include "shared/transport_params.h"

layout(std140, binding = kTransportBlock) uniform Transport { TransportParams transport; };

const float kRounding = 6.0e-8; // of a float, relative

// The estimate of a whole path: roundings of its steps add up like a walk at random.
float errorOf(float error, int steps) {
    return error + kRounding * transport.tolerance.y * sqrt(float(steps));
}
