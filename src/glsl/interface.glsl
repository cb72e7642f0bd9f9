
//@if fragment
// --- the fragment shader
//@else
// --- the vertex shader

@attributes@
//@end
//@if has_maps needs_vertex_color needs_position vertex_colors application per_vertex output_ids depth_ids shadows

//@end
//@if per_fragment
//@if needs_position
@varying@vec3 eye_position;
//@end
//@if needs_normal
@varying@vec3 eye_normal;
//@end
//@if needs_tangent_attribute
@varying@vec3 eye_tangent;
//@end
//@if signed_tangent
@varying@float bitangent_sign;
//@end
//@if needs_vertex_color
@varying@vec4 tint;
//@end
//@elif !output_geometry
@varying@vec4 front_light;
//@if two_sided
@varying@vec4 back_light;
//@end
//@if separate_texture_terms
@varying@vec3 front_rest;
//@if two_sided
@varying@vec3 back_rest;
//@end
//@end
//@if needs_vertex_color
@smooth_varying@vec4 tint;
//@end
//@end
//@if first_texcoords
@smooth_varying@vec2 surface_texcoord;
//@end
//@if second_texcoords
@smooth_varying@vec2 surface_second_texcoord;
//@end
//@if output_ids depth_ids shadows
@flat_varying@int triangle;
//@end
