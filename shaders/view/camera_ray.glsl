// Where a pixel's ray starts.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included where `params`, a ViewParams, and the domain are declared.

struct CameraRay {
    vec3 start;     // on the domain's face, or the eye [voxel]
    vec3 eye;       // where it comes from [voxel]
    dvec3 exact;    // the same
    vec3 direction; // of length 1
    bool hits;      // the domain
    bool within;    // the eye is in the domain
    bool isFirst;   // of its pixel, and on its first branch
};

// Set up in double: a distant eye must not jitter the point of entry.
CameraRay cameraRayOf(ivec2 pixel) {
    vec2 s = vec2(2.0, -2.0) * (vec2(pixel) + params.pattern.xy) / vec2(params.picture.xy) +
             vec2(-1.0, 1.0);
    bool perspective = params.eyeHigh.w == 1.0;
    dvec3 eye = dvec3(params.eyeHigh.xyz) + dvec3(params.eyeLow.xyz);
    dvec3 offset = double(s.x) * dvec3(params.right.xyz) + double(s.y) * dvec3(params.up.xyz);
    dvec3 towards = dvec3(params.forward.xyz) + (perspective ? offset : dvec3(0.0));
    towards /= sqrt(dot(towards, towards));
    if (!perspective) eye += offset;
    dvec3 far = 2.0LF * dvec3(transport.halfSize.xyz) - 0.5LF;
    double enter = 0.0LF;
    double leave = 1.0e300LF;
    for (int i = 0; i < 3; ++i) {
        if (towards[i] == 0.0LF) {
            if (eye[i] < -0.5LF || eye[i] > far[i]) leave = -1.0LF;
        } else {
            double a = (-0.5LF - eye[i]) / towards[i];
            double b = (far[i] - eye[i]) / towards[i];
            enter = max(enter, min(a, b));
            leave = min(leave, max(a, b));
        }
    }
    bool hits = enter < leave;
    vec3 start = hits ? clampToDomain(vec3(eye + enter * towards)) : vec3(eye);
    return CameraRay(start, vec3(eye), eye, vec3(towards), hits, hits && enter == 0.0LF, true);
}
