// refraction.h: the effect of a transmitting surface on the picture behind it. The formulas are from the implementation
// notes of KHR_materials_transmission, KHR_materials_volume and KHR_materials_ior; three.js and the Khronos sample
// viewer use the same formulas. OpenGL rejects rough and thick glass, unless its index of refraction is 1.

// Returns the direction of a ray from the eye after refraction (Snell). v is the unit direction to the eye, and n is
// the unit normal on the eye's side. The index of refraction is at least 1.
FN vec3 refracted3(vec3 v, vec3 n, num ior)
{
    num inverse = 1.0f / ior, c = positive(cosine(dot3(v, n)));
    num inside = square_root(positive(1.0f - (1.0f - c * c) * (inverse * inverse)));
    return unit3(sub3(scale3(n, c * inverse - inside), scale3(v, inverse)));
}

// Scales the part of a direction that is along an axis by the length of the axis.
FN vec3 scaled_along(vec3 direction, vec3 axis)
{
    return scale3(axis, dot3(direction, axis) / square_root(max_of(dot3(axis, axis), num_of(1.0e-30f))));
}

// Returns the path of a ray through a volume of thickness 1 behind a surface: the refracted direction, scaled along each
// axis of the mesh. x, y and z are the columns of the matrix from mesh space to the space of v and n. For meshes that are
// not rotated, this is the formula of three.js and the Khronos sample viewer. They scale the world's coordinates, so
// their path changes if a model that is not scaled uniformly is turned together with its camera.
FN vec3 volume_path(vec3 v, vec3 n, num ior, vec3 x, vec3 y, vec3 z)
{
    vec3 direction = refracted3(v, n, max_of(ior, num_of(1.0f)));
    return add3(add3(scaled_along(direction, x), scaled_along(direction, y)), scaled_along(direction, z));
}

// Returns the width over which a surface blurs the picture behind it, as a fraction of the picture's height: 1024^(r -
// 1) with r = roughness min(2 ior - 2, 1), at most 1/8. In a picture 1024 pixels high, this width is one texel of
// mipmap level r log2(1024), which three.js reads. The limit is reached at r = 0.7. Without the limit, the roughest
// glass would show the mean colour of the whole picture, including the background. Returns 0 for r = 0.
FN num transmission_blur(num roughness, num ior)
{
    num r = roughness * min_of(positive(2.0f * ior - 2.0f), num_of(1.0f));
    return pick(r > 0.0f, exp2_of(min_of(10.0f * r - 10.0f, num_of(-3.0f))), num_of(0.0f));
}
