// fault_vertex.glsl: the varyings, or the lighting where it is computed in the vertex shader.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 normal_matrix4; // inverse transpose of model_view

#ifdef IN_VERTEX
out vec4 vertex_color, vertex_color_back;
flat out vec4 flat_color;
#else
out vec4 point_light, point_eye, point_normal, early_eye;
out vec4 early[LAMPS];
out float distances[LAMPS];
#endif

vec4 normal_of()
{
    vec4 n = vec4(mat3(normal_matrix4) * normal, 0.0);
    if (is(NORMAL_OBJECT)) {
        n = vec4(normal, 0.0);
    } else if (is(NORMAL_BY_MODEL)) {
        n = vec4(mat3(model_view) * normal, 0.0);
    } else if (is(NORMAL_WITH_W)) {
        n = normalize(normal_matrix4 * vec4(normal, 0.0));
        return vec4(n.xyz, 0.0);
    }
    if (is(NORMAL_CLIP)) {
        n = projection * n;
        n.w = is(FOUR) ? n.w : 0.0;
    }
    if (is(INWARD)) {
        n = -n;
    }
    return is(LONG_NORMAL_VERTEX) ? n : unit4(n);
}

void main()
{
    vec4 at = vec4(position, 1.0), eye = model_view * at;
#ifdef IN_VERTEX
    vec4 point_light, point_eye, point_normal, early_eye, early[LAMPS];
    float distances[LAMPS];
#endif
    point_light = is(LIGHT_FROM_OBJECT) ? at : (is(POINT_CLIP) ? projection * eye : eye);
    point_eye = is(EYE_FROM_OBJECT) ? at : (is(EYE_CLIP) ? projection * eye : eye);
    point_normal = normal_of();
    early_eye = unit4(to_eye(point_eye));
    for (int i = 0; i < LAMPS; i++) {
        early[i] = vec4(0.0);
        distances[i] = 0.0;
    }
    for (int i = 0; i < lamp_count; i++) {
        vec4 way = to_lamp(i, point_light);
        early[i] = unit4(way);
        distances[i] = length(way);
    }
#ifdef IN_VERTEX
    vertex_color = shade(point_normal, point_light, point_eye, early, early_eye, distances);
    vertex_color_back = shade(-point_normal, point_light, point_eye, early, early_eye, distances);
    if (is(VERTEX_CLAMPED)) {
        vertex_color = clamp(vertex_color, 0.0, 1.0);
    }
    flat_color = vertex_color;
#endif
    gl_Position = projection * eye;
    if (is(UPSIDE_DOWN)) {
        gl_Position.y = -gl_Position.y;
    }
}
