
//@if fragment
// --- the fragment
//@else
// --- the vertex

@attributes@
//@end
//@if passes_anything

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
//@if colors
@varying@vec4 tint;
//@end
//@else
@varying@vec4 front_light;
//@if two_sided
@varying@vec4 back_light;
//@end
//@end
//@if numbers
@flat_varying@int triangle;
//@end
