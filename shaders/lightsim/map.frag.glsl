// Where the light first meets the domain or the proxy, per pixel of the photon map.
// SPDX-License-Identifier: GPL-3.0-or-later

layout(location = 0) in vec3 place;
layout(location = 0) out vec4 result;

void main() {
    result = vec4(place, 1.0);
}
