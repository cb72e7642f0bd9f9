// fault_fragment.glsl: lights the fragment, or outputs the interpolated colour of the vertices.

#ifdef IN_VERTEX
in vec4 vertex_color, vertex_color_back;
flat in vec4 flat_color;
#else
in vec4 surface_normal, surface_light, surface_eye, early_eye, early_light[LAMPS], early_mirror[LAMPS];
in float distances[LAMPS];
#if NORMAL_FLAT > 0
flat in vec4 flat_normal;
#endif
#endif

#ifdef MAPS
in vec4 surface_tangent, surface_bitangent;
in vec3 surface_point;
in vec2 surface_texture_coordinate;
#endif

out vec4 pixel;

void main()
{
    bool back = (two_sided || is(FLIP)) && !gl_FrontFacing && !is(NO_FLIP);
#ifdef IN_VERTEX
    pixel = flat_shading && !is(SMOOTH_FOR_FLAT) ? flat_color : (back ? vertex_color_back : vertex_color);
#else
#ifdef MAPS
    Frame frame = Frame(surface_tangent, surface_bitangent, surface_texture_coordinate, surface_point);
#else
    Frame frame = Frame(vec4(0.0), vec4(0.0), vec2(0.0), vec3(0.0));
#endif
    vec4 n = surface_normal;
#if NORMAL_FLAT > 0
    n = is(NORMAL_FLAT) ? flat_normal : n;
#endif
    pixel = shade(Surface(back ? -n : n, surface_light, surface_eye, early_eye, early_light, early_mirror, distances, frame));
#endif
}
