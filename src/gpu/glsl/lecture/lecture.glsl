
if (!fragment) {
    ATTRIBUTES;

}
if (per_fragment) {
    VARYING vec3 eye_position;
    VARYING vec3 eye_normal;
    if (needs_tangent_attribute) {
        VARYING vec3 eye_tangent;
    }
} else {
    VARYING vec4 front_light;
    if (two_sided) {
        VARYING vec4 back_light;
    }
}
if (needs_vertex_color) {
    VARYING vec4 tint;
}
if (fragment && !glsl_120) {
    out vec4 pixel;
}
if (lights_here) {

    // The light that a point P with the unit normal N sends to the eye. All vectors are in eye space: the eye is at the origin.
    vec3 lit(PARAMETERS)
    {
        if (!products) {
            if (highlights) {
                vec3 ka = material.ambient.rgb, kd = material.diffuse.rgb, ks = material.specular.rgb;
            } else {
                vec3 ka = material.ambient.rgb, kd = material.diffuse.rgb;
            }
        }
        if (highlights || has_environment) {
            if (distant_viewer) {
                const vec3 V = vec3(0.0, 0.0, 1.0); // towards an infinitely distant eye
            } else {
                vec3 V = normalize(-P);         // from the point to the eye
            }
        }
        if (needs_tangent) {
            if (!tangents) {
                vec3 T = cross(normalize(model_view[1].xyz), N); // around the mesh's y axis, like the marks of a lathe
                if (dot(T, T) < 1.0e-8)
                    T = model_view[0].xyz;      // along x if N is parallel to y
            }
            T = normalize(T - dot(T, N) * N); // the direction of the threads, along the surface
        }
        if (products) {
            vec3 ambient = vertex_colors ? tint.rgb * ambient_product.rgb : ambient_product.rgb; // ka La
        } else {
            vec3 ambient = vertex_colors ? tint.rgb * ka * ambient_light.rgb : ka * ambient_light.rgb;
        }
        if (has_hemispheres) {
            for (int i = 0; i < HEMISPHERES; i++) { // the sky above, the ground below
                if (products) {
                    ambient += vertex_colors ? tint.rgb * mix(ground_product[i].rgb, sky_product[i].rgb, 0.5 + 0.5 * dot(N, hemispheres[i].up.xyz)) : mix(ground_product[i].rgb, sky_product[i].rgb, 0.5 + 0.5 * dot(N, hemispheres[i].up.xyz));
                } else {
                    vec3 sky = hemispheres[i].sky.rgb, ground = hemispheres[i].ground.rgb;
                    ambient += vertex_colors ? tint.rgb * SKY_COLOR * mix(ground, sky, 0.5 + 0.5 * dot(N, hemispheres[i].up.xyz)) : SKY_COLOR * mix(ground, sky, 0.5 + 0.5 * dot(N, hemispheres[i].up.xyz));
                }
            }
        }
        vec3 color = EMISSION + ambient;
        if (has_lights) {
            for (int i = 0; i < LIGHTS; i++) {
                vec3 way = WAY;
                vec3 L = normalize(way);    // from the point to the light
                if (has_falloff) {
                    float d = length(way);      // the light's distance
                    vec4 a = lights[i].attenuation;
                    float attenuation = 1.0 / (a.x + a.y * d + a.z * d * d);
                    if (has_range) {
                        attenuation *= clamp(1.0 - pow(d * a.w, 4.0), 0.0, 1.0); // 0 beyond the range
                    }
                }
                if (has_cone) {
                    float c = dot(-L, lights[i].direction.xyz); // cosine of the angle from the spotlight's axis
                    if (has_cutoff) {
                        float cutoff = lights[i].cone.x, exponent = lights[i].cone.y;
                    }
            SPOTS;
                }
                if (needs_tangent) {
                    float sin_TL = length(cross(T, L)), sin_TV = length(cross(T, V));
                    if (gated_threads) {
                        float faces = dot(N, L) > 0.0 || FIBRE > 0.5 ? 1.0 : 0.0; // a fibre has no inside
                        vec3 diffuse = DIFFUSE_LIGHT * faces * sin_TL; // Kajiya and Kay
                        float S = faces * pow(max(sin_TL * sin_TV - dot(T, L) * dot(T, V), 0.0), SHININESS);
                    } else {
                        vec3 diffuse = DIFFUSE_LIGHT * sin_TL; // Kajiya and Kay
                        float S = pow(max(sin_TL * sin_TV + dot(T, L) * dot(T, V), 0.0), SHININESS); // the sign that some lectures print
                    }
                } else if (toon) {
                    vec3 diffuse = DIFFUSE_LIGHT * ceil(STEPS * max(dot(N, L), 0.0) - 1.0e-5) / STEPS; // flat steps of light
                    vec3 H = normalize(L + V);
                    float S = dot(N, L) > 0.0 && pow(max(dot(N, H), 0.0), SHININESS) >= 0.5 ? 1.0 : 0.0; // an edge
                } else if (toned) {
                    float w = 0.5 + 0.5 * dot(N, L); // Gooch: 1 towards the light, 0 away from it
                    vec3 diffuse = DIFFUSE_LIGHT * mix(0.2, 0.6, w);
                    vec3 S = vec3(w, w, 1.0 - w); // yellow towards the light, blue away from it
                } else {
                    vec3 diffuse = DIFFUSE_LIGHT * max(dot(N, L), 0.0); // Lambert
                }
                if (phong) {
                    vec3 R = reflect(-L, N);    // the mirror image of L
                    float S = dot(N, L) > 0.0 ? pow(max(dot(R, V), 0.0), SHININESS) : 0.0; // Phong
                }
                if (blinn_phong) {
                    vec3 H = normalize(L + V);  // halfway between L and V
                    float S = dot(N, L) > 0.0 ? pow(max(dot(N, H), 0.0), SHININESS) : 0.0; // Blinn and Phong
                }
                if (highlights) {
                    vec3 specular = SPECULAR_LIGHT * S;
                    color += has_cone || has_falloff ? ARRIVING * (diffuse + specular) : (diffuse + specular);
                } else {
                    color += has_cone || has_falloff ? ARRIVING * diffuse : diffuse;
                }
            }
        }
        if (has_environment) {
            vec3 mirrored = environment_matrix * reflect(-V, N); // the reflected line of sight
            color = color + REFLECTIVITY * TEXTURE_CUBE(environment, mirrored).rgb;
        }
        return color;
    }
}
if (fragment && encodes) {

    // Converts linear light to the sRGB values of a screen.
    vec3 encode(vec3 light)
    {
        vec3 x = clamp(light, 0.0, 1.0);
        return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
    }
}

void main()
{
    if (fragment) {
        if (per_fragment) {
            vec3 N = normalize(eye_normal); // interpolation made it shorter
            if (two_sided) {
                if (!gl_FrontFacing)
                    N = -N;                     // the back is lit too
            }
            vec4 light = vec4(lit(ARGUMENTS), OPACITY);
        } else {
            if (two_sided) {
                vec4 light = gl_FrontFacing ? front_light : back_light;
            } else {
                vec4 light = front_light;
            }
        }
        if (encodes) {
            pixel = vec4(encode(light.rgb), light.a);
        } else if (premultiplied) {
            pixel = vec4(light.rgb * light.a, light.a);
        } else {
            pixel = light;
        }
    } else {
        gl_Position = model_view_projection * vec4(position, 1.0);
        if (per_fragment) {
            eye_position = (model_view * vec4(LIT_POSITION, 1.0)).xyz;
            eye_normal = normalize(normal_matrix * normal);
            if (needs_tangent_attribute) {
                eye_tangent = normalize(mat3(model_view) * tangent);
            }
            if (needs_vertex_color) {
                tint = color;
            }
        } else if (application) {
            front_light = front_color; // lit by the application
            if (two_sided) {
                back_light = back_color;
            }
        } else {
            vec3 eye_position = (model_view * vec4(LIT_POSITION, 1.0)).xyz;
            vec3 N = normalize(normal_matrix * normal);
            if (needs_tangent_attribute) {
                vec3 T = normalize(mat3(model_view) * tangent);
            }
            front_light = vec4(lit(ARGUMENTS), OPACITY);
            if (two_sided) {
                N = -N; // the back is lit too; the fragment shader chooses
                back_light = vec4(lit(ARGUMENTS), OPACITY);
            }
        }
    }
}
