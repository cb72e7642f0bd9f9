
//@if fragment
// --- the fragment shader
//@else
// --- the vertex shader

@attributes@
//@end
//@if has_varyings

//@end
//@if per_fragment
//@if passes_position
@varying@vec3 eye_position;
//@end
//@if passes_normal
@varying@vec3 eye_normal;
//@end
//@if passes_tangent
@varying@vec3 eye_tangent;
//@end
//@if signed_tangent
@varying@float bitangent_sign;
//@end
//@if first_texcoords
@varying@vec2 surface_texcoord;
//@end
//@if second_texcoords
@varying@vec2 surface_second_texcoord;
//@end
//@if vertex_colors
@varying@vec4 tint;
//@end
//@else
@varying@vec4 front_light;
//@if two_sided
@varying@vec4 back_light;
//@end
//@end
//@if triangle_ids
@flat_varying@int triangle;
//@end
