//@if per_vertex
//@if shadows

uniform int first_triangle; // number of the draw's first triangle
//@end
//@end

void main()
{
    gl_Position = model_view_projection * vec4(position, 1.0);
//@if output_ids depth_ids shadows
    triangle = gl_VertexID / 3;
//@end
//@if first_texcoords
    surface_texcoord = texcoord;
//@end
//@if second_texcoords
    surface_second_texcoord = second_texcoord;
//@end
//@if needs_vertex_color
    tint = color;
//@end
//@if per_fragment
//@if needs_position
    eye_position = (model_view * vec4(@lit_position@, 1.0)).xyz;
//@end
//@if needs_normal
    eye_normal = unit3(normal_matrix * normal);
//@end
//@if needs_tangent_attribute
    eye_tangent = unit3(mat3(model_view) * @tangent@);
//@end
//@if signed_tangent
    // A mirroring object turns the bitangent round.
    mat3 axes = mat3(model_view);
    bitangent_sign = dot3(cross3(axes[0], axes[1]), axes[2]) < 0.0 ? -tangent.w : tangent.w;
//@end
//@elif application
    front_light = front_color;
//@if two_sided
    back_light = back_color;
//@end
//@if separate_texture_terms
    front_rest = front_plain;
//@if two_sided
    back_rest = back_plain;
//@end
//@end
//@else
//@if needs_normal
    vec3 p = (model_view * vec4(@lit_position@, 1.0)).xyz;
    vec3 n = unit3(normal_matrix * normal);
//@end
//@if needs_tangent_attribute
    vec3 t = unit3(mat3(model_view) * @tangent@);
//@end
//@if has_anisotropy
//@if tangents
    mat3 axes = mat3(model_view);
    float turn = dot3(cross3(axes[0], axes[1]), axes[2]) < 0.0 ? -tangent.w : tangent.w;
//@else
    float turn = 1.0;
//@end
//@end
//@if shadows
    lit_triangle = first_triangle + gl_VertexID / 3;
    lit_corner = gl_VertexID % 3;
//@end
//@if two_sided
    // Both sides are lit; the fragment shader selects the visible one.
//@end
    front_light = light_point(@front_arguments@);
//@if two_sided
//@if needs_normal
    n = negate3(n);
//@end
    back_light = light_point(@back_arguments@);
//@end
//@end
}
