// interface.glsl: the values that the vertex shader passes to the fragment shader, and the outputs of the fragment
// shader.

VARYING vec3 eye_position;
VARYING vec3 eye_normal;
VARYING vec3 eye_tangent;
VARYING float bitangent_sign;
VARYING vec4 front_light;
VARYING vec4 back_light;
VARYING vec3 front_rest;
VARYING vec3 back_rest;
if (needs_vertex_color) {
    TINT_VARYING vec4 tint;
}
SMOOTH_VARYING vec2 surface_texcoord;
SMOOTH_VARYING vec2 surface_second_texcoord;
FLAT_VARYING int triangle;
SMOOTH_VARYING vec3 corner_weights; // the barycentric weights of the triangle's corners

uniform int first_triangle; // number of the draw's first triangle
uniform int sample_number; // of the current sample in sample_offsets
uniform usampler2D nearer_depth_ids; // of the previous layer
uniform usampler2D opaque_depth_ids;
if (depth_ids) {
    layout(location = 0) out vec4 pixel;
    layout(location = 1) out uvec2 depth_id; // bits of the depth, and triangle number + 1; 0: empty
    layout(location = 2) out vec4 through;
} else if (!glsl_120) {
    out vec4 pixel;
}
