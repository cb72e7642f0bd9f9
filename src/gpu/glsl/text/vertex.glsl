// vertex.glsl: the vertex shader's main function.

#include "interface.glsl"

void main()
{
    gl_Position = model_view_projection * vec4(position, 1.0);
    if (output_ids || depth_ids || shadows) {
        triangle = gl_VertexID / 3;
    }
    if (one_point) {
        int corner = gl_VertexID % 3;
        corner_weights = vec3(corner == 0, corner == 1, corner == 2);
    }
    if (first_texcoords) {
        surface_texcoord = texcoord;
    }
    if (second_texcoords) {
        surface_second_texcoord = second_texcoord;
    }
    if (needs_vertex_color) {
        tint = color;
    }
    if (per_fragment) {
        if (needs_position) {
            eye_position = (model_view * vec4(LIT_POSITION, 1.0)).xyz;
        }
        if (needs_normal) {
            eye_normal = unit3(normal_matrix * normal);
        }
        if (needs_tangent_attribute) {
            eye_tangent = unit3(mat3(model_view) * TANGENT);
        }
        if (signed_tangent) {
            // If the object's transform mirrors, the bitangent is reversed.
            mat3 axes = mat3(model_view);
            bitangent_sign = dot3(cross3(axes[0], axes[1]), axes[2]) < 0.0 ? -tangent.w : tangent.w;
        }
    } else if (application) {
        front_light = front_color;
        if (two_sided) {
            back_light = back_color;
        }
        if (separate_texture_terms) {
            front_rest = front_plain;
            if (two_sided) {
                back_rest = back_plain;
            }
        }
    } else {
        if (needs_normal) {
            vec3 p = (model_view * vec4(LIT_POSITION, 1.0)).xyz;
            vec3 n = unit3(normal_matrix * normal);
        }
        if (needs_tangent_attribute) {
            vec3 t = unit3(mat3(model_view) * TANGENT);
        }
        if (has_anisotropy && tangents) {
            mat3 axes = mat3(model_view);
            float turn = dot3(cross3(axes[0], axes[1]), axes[2]) < 0.0 ? -tangent.w : tangent.w;
        } else {
            float turn = 1.0;
        }
        if (shadows) {
            lit_triangle = first_triangle + gl_VertexID / 3;
            lit_corner = gl_VertexID % 3;
        }
        if (two_sided) {
            // Both sides are lit; the fragment shader selects the visible one.
        }
        front_light = light_point(p, n, tangent_field ? field_tangent(unit3(n), model_view[1].xyz, model_view[0].xyz) : t, turn,
            coat, color, true, maps, front_rest);
        if (two_sided) {
            if (needs_normal) {
                n = negate3(n);
            }
            back_light = light_point(p, n, tangent_field ? field_tangent(unit3(n), model_view[1].xyz, model_view[0].xyz) : t, -turn,
                coat, color, false, maps, back_rest);
        }
    }
}
