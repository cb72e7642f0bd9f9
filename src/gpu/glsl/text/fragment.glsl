// fragment.glsl: the fragment shader's main function.

#include "interface.glsl"

// Encodes linear light as sRGB (IEC 61966-2-1).
float encode(float x)
{
    x = saturate(x);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

void main()
{
    if (depth_ids) {
        depth_id = uvec2(floatBitsToUint(gl_FragCoord.z), uint(first_triangle + triangle) + 1u);
    }
    if (peels) {
        // At equal depth, the triangle with the lower number is in front.
        uvec2 nearer = texelFetch(nearer_depth_ids, ivec2(gl_FragCoord.xy), 0).xy;
        uvec2 opaque = texelFetch(opaque_depth_ids, ivec2(gl_FragCoord.xy), 0).xy;
        bool peeled = depth_id.x < nearer.x || (depth_id.x == nearer.x && depth_id.y <= nearer.y);
        bool hidden = opaque.y != 0u && (depth_id.x > opaque.x || (depth_id.x == opaque.x && depth_id.y > opaque.y));
        if (peeled || hidden) {
            discard;
        }
    }
    if (one_point) {
        find_point(corner_weights, value_masks ? 0 : sample_number); // the opacity of a mask is that of the sample
    }
    if (has_maps) {
        footprint first = footprint_of(surface_texcoord);
        footprint second = footprint_of(surface_second_texcoord);
        surface_maps maps = front_maps(first, second, eye_position, POINT_TINT);
        if (back_material && !gl_FrontFacing) {
            maps = back_maps(first, second, eye_position, POINT_TINT);
        }
    }
    if (value_masks) {
        float opacity = opacity_in_maps ? maps.opacity : 1.0;
        if (colors) {
            opacity = opacity * tint.a;
        }
        if (front_masked && (!back_material || gl_FrontFacing) && !(saturate(opacity) >= alpha_cutoff)) {
            discard;
        }
        if (back_masked && !gl_FrontFacing && !(saturate(opacity) >= back_alpha_cutoff)) {
            discard;
        }
    }
    if (one_point && value_masks) {
        find_point(corner_weights, sample_number);
        if (has_maps) {
            first = footprint_of(surface_texcoord);
            second = footprint_of(surface_second_texcoord);
            maps = front_maps(first, second, eye_position, POINT_TINT);
            if (back_material && !gl_FrontFacing) {
                maps = back_maps(first, second, eye_position, POINT_TINT);
            }
        }
    }
    if (output_depth) {
        float depth = -eye_position.z; // in front of the eye
        if (peels && !gl_FrontFacing) {
            depth = -depth;
        }
        pixel = vec4(depth, depth, depth, 1.0);
    } else if (output_facing) {
        float side = gl_FrontFacing ? 1.0 : -1.0;
        pixel = vec4(side, side, side, 1.0);
    } else if (output_occlusion) {
        float share = occluded ? texelFetch(ambient_occlusion, ivec2(gl_FragCoord.xy), 0).r : 1.0;
        pixel = vec4(share, share, share, 1.0);
    } else if (output_ids) {
        pixel = vec4(float(triangle % 16777216), object, float(triangle / 16777216), 1.0);
    } else if (output_geometry) {
        pixel = vec4(1.0);
    } else {
        if (per_fragment) {
            if (has_normal_map) {
                vec3 bitangent = bitangent_sign * cross3(POINT_NORMAL, POINT_TANGENT);
                vec3 n = mapped_normal(maps.normal, POINT_TANGENT, bitangent, POINT_NORMAL);
            } else {
                vec3 n = POINT_NORMAL;
            }
            if (has_coat_normal_map) {
                vec3 coat_bitangent = bitangent_sign * cross3(POINT_NORMAL, POINT_TANGENT);
                vec3 coat = mapped_normal(maps.coat_normal, POINT_TANGENT, coat_bitangent, POINT_NORMAL);
            } else {
                vec3 coat = POINT_NORMAL;
            }
            if (has_bump_map) {
                n = bumped_normal(unit3(n), maps.across, maps.down, maps.slopes.x, maps.slopes.y);
            }
            if (widens_roughness) {
                float over = gl_FragCoord.w; // as in footprint_of
                pixel_variance = normal_variance(POINT_NORMAL, (dFdx(eye_normal * over) - POINT_NORMAL * dFdx(over)) / OVER_POINT,
                    (dFdy(eye_normal * over) - POINT_NORMAL * dFdy(over)) / OVER_POINT);
                coat_variance = pixel_variance;
                if (has_normal_map) {
                    pixel_variance += maps.normal_variance;
                }
                if (has_coat_normal_map) {
                    coat_variance += maps.coat_variance;
                }
            }
            float turn = tangents ? bitangent_sign : 1.0;
            if (two_sided && !gl_FrontFacing) {
                n = negate3(n);
                coat = negate3(coat);
                turn = -turn;
            }
            if (shadows) {
                lit_triangle = first_triangle + triangle;
                if (from_vertices) {
                    lit_corner = 2; // OpenGL uses the flat values of this corner
                }
            }
            vec3 rest;
            vec4 light = light_point(POINT_POSITION, n, tangent_field ? field_tangent(unit3(n), model_view[1].xyz, model_view[0].xyz)
                : POINT_TANGENT, turn, coat, POINT_TINT, gl_FrontFacing, maps, rest);
            if (catches) {
                // Black; alpha is the share of the light that does not reach the point.
                const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
                float received = dot(luminance, light.rgb);
                unobstructed = true;
                float all = dot(luminance,
                    light_point(POINT_POSITION, n, tangent_field ? field_tangent(unit3(n), model_view[1].xyz, model_view[0].xyz)
                    : POINT_TANGENT, turn, coat, POINT_TINT, gl_FrontFacing, maps, rest).rgb);
                light = vec4(0.0, 0.0, 0.0, all > received ? light.a * (1.0 - received / all) : 0.0);
            }
        } else {
            vec4 light = front_light;
            vec3 rest = front_rest;
            if (two_sided && !gl_FrontFacing) {
                light = back_light;
                rest = back_rest;
            }
        }
        if (separate_texture_terms) {
            // The diffuse map multiplies only the ambient and the diffuse light.
            if (color_map_last) {
                light.rgb = light.rgb * maps.color;
            }
            light.rgb = light.rgb + rest;
            if (emission_map_last) {
                light.rgb = light.rgb + (!back_material || gl_FrontFacing ? glow : back_glow).rgb * maps.emission;
            }
        }
        if (opacity_map_last) {
            light.a = light.a * maps.opacity;
        }
        light.a = saturate(light.a);
        if (!output_vector && !output_material) {
            if (!value_masks && front_masked && (!back_material || gl_FrontFacing) && !(light.a >= alpha_cutoff)) {
                discard;
            }
            if (!value_masks && back_masked && !gl_FrontFacing && !(light.a >= back_alpha_cutoff)) {
                discard;
            }
            if (front_solid && back_solid) {
                light.a = 1.0;
            } else if (front_solid) {
                if (gl_FrontFacing) {
                    light.a = 1.0;
                }
            } else if (back_solid) {
                if (!gl_FrontFacing) {
                    light.a = 1.0;
                }
            }
        }
        if (writes_transmittance) {
            through = vec4(has_transmission ? 1.0 - light.a * (1.0 - passing) : vec3(1.0 - light.a), 1.0);
        } else if (blends_transmission) {
            // A single alpha for all channels: the transmitted light is blended without its colour.
            float solid = 1.0 - dot(passing, vec3(1.0 / 3.0));
            light = vec4(light.rgb / max(solid, 1.0e-3), light.a * solid);
        }
        if (exposes) {
            light.rgb = light.rgb * exposure;
        }
        if (has_tone) {
            light.rgb = saturate3(TONE(tone_input(light.rgb)));
        }
        if (encodes) {
            pixel = vec4(encode(light.r), encode(light.g), encode(light.b), light.a);
        } else if (premultiplied) {
            pixel = vec4(light.rgb * light.a, light.a);
        } else {
            pixel = light;
        }
    }
}
