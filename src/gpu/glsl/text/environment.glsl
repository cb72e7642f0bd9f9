// environment.glsl: light from the environment.

// The point where a direction meets a cube, -1...1 on its face, and the number of the face (OpenGL 4.6, 8.13).
vec3 cube_point(vec3 e)
{
    vec3 size = abs(e);
    bool on_x = size.x >= size.y && size.x >= size.z;
    bool on_y = !on_x && size.y >= size.z;
    float major = on_x ? size.x : (on_y ? size.y : size.z);
    bool minus = (on_x ? e.x : (on_y ? e.y : e.z)) < 0.0;
    float across = on_x ? (minus ? e.z : -e.z) : (on_y ? e.x : (minus ? -e.x : e.x));
    float down = on_y ? (minus ? -e.z : e.z) : -e.y;
    float face = (on_x ? 0.0 : (on_y ? 2.0 : 4.0)) + (minus ? 1.0 : 0.0);
    return major > 0.0 ? vec3(vec2(across, down) / major, face) : vec3(0.0, 0.0, face);
}

if (cube_map) {
    // Light from the environment along the direction d in eye space.
    vec3 environment_color(vec3 d) { return TEXTURE_CUBE(environment, environment_matrix * d).rgb; }
} else {
    // Light from the environment along the direction d in eye space. Each layer of the texture is a face of the cube with a
    // border of one texel from its neighbours, so that the bilinear filter has no special case at the edges.
    vec3 environment_color(vec3 d)
    {
        vec3 point = cube_point(environment_matrix * d);
        int face = int(point.z);
        float side = float(textureSize(environment_faces, 0).x - 2);
        float middle = 0.5 * side + 0.5;
        vec2 texel = point.xy * (0.5 * side) + middle;
        texel = clamp(texel, vec2(0.5), vec2(side + 0.5));
        ivec2 corner = ivec2(texel);
        vec2 part = texel - vec2(corner);
        vec3 a = texelFetch(environment_faces, ivec3(corner, face), 0).rgb;
        vec3 b = texelFetch(environment_faces, ivec3(corner + ivec2(1, 0), face), 0).rgb;
        vec3 c = texelFetch(environment_faces, ivec3(corner + ivec2(0, 1), face), 0).rgb;
        vec3 f = texelFetch(environment_faces, ivec3(corner + ivec2(1, 1), face), 0).rgb;
        return mix3(mix3(a, b, part.x), mix3(c, f, part.x), part.y);
    }
}

// Texel i of the prefiltered environment and of the irradiance.
vec3 environment_light_texel(float i)
{
    float row = floor(i / 1024.0);
    if (glsl_120) {
        return texture2D(environment_light, (vec2(i - 1024.0 * row, row) + 0.5) / vec2(1024.0, LEVEL_ROWS)).rgb;
    } else {
        return texelFetch(environment_light, ivec2(int(i - 1024.0 * row), int(row)), 0).rgb;
    }
}

// The light at a point of the cube, from one level. A level consists of six faces, one after the other, each with a
// border of one texel.
vec3 level_color(int level, vec3 point)
{
    const float sizes[LEVEL_COUNT] = float[LEVEL_COUNT](LEVEL_SIZES);
    const float starts[LEVEL_COUNT] = float[LEVEL_COUNT](LEVEL_STARTS);
    float size = sizes[level];
    float side = size + 2.0;
    vec2 texel = clamp(point.xy * (0.5 * size) + (0.5 * size + 0.5), vec2(0.5), vec2(size + 0.5));
    vec2 corner = floor(texel);
    vec2 part = texel - corner;
    float first = starts[level] + (point.z * side + corner.y) * side + corner.x;
    vec3 a = environment_light_texel(first);
    vec3 b = environment_light_texel(first + 1.0);
    vec3 c = environment_light_texel(first + side);
    vec3 d = environment_light_texel(first + side + 1.0);
    return mix3(mix3(a, b, part.x), mix3(c, d, part.x), part.y);
}

vec3 irradiance_at(vec3 normal)
{
    return level_color(int(PREFILTERED_LAST) + 1, cube_point(environment_matrix * normal));
}

// Level 0 is the environment itself, without prefiltering.
vec3 prefiltered_at(vec3 direction, float level)
{
    vec3 point = cube_point(environment_matrix * direction);
    float first = min_of(floor(level), PREFILTERED_LAST - 1.0);
    vec3 low = first > 0.5 ? level_color(int(first), point) : environment_color(direction);
    return mix3(low, level_color(int(first) + 1, point), level - first);
}
