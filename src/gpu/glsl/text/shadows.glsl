// shadows.glsl: rays to the lights through the hierarchy (docs/lighting/shadows.md, in float).

uniform sampler2D shadow_tree; // nodes of the hierarchy, its triangles, and the position of each triangle by its number
uniform mat4 shadow_matrix;    // eye space to the hierarchy's, where all triangles lie within -1...1
uniform vec4 shadow_offsets;    // first texels of the triangles and of their positions; 1: the shadow terminator is corrected; rays per light with a radius
uniform vec4 shadow_rounding;  // hierarchy.rounding: the rounding error of a corner, by axis; w: hierarchy units per world unit

int lit_triangle = 0; // number in the frame of the triangle that the fragment or the vertex belongs to
int lit_corner = 0; // the lit corner of that triangle
vec3 ray_origin;
vec3 ray_point; // point of the surface from which rays start: their origin, unless the origin was moved off the surface
float ray_twin; // twin of the triangle on which rays start; -1 if they start at a vertex

vec4 tree_texel(int i) { return texelFetch(shadow_tree, ivec2(i % 1024, i / 1024), 0); }

// The first texel of a triangle, by its number in the frame.
int triangle_texel(int number)
{
    return int(shadow_offsets.x) + 6 * int(tree_texel(int(shadow_offsets.y) + number / 4)[number % 4]);
}

vec3 moved_by(vec3 p, vec3 corner, vec3 n, float weight)
{
    return (weight * min(dot(p - corner, n), 0.0)) * n;
}

if (from_vertices) {
    // Rays start at the vertex itself. Triangles at this vertex cannot block them, because the rays meet these
    // triangles at t = 0.
} else {
    // Rays start at the point of the triangle that is nearest to p, a point in eye space. `side` is -1 if the back is
    // visible and lit.
}
void start_rays(vec3 p, int number, float side)
{
    int at = triangle_texel(number);
    if (from_vertices) {
        bool apart = tree_texel(at + 1).w > 1.5; // a line or a point blocks no ray and is not among the triangles
        ray_origin = apart ? (shadow_matrix * vec4(p, 1.0)).xyz : tree_texel(at + lit_corner).xyz;
        ray_point = ray_origin;
        ray_twin = -1.0;
    } else {
        vec4 a = tree_texel(at);
        vec4 b = tree_texel(at + 1);
        vec4 c = tree_texel(at + 2);
        vec3 eye = (shadow_matrix * vec4(p, 1.0)).xyz;
        ray_origin = eye;
        ray_point = eye;
        ray_twin = a.w;
        if (b.w > 1.5) { // a line, a point or the ground, which blocks no ray
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
        ray_point = ray_origin;
        if (b.w > 0.5 && shadow_offsets.z > 0.5) {
            vec3 moved = moved_by(ray_origin, a.xyz, side * tree_texel(at + 3).xyz, 1.0 - b1 - b2)
                       + moved_by(ray_origin, b.xyz, side * tree_texel(at + 4).xyz, b1)
                       + moved_by(ray_origin, c.xyz, side * tree_texel(at + 5).xyz, b2);
            ray_origin = ray_origin - moved;
        }
    }
}

// Whether the ray from ray_origin meets a box; `reach` is larger than the rounding error of the box's planes.
bool meets_box(vec3 low, vec3 high, vec3 inverse, float end, float reach)
{
    vec3 u = (low - ray_origin - reach) * inverse;
    vec3 v = (high - ray_origin + reach) * inverse;
    vec3 near = min(u, v);
    vec3 far = max(u, v);
    return max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, end));
}

// --- transmitted light, as in src/effects/rays/opacity.c; gl_shadows.c packs the data

// A texel of a map: four channels, or one channel. Four texels of one channel share a texel of the tree.
vec4 surface_texel(vec4 pixels, int x, int y)
{
    int i = y * int(pixels.y) + x;
    return pixels.w > 0.5 ? tree_texel(int(pixels.x) + i) : vec4(tree_texel(int(pixels.x) + i / 4)[i % 4]);
}

// A map at level 0, filtered as in texture.glsl. Its record has four texels. The first contains the position of its
// pixels, its size, and whether it has four channels. The next two are the rows of the matrix to the picture's
// coordinates, with the wrapping and the set of coordinates. The last contains scale, offset, and 1 if the nearest
// texel is used.
vec4 surface_map(int at, vec4 texcoords)
{
    vec4 pixels = tree_texel(at);
    vec4 s = tree_texel(at + 1);
    vec4 t = tree_texel(at + 2);
    vec4 how = tree_texel(at + 3);
    int wrap_s = int(s.w) % 4;
    int wrap_t = int(s.w) / 4;
    vec3 coordinates = vec3(t.w > 0.5 ? texcoords.zw : texcoords.xy, 1.0);
    vec2 place = vec2(wrapped(dot(s.xyz, coordinates), wrap_s), wrapped(dot(t.xyz, coordinates), wrap_t));
    ivec2 size = ivec2(pixels.yz);
    vec2 spot = place * pixels.yz;
    vec4 value;
    if (how.z > 0.5) {
        ivec2 texel = min(ivec2(spot), size - 1);
        value = surface_texel(pixels, texel.x, texel.y);
    } else {
        spot -= 0.5;
        vec2 corner = floor(spot);
        vec2 part = spot - corner;
        int x0 = neighbour(int(corner.x), size.x, wrap_s);
        int x1 = neighbour(int(corner.x) + 1, size.x, wrap_s);
        int y0 = neighbour(int(corner.y), size.y, wrap_t);
        int y1 = neighbour(int(corner.y) + 1, size.y, wrap_t);
        vec4 a = surface_texel(pixels, x0, y0);
        vec4 c = surface_texel(pixels, x0, y1);
        vec4 upper = a + (surface_texel(pixels, x1, y0) - a) * part.x;
        vec4 lower = c + (surface_texel(pixels, x1, y1) - c) * part.x;
        value = upper + (lower - upper) * part.y;
    }
    return value * how.x + how.y;
}

// The light that passes the point of a triangle at which its corners have the weights w. The triangle's record is at
// texel `at`. Its first texel contains the records of the triangle's sides, and 1 if the triangle has colours. The
// texture coordinates and the colours of the corners follow.
LIGHT_SHARE passed_surface(int at, bool back, vec3 w)
{
    vec4 head = tree_texel(at);
    int side = int(back ? head.y : head.x);
    vec4 texcoords = tree_texel(at + 1) * w.x + tree_texel(at + 2) * w.y + tree_texel(at + 3) * w.z;
    vec4 color = head.z > 0.5 ? tree_texel(at + 4) * w.x + tree_texel(at + 5) * w.y + tree_texel(at + 6) * w.z : vec4(1.0);
    vec4 rule = tree_texel(side);     // alpha, alpha mode, cutoff, and transmission: 0 none, 1 some, 2 all
    vec4 maps = tree_texel(side + 2); // positions of the maps of base colour, opacity, transmission and metallic, or 0
    vec4 base = maps.x > 0.0 ? surface_map(int(maps.x), texcoords) : vec4(1.0);
    float opacity = 1.0;
    if (rule.y > 0.5) {
        opacity = clamp(rule.x * color.a, 0.0, 1.0);
        opacity = clamp(opacity * base.a, 0.0, 1.0);
        if (maps.y > 0.0) {
            opacity = clamp(opacity * surface_map(int(maps.y), texcoords).x, 0.0, 1.0);
        }
        if (rule.y < 1.5) {
            opacity = opacity >= rule.z ? 1.0 : 0.0;
        }
    }
    if (tints_rays) {
        if (rule.w > 1.5) {
            return vec3(1.0);
        }
        if (rule.w > 0.5) {
            vec4 metal = tree_texel(side + 3); // metallic, transmission
            vec4 factor = tree_texel(side + 1);
            float through = opacity * metal.y;
            if (maps.z > 0.0) {
                through *= clamp(surface_map(int(maps.z), texcoords).x, 0.0, 1.0);
            }
            if (maps.w > 0.0) {
                metal.x *= clamp(surface_map(int(maps.w), texcoords).x, 0.0, 1.0);
            }
            through *= 1.0 - metal.x;
            return 1.0 - opacity + through * clamp(factor.rgb * color.rgb * base.rgb, 0.0, 1.0);
        }
    }
    return LIGHT_SHARE(1.0 - opacity);
}

// A ray through an edge crosses both triangles at the edge. If they are translucent, only one may count: the triangle
// on a fixed side of the edge.
bool owns_edge(float weight, vec2 from, vec2 to, bool turned)
{
    vec2 d = turned ? to - from : from - to;
    return weight != 0.0 || d.y > 0.0 || (d.y == 0.0 && d.x > 0.0);
}

// The side of an edge on which the ray passes, as the cross product of the edge's ends. The order of the ends is the
// same for both triangles at the edge. Both therefore get the same number with opposite signs, even if a driver uses
// fused multiply-add.
float edge_weight(vec2 a, vec2 b)
{
    bool swapped = a.x > b.x || (a.x == b.x && a.y > b.y);
    vec2 p = swapped ? b : a;
    vec2 q = swapped ? a : b;
    float w = p.x * q.y - p.y * q.x;
    return swapped ? -w : w;
}

// Whether ray_point lies in the plane of a triangle with these corners, within the rounding error. This is
// through_points of ray_lanes.h with the errors of float: 2^-21 of the corners and of the point, and 2^-21 for 8 ulp of
// the determinant.
bool through_point(vec3 a, vec3 b, vec3 c)
{
    vec3 u = (b - a).yzx * (c - a).zxy;
    vec3 v = (b - a).zxy * (c - a).yzx;
    vec3 q = a - ray_point;
    vec3 moved = shadow_rounding.xyz + 4.8e-7 * max(max(abs(a), abs(b)), max(abs(c), abs(ray_point)));
    return abs(dot(u - v, q)) <= 2.0 * dot(abs(u - v), moved) + 4.8e-7 * dot(abs(u) + abs(v), abs(q));
}

// The light that passes a triangle along the ray from ray_origin in the direction d, whose component k is the largest;
// 1 if the ray misses the triangle.
LIGHT_SHARE passed_triangle(int at, vec3 d, int k, float end)
{
    vec4 corner = tree_texel(at);
    if (corner.w == ray_twin) {
        return LIGHT_SHARE(1.0);
    }
    int i = k == 2 ? 0 : k + 1;
    int j = k == 0 ? 2 : k - 1;
    vec4 second = tree_texel(at + 1);
    vec4 last = tree_texel(at + 2);
    vec3 a = corner.xyz - ray_origin;
    vec3 b = second.xyz - ray_origin;
    vec3 c = last.xyz - ray_origin;
    vec2 slope = vec2(d[i], d[j]) / d[k];
    vec2 p = vec2(a[i], a[j]) - slope * a[k];
    vec2 q = vec2(b[i], b[j]) - slope * b[k];
    vec2 r = vec2(c[i], c[j]) - slope * c[k];
    float u = edge_weight(q, r);
    float v = edge_weight(r, p);
    float w = edge_weight(p, q);
    float det = u + v + w;
    if ((min(min(u, v), w) < 0.0 && max(max(u, v), w) > 0.0) || det == 0.0) {
        return LIGHT_SHARE(1.0);
    }
    float t = (u * a[k] + v * b[k] + w * c[k]) / (d[k] * det);
    if (!(t > 0.0 && t < end) || through_point(corner.xyz, second.xyz, last.xyz)) {
        return LIGHT_SHARE(1.0);
    }
    if (passes_rays) {
        if (last.w > 0.5) { // its record
            bool turned = det > 0.0;
            if (!(owns_edge(u, q, r, turned) && owns_edge(v, r, p, turned) && owns_edge(w, p, q, turned))) {
                return LIGHT_SHARE(1.0);
            }
            return passed_surface(int(last.w), dot(d, cross(b - a, c - a)) < 0.0, vec3(u, v, w) / det);
        }
    }
    return LIGHT_SHARE(0.0);
}

// The light that passes along the ray from ray_origin.
LIGHT_SHARE passed_ray(vec3 d, float end)
{
    LIGHT_SHARE passed = LIGHT_SHARE(1.0);
    int stack[64];
    int waiting = 0;
    int at = 0; // the texel of the next child to be tested
    vec3 size = abs(d);
    int k = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    vec3 least = vec3(d.x < 0.0 ? -1.0e-30 : 1.0e-30, d.y < 0.0 ? -1.0e-30 : 1.0e-30, d.z < 0.0 ? -1.0e-30 : 1.0e-30);
    vec3 inverse = 1.0 / vec3(size.x < 1.0e-30 ? least.x : d.x, size.y < 1.0e-30 ? least.y : d.y,
                              size.z < 1.0e-30 ? least.z : d.z);
    float reach = 1.0e-6 * (1.0 + max(max(abs(ray_origin.x), abs(ray_origin.y)), abs(ray_origin.z)));
    int first = int(shadow_offsets.x);
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
                passed = passed * passed_triangle(first + 6 * (int(low.w) + i), d, k, end);
                if (passed == LIGHT_SHARE(0.0)) {
                    return passed;
                }
            }
        }
        if (last) {
            if (waiting == 0) {
                return passed;
            }
            waiting = waiting - 1;
            at = stack[waiting];
        }
    }
    return passed;
}

const int LIGHT_PROBES = 48; // light_pattern.h

// The light that passes along the ray to point i of a spiral on a light's disc around p + d.
LIGHT_SHARE passed_point(vec3 d, vec3 u, vec3 v, float distance, int i, float end)
{
    float angle = 6.28318531 * fract(float(i) * 0.381966011);
    return passed_ray(d + distance * (u * cos(angle) + v * sin(angle)), end);
}

// The light that passes along N rays to the points of a light's disc around p + d (light_pattern.h). The vector across
// is as long as the disc's radius. If N exceeds LIGHT_PROBES, that many probes are traced first. If the probes agree,
// no other rays are traced.
LIGHT_SHARE passed_disc(vec3 d, vec3 across, float end, int count)
{
    vec3 along = normalize(d);
    vec3 u = normalize(across - along * dot(along, across)) * length(across);
    vec3 v = cross(along, u);
    if (count > LIGHT_PROBES) {
        LIGHT_SHARE first = passed_point(d, u, v, 1.0, LIGHT_PROBES - 1, end);
        bool agree = true;
        for (int i = LIGHT_PROBES - 2; agree && i >= 0; i--) {
            agree = passed_point(d, u, v, sqrt(float(i) / float(LIGHT_PROBES - 1)), i, end) == first;
        }
        if (agree) {
            return first;
        }
    }
    LIGHT_SHARE sum = LIGHT_SHARE(0.0);
    for (int i = 0; i < count; i++) {
        sum = sum + passed_point(d, u, v, sqrt((float(i) + 0.5) / float(count)), i, end);
    }
    return sum / float(count);
}

// The axis along which d has its smallest component; the first axis if several are equal.
vec3 least_axis(vec3 d)
{
    vec3 size = abs(d);
    if (size.x <= size.y && size.x <= size.z) {
        return vec3(1.0, 0.0, 0.0);
    }
    return size.y <= size.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
}

// The share of a light that reaches the point. place.w is the radius of the light, or below 0 if it casts no shadow.
// For a directional light, place.xyz is the axis along which its direction has its smallest component. If the light
// does not shine on the point, no ray is traced.
LIGHT_SHARE shadowed_light(vec4 place, light_source light, light_sample t, float n_dot_l, int kind)
{
    if (place.w < 0.0 || !(n_dot_l > 0.0) || !(t.attenuation * t.spot > 0.0)) {
        return LIGHT_SHARE(1.0);
    }
    if (catches && unobstructed) {
        return LIGHT_SHARE(1.0);
    }
    bool directional = kind == LIGHT_DIRECTIONAL;
    float end = directional ? 1.0e30 : 1.0;
    vec3 d = directional ? -normalize(mat3(shadow_matrix) * light.direction)
                         : (shadow_matrix * vec4(light.position, 1.0)).xyz - ray_origin;
    if (place.w == 0.0) {
        return passed_ray(d, end);
    }
    vec3 across = directional ? place.xyz * place.w : least_axis(d) * (place.w * shadow_rounding.w);
    int count = int(shadow_offsets.w);
    return passed_disc(d, across, end, count);
}

light_source tinted_light(light_source light, vec3 passed)
{
    light.diffuse = light.diffuse * passed;
    light.specular = light.specular * passed;
    return light;
}
