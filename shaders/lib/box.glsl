// Where a straight line meets an axis-aligned box.
// SPDX-License-Identifier: GPL-3.0-or-later

// Parameters (enter, leave) of x + t d in the box; enter > leave if it misses. Components of d may
// be 0: the line then is inside that slab everywhere or nowhere.
vec2 boxSpan(vec3 x, vec3 d, vec3 low, vec3 high) {
    float enter = -1.0e30;
    float leave = 1.0e30;
    for (int i = 0; i < 3; ++i) {
        if (d[i] == 0.0) {
            if (x[i] < low[i] || x[i] > high[i]) enter = 1.0e30;
        } else {
            float a = (low[i] - x[i]) / d[i];
            float b = (high[i] - x[i]) / d[i];
            enter = max(enter, min(a, b));
            leave = min(leave, max(a, b));
        }
    }
    return vec2(enter, leave);
}

// The parameter at which x + t d, from x inside or on the box, leaves it; at least 0.
float timeToLeave(vec3 x, vec3 d, vec3 low, vec3 high) {
    float leave = 1.0e30;
    for (int i = 0; i < 3; ++i) {
        float face = d[i] > 0.0 ? high[i] : low[i];
        if (d[i] != 0.0) leave = min(leave, (face - x[i]) / d[i]);
    }
    return max(leave, 0.0);
}

// −1 or 1, never 0.
vec3 signsOf(vec3 d) {
    return vec3(d.x < 0.0 ? -1.0 : 1.0, d.y < 0.0 ? -1.0 : 1.0, d.z < 0.0 ? -1.0 : 1.0);
}

// 1 over the components' sizes.
vec3 inversesOf(vec3 d) {
    return 1.0 / max(abs(d), vec3(1.0e-12));
}
