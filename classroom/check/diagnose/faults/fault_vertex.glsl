// fault_vertex.glsl: computes the varyings or, for lighting in the vertex shader, the lighting.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
#ifdef MAPS
layout(location = 2) in vec4 tangent; // w is the sign of the bitangent
layout(location = 3) in vec2 texture_coordinate;
out vec4 surface_tangent, surface_bitangent;
out vec3 surface_point;
out vec2 surface_texture_coordinate;
#endif

uniform mat4 normal_matrix4; // inverse transpose of to_lighting
uniform vec4 window;         // scale and offset that map every second pixel of a picture to the pixels of a smaller one

#ifdef IN_VERTEX
out vec4 vertex_color, vertex_color_back;
flat out vec4 flat_color;
#else
out vec4 surface_normal, surface_light, surface_eye, early_eye, early_light[LAMPS], early_mirror[LAMPS];
out float distances[LAMPS];
#if NORMAL_FLAT > 0
flat out vec4 flat_normal;
#endif
#endif

vec4 normal_of()
{
    vec3 given = is(NORMAL_IS_POSITION) ? position : normal;
    vec4 n = vec4(mat3(normal_matrix4) * given, 0.0);
    if (is(NORMAL_OBJECT)) {
        n = vec4(given, 0.0);
    } else if (is(NORMAL_BY_MODEL)) {
        n = vec4(mat3(to_lighting) * given, 0.0);
    } else if (is(NORMAL_BY_INVERSE)) {
        n = vec4(transpose(mat3(normal_matrix4)) * given, 0.0);
    } else if (is(NORMAL_BY_TRANSPOSE)) {
        n = vec4(transpose(mat3(to_lighting)) * given, 0.0);
    } else if (is(NORMAL_AS_POINT)) {
        n = vec4((to_lighting * vec4(given, 1.0)).xyz, 0.0);
    } else if (is(NORMAL_WITH_W)) {
        n = normalize(normal_matrix4 * vec4(given, 0.0));
        return vec4(n.xyz, 0.0);
    }
    if (is(NORMAL_TWICE)) {
        n = vec4((is(NORMAL_BY_MODEL) ? mat3(to_lighting) : mat3(normal_matrix4)) * n.xyz, 0.0);
    }
    if (is(NORMAL_CLIP)) {
        n = to_clip * n;
        n.w = is(FOUR) ? n.w : 0.0;
    }
    if (is(NORMAL_EYE)) {
        n = vec4(mat3(to_eye_space) * n.xyz, 0.0);
    }
    if (is(INWARD)) {
        n = -n;
    }
    return is(LONG_NORMAL_VERTEX) ? n : unit4(n);
}

// Returns the tangent and the bitangent in the space of the lighting, and the texture coordinates.
Frame frame_of(vec4 point)
{
    Frame f = Frame(vec4(0.0), vec4(0.0), vec2(0.0), point.xyz);
#ifdef MAPS
    mat3 turn = mat3(to_lighting);
    if (is(TANGENT_BY_NORMAL_MATRIX)) {
        turn = mat3(normal_matrix4);
    } else if (is(TANGENT_OBJECT)) {
        turn = mat3(1.0);
    }
    f.tangent = vec4(turn * tangent.xyz, tangent.w);
    f.bitangent = vec4(turn * (cross(normal, tangent.xyz) * (is(SIGN_LOST) ? 1.0 : tangent.w)), 0.0);
    if (is(FRAME_INTERPOLATED)) { // normalized at the vertices, but not after interpolation
        f.tangent.xyz = normalize(f.tangent.xyz);
        f.bitangent.xyz = cross(unit4(normal_of()).xyz, f.tangent.xyz) * tangent.w;
    }
    f.texture_coordinate = texture_coordinate;
#endif
    return f;
}

void main()
{
    vec4 at = vec4(position, 1.0), eye = to_lighting * at;
    Surface s;
    vec4 point = is(POINT_TWICE) ? to_lighting * eye : eye;
    s.light = is(LIGHT_FROM_OBJECT) ? at : (is(POINT_CLIP) ? to_clip * eye : point);
    s.eye = is(EYE_FROM_OBJECT) ? at : (is(EYE_CLIP) ? to_clip * eye : point);
    s.normal = normal_of();
    s.frame = frame_of(eye);
    s.early_eye = unit4(to_eye(s.eye));
    for (int i = 0; i < LAMPS; i++) {
        s.early_light[i] = s.early_mirror[i] = vec4(0.0);
        s.distance[i] = 0.0;
    }
    for (int i = 0; i < lamp_count; i++) {
        vec4 way = to_lamp(i, s.light);
        s.early_light[i] = unit4(way);
        s.distance[i] = length(way);
        s.early_mirror[i] = is_phong() ? mirrored(s.early_light[i], unit4(s.normal)) : unit4(s.early_light[i] + s.early_eye);
    }
#ifdef IN_VERTEX
    vertex_color = shade(s);
    s.normal = -s.normal;
    vertex_color_back = shade(s);
    if (is(VERTEX_CLAMPED)) {
        vertex_color = clamp(vertex_color, 0.0, 1.0);
    }
    flat_color = vertex_color;
#else
    surface_normal = s.normal;
#if NORMAL_FLAT > 0
    flat_normal = s.normal;
#endif
    surface_light = s.light;
    surface_eye = s.eye;
    early_eye = s.early_eye;
    early_light = s.early_light;
    early_mirror = s.early_mirror;
    distances = s.distance;
#endif
#ifdef MAPS
    surface_tangent = s.frame.tangent;
    surface_bitangent = s.frame.bitangent;
    surface_point = s.frame.point;
    surface_texture_coordinate = s.frame.texture_coordinate;
#endif
    gl_Position = to_clip * eye;
    if (is(UPSIDE_DOWN)) {
        gl_Position.y = -gl_Position.y;
    }
    gl_Position.xy = gl_Position.xy * window.xy + gl_Position.w * window.zw;
}
