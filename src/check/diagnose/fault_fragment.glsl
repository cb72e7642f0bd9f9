// fault_fragment.glsl: lights the fragment, or passes the interpolated colour of the vertices.

#ifdef IN_VERTEX
in vec4 vertex_color, vertex_color_back;
flat in vec4 flat_color;
#else
in vec4 surface_normal, surface_light, surface_eye, early_eye, early_light[LAMPS], early_mirror[LAMPS];
in float distances[LAMPS];
#endif

out vec4 pixel;

void main()
{
    bool back = (two_sided || is(FLIP)) && !gl_FrontFacing && !is(NO_FLIP);
#ifdef IN_VERTEX
    pixel = flat_shading && !is(SMOOTH_FOR_FLAT) ? flat_color : (back ? vertex_color_back : vertex_color);
#else
    pixel = shade(Surface(back ? -surface_normal : surface_normal, surface_light, surface_eye, early_eye, early_light, early_mirror, distances));
#endif
}
