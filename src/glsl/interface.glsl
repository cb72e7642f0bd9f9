
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
//@if passes_tint
@varying@vec4 tint;
//@end
//@elif !output_geometry
@varying@vec4 front_light;
//@if two_sided
@varying@vec4 back_light;
//@end
//@if apart
@varying@vec3 front_rest;
//@if two_sided
@varying@vec3 back_rest;
//@end
//@end
//@if passes_tint
@smooth_varying@vec4 tint;
//@end
//@end
//@if first_texcoords
@smooth_varying@vec2 surface_texcoord;
//@end
//@if second_texcoords
@smooth_varying@vec2 surface_second_texcoord;
//@end
//@if triangle_ids
@flat_varying@int triangle;
//@end
