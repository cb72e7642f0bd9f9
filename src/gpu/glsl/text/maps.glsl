// maps.glsl: the values of a material's maps at a point, once for each side (glsl_samplers.c). The same rules apply as in
// src/core/cpu/shade/textures.inc. For a map NAME, has_NAME is true if the side has the map. NAME_rgb, NAME_alpha and
// NAME_number are replaced by its colour, its alpha and its channel, including the map's scale and offset. own_FIELD is
// replaced by a field of the side's material.

if (!of_back) {
    // The values of maps at a point.
    STRUCT(surface_maps)
    {
        vec3 color; // factor of the diffuse or base colour
        vec3 ambient; // factor of the ambient colour
        vec3 specular; // factor of the highlights
        vec3 emission; // factor of the emission
        vec3 normal; // components of the normal along tangent, bitangent and the mesh's normal
        float opacity; // factor of the opacity
        float shininess; // exponent of the highlights
        float occlusion; // unoccluded share of ambient light
        float roughness; // 0 a mirror, 1 matt
        float metallic; // 0 a dielectric, 1 a metal
        float dielectric; // factor of the diffuse light
        vec2 slopes; // slopes of the surface along `across` and `down`
        vec3 across; // direction of the picture's rows in eye space, not unit
        vec3 down; // direction of the picture's columns
        float level; // level of detail
        vec3 coat_normal; // components of the coat's normal
        float normal_variance; // the variance of the normals within the pixel
        float coat_variance; // the variance of the coat's normals
        vec3 stretch; // direction of the stretch by tangent and bitangent, and its strength
        LAYER_MEMBERS;
    };

    // Returns the values of the maps of the front at the point.
} else {
    // Returns the values of the maps of the back at the point.
}
surface_maps MAPS_OF_SIDE(footprint first, footprint second, vec3 p, vec4 tint)
{
    surface_maps maps;
    TEXELS;
    maps.color = has_diffuse ? diffuse_rgb : vec3(1.0);
    maps.ambient = has_ambient ? ambient_rgb : any_diffuse ? maps.color : vec3(1.0);
    maps.specular = has_specular ? specular_rgb : vec3(1.0);
    maps.emission = has_emission ? emission_rgb : vec3(1.0);
    if (has_normal) {
        maps.normal = vec3((normal_texel.xy * 2.0 - 1.0) * normal_scale, normal_texel.z * 2.0 - 1.0);
        if (normal_scale == 0.0) {
            maps.normal = vec3(0.0, 0.0, 1.0);
        }
    } else {
        maps.normal = vec3(0.0, 0.0, 1.0);
    }
    if (has_clearcoat_normal) {
        maps.coat_normal = vec3((clearcoat_normal_texel.xy * 2.0 - 1.0) * clearcoat_normal_scale, clearcoat_normal_texel.z * 2.0 - 1.0);
        if (clearcoat_normal_scale == 0.0) {
            maps.coat_normal = vec3(0.0, 0.0, 1.0);
        }
    } else {
        maps.coat_normal = vec3(0.0, 0.0, 1.0);
    }
    maps.normal_variance = has_normal ? map_variance(normal_texel.xyz * 2.0 - 1.0, normal_scale, normal_level) : 0.0;
    maps.coat_variance = has_clearcoat_normal
        ? map_variance(clearcoat_normal_texel.xyz * 2.0 - 1.0, clearcoat_normal_scale, clearcoat_normal_level) : 0.0;
    maps.level = LEVEL;
    if (has_bump && !shows_level) {
        // The heights one texel of level 0 before and after the point, along rows and columns.
        vec2 one = 1.0 / vec2(textureSize(bump_picture, 0));
        float left = map_texel(bump_picture, bump_s - vec4(0.0, 0.0, one.x, 0.0), bump_t, BUMP_SAMPLING)BUMP_CHANNEL;
        float right = map_texel(bump_picture, bump_s + vec4(0.0, 0.0, one.x, 0.0), bump_t, BUMP_SAMPLING)BUMP_CHANNEL;
        float above = map_texel(bump_picture, bump_s, bump_t - vec4(0.0, 0.0, one.y, 0.0), BUMP_SAMPLING)BUMP_CHANNEL;
        float below = map_texel(bump_picture, bump_s, bump_t + vec4(0.0, 0.0, one.y, 0.0), BUMP_SAMPLING)BUMP_CHANNEL;
        maps.slopes = vec2(right - left, below - above) * (0.5 * bump_scale);
        picture_axes(p, bump_s, bump_t, BUMP_FOOTPRINT, maps.across, maps.down);
    } else {
        maps.slopes = vec2(0.0);
        maps.across = vec3(0.0);
        maps.down = vec3(0.0);
    }
    maps.opacity = has_diffuse && has_opacity ? 1.0 * (diffuse_alpha) * (opacity_number)
        : has_diffuse ? 1.0 * (diffuse_alpha)
        : has_opacity ? 1.0 * (opacity_number)
        : 1.0;
    maps.shininess = has_shininess ? own_shininess * (shininess_number) : own_shininess;
    maps.occlusion = has_occlusion ? 1.0 * (occlusion_number) : 1.0;
    maps.roughness = has_roughness ? own_roughness * (roughness_number) : own_roughness;
    maps.metallic = has_metallic ? own_metallic * (metallic_number) : own_metallic;
    maps.dielectric = varies ? 1.0 - maps.metallic : 1.0;
    LAYER_VALUES;
    if (any_anisotropy) {
        float turned = own_anisotropy_rotation_rad;
        vec3 stretch = has_anisotropy ? anisotropy_rgb : vec3(1.0, 0.5, 1.0);
        stretch.xy = stretch.xy * 2.0 - 1.0;
        stretch.xy = stretch.xy * rsqrt(dot(stretch.xy, stretch.xy));
        stretch.z = stretch.z * own_anisotropy;
        maps.stretch = vec3(cos(turned) * stretch.x - sin(turned) * stretch.y,
                            sin(turned) * stretch.x + cos(turned) * stretch.y, stretch.z);
    }
    if (is_converted) {
        float exponent = classic_exponent(maps.roughness);
        vec3 base = BASE;
        maps.specular = classic_specular(base, maps.metallic, exponent);
        maps.shininess = mirrored ? exponent * 0.25 : exponent;
    }
    return maps;
}
