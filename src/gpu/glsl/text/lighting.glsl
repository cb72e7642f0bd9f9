// lighting.glsl: the light that leaves a point.
//
// As in all files of this folder, the conditions of `if` and ?: may be facts of a program (glsl_declarations.h, glsl.c),
// and names in capitals are replaced by texts that depend on its choices. A branch with such a condition is not a
// scope. Code that a program does not need is removed (glsl_text.h).

// The share of the light behind it that the last lit point transmits.
vec3 passing = vec3(0.0);
// The variance of the normals of the surface and of its coat within the pixel.
float pixel_variance = 0.0;
float coat_variance = 0.0;

if (unlit) {
    // The colour and opacity of an unlit surface.
} else {
    // The light that leaves the point p of a surface towards the eye, and the opacity. The normal is on the visible side and has
    // any length; p and normal are in eye space.
}
// `tint` is the vertex colour: a factor of the ambient and diffuse terms, and of the opacity.
// `maps` contains the values of the material's maps at the point.
// `rest` is the part of the light that the diffuse map does not multiply.
vec4 light_point(vec3 p, vec3 normal, vec3 tangent, float turn, vec3 coat, vec4 tint, bool front, surface_maps maps, out vec3 rest)
{
    if (!products) {
        Material m = material;
        if (back_material && !front) {
            m = back_material;
        }
    }
    surface s;
    s.p = p;
    s.n = unit3(normal);
    s.v = to_eye(p, VIEWER);
    s.t = needs_tangent ? perpendicular3(tangent, s.n) : black3();
    if (output_one_light) {
        light_source light;
        light.position = (lights_in_texture ? texelFetch(light_list, ivec2(0, 0), 0) : lights[0].position).xyz;
        light.direction = (lights_in_texture ? texelFetch(light_list, ivec2(1, 0), 0) : lights[0].direction).xyz;
        vec3 l = toward_light(s.p, light, LIGHT_KIND, FALLOFF_NONE).l;
        float c = cosine(dot3(s.n, output_n_l ? l : halfway3(l, s.v)));
        return vec4(c, c, c, 1.0);
    } else if (output_vector) {
        return vec4(output_tangents ? s.t : s.n, 1.0);
    } else {
        if (unlit) {
            terms sum = unlit_terms((products ? front ? diffuse : back_diffuse : m.diffuse).rgb);
        } else {
            if (products) {
                terms sum = start_terms((front ? ambient_product : back_ambient_product).rgb,
                    (front ? emission : back_emission).rgb);
            } else {
                terms sum = start_terms(mul3(m.ambient.rgb, ambient_light.rgb), m.emission.rgb);
            }
            OWN_PARAMETERS;
            if (widens_roughness) {
                float widened = widened_roughness(OWN_ROUGHNESS, pixel_variance);
            }
            if (has_hemispheres) {
                for (int i = 0; i < HEMISPHERES; i++) {
                    sum = add_hemisphere(sum, s, hemisphere_of(i, m, front));
                }
            }
            if (microfacet) {
                vec3 base = (products ? front ? diffuse : back_diffuse : m.diffuse).rgb;
                if (vertex_colors) {
                    base = mul3(base, tint.rgb);
                }
                if (map_color) {
                    base = mul3(base, maps.color);
                }
                if (layered) {
                    layer_values given;
                    given.base = base;
                    given.metallic = METALLIC;
                    given.roughness = ROUGHNESS;
                    if (has_clearcoat) {
                        given.clearcoat_normal = has_coat_normal ? unit3(coat) : s.n;
                    }
                    LAYERS;
                    if (widens_roughness && has_clearcoat) {
                        given.clearcoat_roughness = widened_roughness(given.clearcoat_roughness, coat_variance);
                    }
                    layered layering = layered_of(s, given, 0, 0);
                } else {
                    fresnel mirror = fresnel_of(base, METALLIC, single_scattering ? 0.0 : scattering_gain(s, ROUGHNESS));
                }
            }
            if (shadows && has_lights) {
                start_rays(s.p, lit_triangle, two_sided && per_fragment ? gl_FrontFacing ? 1.0 : -1.0 : 1.0);
            }
            LIGHTS;
            if (map_dielectric) {
                sum.diffuse = scale3(sum.diffuse, maps.dielectric);
            }
            if (map_specular) {
                sum.specular = mul3(sum.specular, maps.specular);
            }
            if (map_emission) {
                sum.emission = mul3(sum.emission, maps.emission);
            }
            if (map_occlusion) {
                sum.ambient = scale3(sum.ambient, maps.occlusion);
            }
            if (occluded) {
                sum.ambient = scale3(sum.ambient, unoccluded_share());
            }
            if (layered) {
                sum = cover_terms(sum, layering, 0);
                if (has_transmission) {
                    passing = layered_transmittance(s, layering, given, 0);
                }
            }
        }
        if (map_ambient) {
            sum.ambient = mul3(sum.ambient, maps.ambient);
            if (map_color) {
                sum.diffuse = mul3(sum.diffuse, maps.color);
            }
        } else if (map_color) {
            sum = tint_terms(sum, maps.color);
        }
        if (vertex_colors) {
            sum = tint_terms(sum, tint.rgb);
        }
        if (has_environment) {
            if (present(s.n) && present(s.v)) {
                if (environment_light) {
                    vec3 matt = scale3(base, 1.0 - METALLIC);
                    if (layered) {
                        layered_around around = layered_around_of(s, given, layering, 0);
                        returned_light arriving = layered_surroundings(s, layering, matt, around.base, around.top, 0);
                    } else {
                        returned_light arriving = surroundings_light(mirror, matt, surroundings_of(s, ROUGHNESS));
                    }
                    if (map_occlusion) {
                        arriving = scale_returned(arriving, maps.occlusion);
                    }
                    if (occluded) {
                        arriving = scale_returned(arriving, unoccluded_share());
                    }
                    sum = add_returned(sum, arriving);
                } else {
                    sum = add_environment(sum, (products ? front ? reflectivity : back_reflectivity : m.reflectivity).rgb,
                        environment_color(mirror3(s.v, s.n)));
                }
            }
        }
        if (output_material) {
            OWN_PARAMETERS;
            return vec4(shows_base_color ? sum.diffuse
                : shows_occlusion ? vec3(map_occlusion ? maps.occlusion : 1.0)
                : shows_level ? vec3(level_in_maps ? maps.level : 0.0)
                : is_physical ? vec3(shows_roughness ? ROUGHNESS : METALLIC)
                : vec3(0.0), 1.0);
        } else {
            if (separate_texture_terms) {
                vec3 color = shows_ambient && shows_diffuse ? add3(sum.ambient, sum.diffuse)
                    : shows_ambient ? sum.ambient
                    : shows_diffuse ? sum.diffuse
                    : black3();
                rest = shows_all && emission_map_last ? add3(sum.specular, sum.reflection)
                    : shows_all ? add3(add3(sum.emission, sum.specular), sum.reflection)
                    : shows_around ? add3(sum.specular, sum.reflection)
                    : shows_specular ? sum.specular
                    : shows_emission && !emission_map_last ? sum.emission
                    : shows_reflection ? sum.reflection
                    : black3();
                if (clamped) {
                    rest = vec3(saturate(rest.x), saturate(rest.y), saturate(rest.z));
                }
            } else {
                vec3 color = shows_all ? sum_terms(sum)
                    : shows_around ? add3(add3(sum.diffuse, sum.specular), sum.reflection)
                    : shows_diffuse && shows_specular ? add3(add3(sum.ambient, sum.diffuse), sum.specular)
                    : shows_ambient ? sum.ambient
                    : shows_diffuse ? sum.diffuse
                    : shows_specular ? sum.specular
                    : shows_emission ? sum.emission
                    : shows_reflection ? sum.reflection
                    : black3();
            }
            if (clamped) {
                // As in OpenGL 1, the colour of a vertex is clamped to 0...1.
                color = vec3(saturate(color.x), saturate(color.y), saturate(color.z));
            }
            float opacity = (products ? front ? diffuse : back_diffuse : m.diffuse).a;
            if (vertex_colors) {
                opacity = opacity * tint.a;
            }
            if (map_opacity) {
                opacity = opacity * maps.opacity;
            }
            if (clamped) {
                opacity = saturate(opacity);
            }
            return vec4(color, opacity);
        }
    }
}
