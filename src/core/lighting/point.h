// point.h: a point before lighting: its normal and tangent, and the material after its maps.
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl).
#pragma once

// Returns the tangent of a surface without tangents. It runs around the mesh's y axis, like the marks of a lathe, or
// along x if n is parallel to y. n is unit; y and x are the mesh's axes in eye space.
FN vec3 field_tangent(vec3 n, vec3 y, vec3 x)
{
    vec3 around = cross3(unit3(y), n);
    return pick3(dot3(around, around) < 1.0e-8f, unit3(x), around);
}

// Returns the normal from a normal map, whose components are along the tangent, the bitangent and the normal. None of
// these three vectors is normalised after interpolation (MikkTSpace).
FN vec3 mapped_normal(vec3 map, vec3 tangent, vec3 bitangent, vec3 normal)
{
    return add3(add3(scale3(tangent, map.x), scale3(bitangent, map.y)), scale3(normal, map.z));
}

// Specular antialiasing (lam_specular_aa): if the normal varies within a pixel, a narrow highlight falls between the samples. The
// variance of the normal therefore widens the lobe (Kaplanyan and Tokuyoshi, "Stable geometric specular antialiasing with
// projected-space NDF filtering", 2021):
//     alpha'^2 = alpha^2 + min(2 variance, 0.18)
#define WIDENED_MOST 0.18f

FN num widened_roughness(num roughness, num variance)
{
    num least = max_of(roughness, num_of(ROUGHNESS_MIN));
    num alpha = least * least;
    num square = min_of(alpha * alpha + min_of(2.0f * variance, num_of(WIDENED_MOST)), num_of(1.0f));
    return pick(variance > 0.0f, square_root(square_root(square)), roughness);
}

// Returns the variance of the unit normal over a pixel, from an interpolated normal of any length and its derivatives
// with respect to the window's x and y. Positions within a pixel have the variance 1/12. The value 1 / (2 pi) of the
// paper would blur the reflections of small mirrors. Only the part of a derivative that is perpendicular to the normal
// turns it.
FN num normal_variance(vec3 normal, vec3 by_x, vec3 by_y)
{
    num inverse = rsqrt(dot3(normal, normal));
    vec3 n = scale3(normal, inverse);
    vec3 turn_x = scale3(sub3(by_x, scale3(n, dot3(n, by_x))), inverse);
    vec3 turn_y = scale3(sub3(by_y, scale3(n, dot3(n, by_y))), inverse);
    return 0.083333336f * (dot3(turn_x, turn_x) + dot3(turn_y, turn_y));
}

// Toksvig, "Mipmapping normal maps" (2005): the texels of a normal map are unit vectors. If their mean has the length r, their
// variance is (1 - r) / r. `mean` is a filtered texel, before `scale` multiplies its slopes. A magnified map (detail <= 0) has no
// variance. Texels of 8 bits are up to 0.003 too short.
FN num map_variance(vec3 mean, num scale, num detail)
{
    num length = min_of(square_root(dot3(mean, mean)) + 0.003f, num_of(1.0f));
    return saturate(detail) * (scale * scale) * ((1.0f - length) / max_of(length, num_of(0.1f)));
}

// Blinn, "Simulation of wrinkled surfaces" (1978): returns the unit normal n, tilted by the slopes of a bump map. The
// directions of increasing columns and rows of the picture may have any length.
FN vec3 bumped_normal(vec3 n, vec3 across, vec3 down, num slope_across, num slope_down)
{
    return sub3(n, add3(scale3(perpendicular3(across, n), slope_across), scale3(perpendicular3(down, n), slope_down)));
}

// Convert a metallic-roughness material for a classic model (lam_material_as_classic): the exponent and the strength of
// its highlight.
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

// Returns the direction along a surface with the components x along the tangent and y along the bitangent; y already
// includes the sign of the bitangent.
FN vec3 along_surface(vec3 n, vec3 tangent, num x, num y)
{
    return unit3(add3(scale3(tangent, x), scale3(cross3(n, tangent), y)));
}

// Returns the factor of ambient occlusion for a light: the fraction `occluded` of the light is treated as surrounding
// light, and the fraction `share` of that arrives.
FN num unoccluded_light(num occluded, num share) { return 1.0f - occluded * (1.0f - share); }
