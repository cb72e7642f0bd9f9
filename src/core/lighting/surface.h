// surface.h: a point of a surface, the vectors around it, and the numbers that reflection models and maps share.
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl).
#pragma once

STRUCT(surface)
{
    vec3 p; // the point
    vec3 n; // the surface's normal, on the visible side
    vec3 v; // towards the eye
    vec3 t; // along the surface, perpendicular to n; for the lobes of threads
};

// Clamps a dot product of unit vectors to -1...1, which rounding may exceed.
FN num cosine(num x) { return min_of(max_of(x, num_of(-1.0f)), num_of(1.0f)); }

// Returns whether a direction exists: it is not the zero vector.
FN mask present(vec3 w) { return dot3(w, w) > 0.0f; }

// Returns the mirror image of w about n:
//    2 (n.w) n - w
// For l, the result is the r of textbooks. For v, it is the direction in which an environment is looked up.
FN vec3 mirror3(vec3 w, vec3 n) { return sub3(scale3(n, 2.0f * dot3(n, w)), w); }

// Returns the unit vector halfway between l and v, both of length 1.
FN vec3 halfway3(vec3 l, vec3 v) { return unit3(add3(l, v)); }

// Returns the component of w perpendicular to n, as a unit vector (Gram and Schmidt). Returns 0 if w is parallel to n,
// that is, if |w x n| < 1e-4 |w|; the component would then be only rounding error.
FN vec3 perpendicular3(vec3 w, vec3 n)
{
    vec3 across = sub3(w, scale3(n, dot3(n, w)));
    mask along = dot3(across, across) < 1.0e-8f * dot3(w, w);
    return unit3(pick3(along, vec3_of(num_of(0.0f), num_of(0.0f), num_of(0.0f)), across));
}

// Below this roughness, the highlight of a light without a size would be smaller than a pixel.
#define ROUGHNESS_MIN 0.045f

// The reflectance of a dielectric along its normal, for an index of refraction of 1.5.
#define DIELECTRIC_F0 0.04f

// The viewer is at the eye's position (local), or infinitely far in front of the scene, as for an orthographic camera.
#define VIEWER_LOCAL    0
#define VIEWER_INFINITE 1

FN vec3 black3(void) { return vec3_of(num_of(0.0f), num_of(0.0f), num_of(0.0f)); }

// Returns the direction from p to the eye, which is at the origin of eye space.
FN vec3 to_eye(vec3 p, int viewer)
{
    vec3 v = vec3_of(num_of(0.0f), num_of(0.0f), num_of(1.0f));
    if (viewer == VIEWER_LOCAL) {
        v = unit3(negate3(p));
    }
    return v;
}

// Builds a surface from interpolated values; the normal and tangent need not be unit vectors.
FN surface surface_at(vec3 p, vec3 normal, vec3 tangent, int viewer)
{
    surface s;
    s.p = p;
    s.n = unit3(normal);
    s.v = to_eye(p, viewer);
    s.t = perpendicular3(tangent, s.n);
    return s;
}
