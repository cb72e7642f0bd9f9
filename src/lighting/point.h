// point.h: a point before lighting: its normal and tangent, and the material after its maps.
//
// One text for C and GLSL (prelude_c.h, prelude.glsl).

// The tangent of a surface without tangents: around the mesh's y axis, like the marks of a lathe; along x if n is along
// y. n is unit; y and x are the mesh's axes in eye space.
FN vec3 field_tangent(vec3 n, vec3 y, vec3 x)
{
    vec3 around = cross3(unit3(y), n);
    return pick3(dot3(around, around) < 1.0e-8f, unit3(x), around);
}

// The normal from a normal map, given along tangent, bitangent and normal, none of which is normalised after
// interpolation (MikkTSpace).
FN vec3 mapped_normal(vec3 map, vec3 tangent, vec3 bitangent, vec3 normal)
{
    return add3(add3(scale3(tangent, map.x), scale3(bitangent, map.y)), scale3(normal, map.z));
}

// Blinn, "Simulation of wrinkled surfaces" (1978): the unit normal n, tilted by the slopes of a bump map along the
// directions of increasing columns and rows of the picture, of any length.
FN vec3 bumped_normal(vec3 n, vec3 across, vec3 down, num slope_across, num slope_down)
{
    return sub3(n, add3(scale3(perpendicular3(across, n), slope_across), scale3(perpendicular3(down, n), slope_down)));
}

// A metallic-roughness material under a classic model (lam_material_as_classic): the exponent and the strength of its
// highlight.
FN num classic_exponent(num roughness)
{
    num slope = roughness * roughness;
    num exponent = 2.0f / max_of(slope * slope, num_of(1.0e-12f)) - 2.0f;
    return min_of(max_of(exponent, num_of(1.0f)), num_of(4096.0f));
}

FN vec3 classic_specular(vec3 base, num metallic, num exponent)
{
    vec3 f0 = vec3_of(num_of(DIELECTRIC_F0), num_of(DIELECTRIC_F0), num_of(DIELECTRIC_F0));
    return scale3(mix3(f0, base, metallic), (exponent + 8.0f) * 0.125f);
}

// The direction along a surface with the components x along the tangent and y along the bitangent; the sign of the
// bitangent is part of y.
FN vec3 along_surface(vec3 n, vec3 tangent, num x, num y)
{
    return unit3(add3(scale3(tangent, x), scale3(cross3(n, tangent), y)));
}

// The factor of ambient occlusion for a light: the fraction `occluded` of it counts as surrounding light, of which
// `share` arrives.
FN num unoccluded_light(num occluded, num share) { return 1.0f - occluded * (1.0f - share); }
