
// --- shadows: docs/lighting/shadows.md, in float

uniform sampler2D shadow_tree; // nodes of the hierarchy, its triangles, and the place of each triangle by its number
uniform mat4 shadow_matrix;    // eye space to the hierarchy's, where all triangles lie within -1...1
uniform vec4 shadow_places;    // first texel of the triangles, and of the places; 1: the terminator is cured
uniform vec4 shadow_samples;   // rays to a light with a radius; world units to the hierarchy's; the picture's pixel at the target's corner

int lit_triangle; // number in the frame of the triangle that the fragment shows
vec3 ray_origin;
float ray_twin; // of the triangle that rays start on

vec4 tree_texel(int i) { return texelFetch(shadow_tree, ivec2(i % 1024, i / 1024), 0); }

vec3 moved_by(vec3 p, vec3 corner, vec3 n, float weight)
{
    return (weight * min(dot(p - corner, n), 0.0)) * n;
}

// Rays start at the point of a triangle next to p, a point in eye space. `side` is -1 where the back is seen and lit.
void start_rays(vec3 p, int number, float side)
{
    vec4 four = tree_texel(int(shadow_places.y) + number / 4);
    int within = number % 4;
    float place = within == 0 ? four.x : (within == 1 ? four.y : (within == 2 ? four.z : four.w));
    int at = int(shadow_places.x) + 6 * int(place);
    vec4 a = tree_texel(at);
    vec4 b = tree_texel(at + 1);
    vec4 c = tree_texel(at + 2);
    vec3 eye = (shadow_matrix * vec4(p, 1.0)).xyz;
    ray_origin = eye;
    ray_twin = a.w;
    if (b.w > 1.5) { // a line, a point or the ground: in no ray's way
        return;
    }
    vec3 e1 = b.xyz - a.xyz;
    vec3 e2 = c.xyz - a.xyz;
    vec3 q = eye - a.xyz;
    float d11 = dot(e1, e1);
    float d12 = dot(e1, e2);
    float d22 = dot(e2, e2);
    float det = d11 * d22 - d12 * d12;
    float b1 = det > 0.0 ? max((d22 * dot(q, e1) - d12 * dot(q, e2)) / det, 0.0) : 0.0;
    float b2 = det > 0.0 ? max((d11 * dot(q, e2) - d12 * dot(q, e1)) / det, 0.0) : 0.0;
    float total = max(b1 + b2, 1.0);
    b1 = b1 / total;
    b2 = b2 / total;
    ray_origin = a.xyz + (e1 * b1 + e2 * b2);
    if (b.w > 0.5 && shadow_places.z > 0.5) {
        vec3 moved = moved_by(ray_origin, a.xyz, side * tree_texel(at + 3).xyz, 1.0 - b1 - b2)
                   + moved_by(ray_origin, b.xyz, side * tree_texel(at + 4).xyz, b1)
                   + moved_by(ray_origin, c.xyz, side * tree_texel(at + 5).xyz, b2);
        ray_origin = ray_origin - moved;
    }
}

// Whether a box is in the way of the ray from ray_origin; `reach` is more than what rounding can move its planes.
bool meets_box(vec3 low, vec3 high, vec3 inverse, float end, float reach)
{
    vec3 u = (low - ray_origin - reach) * inverse;
    vec3 v = (high - ray_origin + reach) * inverse;
    vec3 near = min(u, v);
    vec3 far = max(u, v);
    return max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, end));
}

// Whether a triangle is in the way of the ray from ray_origin along d, whose component k is the largest.
bool crosses(int at, vec3 d, int k, float end)
{
    vec4 corner = tree_texel(at);
    if (corner.w == ray_twin) {
        return false;
    }
    int i = k == 2 ? 0 : k + 1;
    int j = k == 0 ? 2 : k - 1;
    vec3 a = corner.xyz - ray_origin;
    vec3 b = tree_texel(at + 1).xyz - ray_origin;
    vec3 c = tree_texel(at + 2).xyz - ray_origin;
    vec2 slope = vec2(d[i], d[j]) / d[k];
    vec2 p = vec2(a[i], a[j]) - slope * a[k];
    vec2 q = vec2(b[i], b[j]) - slope * b[k];
    vec2 r = vec2(c[i], c[j]) - slope * c[k];
    float u = q.x * r.y - q.y * r.x;
    float v = r.x * p.y - r.y * p.x;
    float w = p.x * q.y - p.y * q.x;
    float det = u + v + w;
    if ((min(min(u, v), w) < 0.0 && max(max(u, v), w) > 0.0) || det == 0.0) {
        return false;
    }
    float t = (u * a[k] + v * b[k] + w * c[k]) / (d[k] * det);
    return t > 0.0 && t < end;
}

bool any_hit(vec3 d, float end)
{
    int stack[64];
    int waiting = 0;
    int at = 0; // the texel of the next child to be tested
    vec3 size = abs(d);
    int k = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    vec3 least = vec3(d.x < 0.0 ? -1.0e-30 : 1.0e-30, d.y < 0.0 ? -1.0e-30 : 1.0e-30, d.z < 0.0 ? -1.0e-30 : 1.0e-30);
    vec3 inverse = 1.0 / vec3(size.x < 1.0e-30 ? least.x : d.x, size.y < 1.0e-30 ? least.y : d.y,
                              size.z < 1.0e-30 ? least.z : d.z);
    float reach = 1.0e-6 * (1.0 + max(max(abs(ray_origin.x), abs(ray_origin.y)), abs(ray_origin.z)));
    int first = int(shadow_places.x);
    while (true) {
        vec4 low = tree_texel(at);
        vec4 high = tree_texel(at + 1);
        int count = int(high.w) / 2;
        bool last = int(high.w) % 2 == 1;
        at = at + 2;
        if (meets_box(low.xyz, high.xyz, inverse, end, reach)) {
            if (count == 0) {
                if (!last) {
                    stack[waiting] = at;
                    waiting = waiting + 1;
                }
                at = 16 * int(low.w);
                continue;
            }
            for (int i = 0; i < count; i++) {
                if (crosses(first + 6 * (int(low.w) + i), d, k, end)) {
                    return true;
                }
            }
        }
        if (last) {
            if (waiting == 0) {
                return false;
            }
            waiting = waiting - 1;
            at = stack[waiting];
        }
    }
    return false;
}

// light_turn of light_pattern.h: the product of its two numbers has more than 32 bits, of which 40 to 47 are the turn.
float turn_of_pixel()
{
    uvec2 at = uvec2(gl_FragCoord.xy) + uvec2(shadow_samples.zw);
    uint part = at.x * 0x112e0be8u + at.y * 0x017e8cd9u;
    uint low = part & 0xffffu;
    uint high = part >> 16u;
    uint middle = high * 64417u + (low * 64417u >> 16u);
    uint upper = high * 52u + (middle >> 16u) + ((middle & 0xffffu) + low * 52u >> 16u);
    return float(upper >> 8u & 255u) * (6.28318531 / 256.0);
}

// The rays, of N, that reach the points of a light's disc around p + d (light_pattern.h). `across` has the length of its radius.
int count_reaching(vec3 d, vec3 across, float end, int count)
{
    vec3 along = normalize(d);
    vec3 u = normalize(across - along * dot(along, across)) * length(across);
    vec3 v = cross(along, u);
    float turn = turn_of_pixel();
    int reaching = 0;
    for (int i = 0; i < count; i++) {
        float angle = 6.28318531 * fract(float(i) * 0.381966011) + turn;
        float distance = sqrt((float(i) + 0.5) / float(count));
        if (!any_hit(d + distance * (u * cos(angle) + v * sin(angle)), end)) {
            reaching = reaching + 1;
        }
    }
    return reaching;
}

// The axis of which d has the smallest part, the first of equals.
vec3 least_axis(vec3 d)
{
    vec3 size = abs(d);
    if (size.x <= size.y && size.x <= size.z) {
        return vec3(1.0, 0.0, 0.0);
    }
    return size.y <= size.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
}

// The share of a light that reaches the point. place.w: its radius, below 0 where it casts no shadow; place.xyz of a directional
// light: the axis of which its direction has the smallest part. Where a light does not shine no ray is needed.
float passed_light(vec4 place, light_source light, light_sample t, float n_dot_l, int kind)
{
    if (place.w < 0.0 || !(n_dot_l > 0.0) || !(t.attenuation * t.spot > 0.0)) {
        return 1.0;
    }
//@if catches
    if (unobstructed) {
        return 1.0;
    }
//@end
    bool directional = kind == LIGHT_DIRECTIONAL;
    float end = directional ? 1.0e30 : 1.0;
    vec3 d = directional ? -normalize(mat3(shadow_matrix) * light.direction)
                         : (shadow_matrix * vec4(light.position, 1.0)).xyz - ray_origin;
    if (place.w == 0.0) {
        return any_hit(d, end) ? 0.0 : 1.0;
    }
    vec3 across = directional ? place.xyz * place.w : least_axis(d) * (place.w * shadow_samples.y);
    int count = int(shadow_samples.x);
    return float(count_reaching(d, across, end, count)) / float(count);
}
