// model_fragment.glsl: the fragment's lighting, or the colour that the vertices had.

uniform bool interpolated, flat_shading, two_sided;

in vec4 point_light, point_eye, point_normal, early_eye, vertex_color, vertex_color_back;
in vec4 early[LAMPS];
in float distances[LAMPS];
flat in vec4 flat_color;

out vec4 pixel;

void main()
{
    bool back = two_sided && !gl_FrontFacing && !is(NO_FLIP);
    if (flat_shading && !is(SMOOTH_FOR_FLAT)) {
        pixel = flat_color;
    } else if (interpolated) {
        pixel = back ? vertex_color_back : vertex_color;
    } else {
        pixel = shade(back ? -point_normal : point_normal, point_light, point_eye, early, early_eye, distances);
    }
}
