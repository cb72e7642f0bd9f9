// contracts.c: draws docs/mistakes.md's pictures: each known mistake of lectures and tutorials beside the correct form.
//
//   mistakes FOLDER     writes FOLDER/mistake-NAME.png: the mistake on the left, the correct picture on the right
//
// A renderer that can be wrong on purpose, apart from the library that must not be: it casts a ray for each pixel at a
// coarse mesh, interpolates what a vertex shader would hand on, and lights with the formulas of docs/lighting.md in
// double.
#include <lambent/lambent.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef lam_vec3 vec;

static vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vec sub(vec a, vec b) { return (vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
static vec mul(vec a, double s) { return (vec){a.x * s, a.y * s, a.z * s}; }
static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec cross(vec a, vec b) { return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static vec unit(vec a)
{
    double length = sqrt(dot(a, a));
    return length > 0 ? mul(a, 1 / length) : a;
}
static vec mirror(vec w, vec n) { return sub(mul(n, 2 * dot(n, w)), w); }
static vec times(vec a, vec b) { return (vec){a.x * b.x, a.y * b.y, a.z * b.z}; }

enum mistake {
    NONE,
    NORMAL_BY_MODEL,
    CLIP_SPACE,
    DIRECTION_MINUS_POINT,
    DIRECTION_AS_POINT,
    RAW_HALF,
    NO_GATE,
    BARE_SPECULAR,
    MEAN_DISTANCE,
    LONG_NORMAL,
    NO_GLOBAL_AMBIENT,
    NORMAL_WITH_W,
    VERTEX_AS_FLAT,
    LIGHT_IN_MIRROR,
    THREAD_SIGN,
    THREAD_GATE,
    NO_FLIP,
    OBJECT_EYE,
    AFFINE,
    AMBIENT_ATTENUATED,
    INWARD,
};

enum look { PHONG, DIFFUSE, FLAT, THREADS, SKY, STRIPES };

// A picture's scene: a coarse mesh, scaled, under one light.
struct study {
    const char *name;
    enum mistake mistake;
    enum look look;
    int slices, stacks; // of the sphere; 0: a ground of two triangles
    vec scale;          // of the model
    bool bowl;          // only the sphere's far half: its inside is seen
    vec light;          // position, or where a directional light comes from
    bool directional;
    vec attenuation;
    double shininess;
};

static const vec eye = {0, 0, 5}; // everything is in eye space moved by this: the camera looks along −z
enum { SIZE = 240, CORNERS_MAX = 40000 };

struct corner {
    vec p, n; // mesh space
};
static struct corner corners[CORNERS_MAX];
static float bounds[CORNERS_MAX / 3][4]; // of each triangle on the screen: least x, y, largest x, y of direction / −z
static int corner_count;

static void put_corner(vec p, vec n) { corners[corner_count++] = (struct corner){p, n}; }

// Where triangles lie on the screen, so that a ray asks few of them. What reaches behind the eye is asked by all.
static void find_bounds(const struct study *s)
{
    for (int t = 0; t < corner_count / 3; t++) {
        float *b = bounds[t];
        b[0] = b[1] = 1e9f;
        b[2] = b[3] = -1e9f;
        for (int k = 0; k < 3; k++) {
            vec p = sub(times(corners[3 * t + k].p, s->scale), eye);
            if (p.z > -0.1) {
                b[0] = b[1] = -1e9f;
                b[2] = b[3] = 1e9f;
                break;
            }
            b[0] = fminf(b[0], (float)(p.x / -p.z));
            b[1] = fminf(b[1], (float)(p.y / -p.z));
            b[2] = fmaxf(b[2], (float)(p.x / -p.z));
            b[3] = fmaxf(b[3], (float)(p.y / -p.z));
        }
    }
}

static vec on_sphere(int i, int j, const struct study *s)
{
    double u = 2 * M_PI * i / s->slices, v = M_PI * j / s->stacks;
    return (vec){sin(v) * sin(u), cos(v), sin(v) * cos(u)};
}

static void build(const struct study *s)
{
    corner_count = 0;
    if (!s->slices) {
        const vec g[4] = {{-3, -1, 4}, {3, -1, 4}, {3, -1, -12}, {-3, -1, -12}}, up = {0, 1, 0};
        const int order[6] = {0, 1, 2, 0, 2, 3};
        for (int k = 0; k < 6; k++)
            put_corner(g[order[k]], up);
        return;
    }
    for (int j = 0; j < s->stacks; j++)
        for (int i = 0; i < s->slices; i++) {
            if (s->bowl &&
                on_sphere(2 * i + 1, 2 * j + 1, &(struct study){.slices = 2 * s->slices, .stacks = 2 * s->stacks}).z >
                    0)
                continue;
            vec a = on_sphere(i, j, s), b = on_sphere(i, j + 1, s), c = on_sphere(i + 1, j + 1, s),
                d = on_sphere(i + 1, j, s);
            const vec order[6] = {a, b, c, a, c, d};
            for (int k = 0; k < 6; k++)
                put_corner(order[k], order[k]);
        }
}

// What the vertex shader does with a normal: the inverse transpose of the scale, made unit; or a mistake.
static vec vertex_normal(const struct study *s, enum mistake m, vec n)
{
    if (m == NORMAL_BY_MODEL)
        return unit(times(n, s->scale));
    vec right = unit((vec){n.x / s->scale.x, n.y / s->scale.y, n.z / s->scale.z});
    if (m == NORMAL_WITH_W) // normalize(matrix4 * vec4(n, 0)).xyz where the transpose put the translation into w
        return mul(right, 1 / sqrt(1 + pow(dot(right, (vec){0, 0, 1.5}), 2)));
    return m == INWARD ? mul(right, -1) : right;
}

static vec project(vec p) // by a perspective matrix, as three of the four clip coordinates
{
    double z = p.z - eye.z;
    return (vec){2.4 * p.x, 2.4 * p.y, -1.22 * z - 2.22};
}

static vec sky(vec r)
{
    double t = 0.5 + 0.5 * r.y;
    double sun = pow(fmax(dot(r, unit((vec){-0.5, 0.6, 0.6})), 0), 60);
    vec c = r.y > 0 ? (vec){0.25 + 0.3 * t, 0.4 + 0.3 * t, 0.9} : (vec){0.35, 0.28, 0.2};
    return add(c, (vec){sun, sun, 0.8 * sun});
}

// A fragment: interpolated position, normal, distance to the light as the vertices had it, and the triangle's own
// values.
struct fragment {
    vec p, n, face, last_normal;
    double mean_distance;
    vec affine; // the position as it would be interpolated without perspective
};

static vec light_fragment(const struct study *s, enum mistake m, struct fragment f)
{
    vec kd = {0.75, 0.45, 0.15}, ks = {0.7, 0.7, 0.7}, ka = {0.12, 0.07, 0.03};
    vec n = m == LONG_NORMAL || m == NORMAL_WITH_W ? f.n : unit(f.n);
    if (s->look == FLAT)
        n = m == VERTEX_AS_FLAT ? f.last_normal : f.face;
    vec v = unit(sub(eye, f.p));
    if (dot(unit(f.face), v) < 0 && m != NO_FLIP && m != INWARD)
        n = mul(n, -1);
    if (m == OBJECT_EYE) // the eye of eye space, its origin, minus the vertex before its model-view matrix
        v = unit((vec){-f.p.x / s->scale.x, -f.p.y / s->scale.y, -f.p.z / s->scale.z});
    if (s->look == SKY) {
        vec l = unit(sub(s->light, f.p));
        return sky(m == LIGHT_IN_MIRROR ? mirror(l, n) : mirror(v, n));
    }
    if (s->look == STRIPES) {
        vec q = m == AFFINE ? f.affine : f.p;
        bool odd = ((int)floor(q.x * 2) + (int)floor(q.z * 2)) & 1;
        return odd ? (vec){0.9, 0.9, 0.85} : (vec){0.1, 0.15, 0.3};
    }
    vec way = sub(s->light, f.p);
    if (s->directional && m != DIRECTION_AS_POINT)
        way = s->light;
    double distance = sqrt(dot(way, way)), spread = 1;
    if (m == DIRECTION_MINUS_POINT) // l = position − (0,0,0,1): w = −1 is counted when l is made unit
        spread = sqrt(dot(unit(way), unit(way)) / (dot(unit(way), unit(way)) + 1));
    if (m == CLIP_SPACE) {
        way = sub(project(s->light), project(f.p));
        distance = sqrt(dot(way, way));
        v = unit(mul(project(f.p), -1));
    }
    vec l = mul(unit(way), spread);
    if (m == MEAN_DISTANCE)
        distance = f.mean_distance;
    double attenuation =
        s->directional ? 1
                       : 1 / (s->attenuation.x + s->attenuation.y * distance + s->attenuation.z * distance * distance);
    double nl = dot(n, l), D = fmax(nl, 0), S;
    if (s->look == THREADS) {
        vec t = unit(cross((vec){0, 1, 0}, n));
        double tl = dot(t, l), tv = dot(t, v), sl = sqrt(fmax(1 - tl * tl, 0)), sv = sqrt(fmax(1 - tv * tv, 0));
        bool lit = nl > 0 || m == THREAD_GATE;
        D = lit ? sl : 0;
        S = lit ? pow(fmax(m == THREAD_SIGN ? sl * sv + tl * tv : sl * sv - tl * tv, 0), s->shininess) : 0;
    } else {
        vec h = unit(add(m == RAW_HALF ? way : l, v));
        S = pow(fmax(dot(n, h), 0), s->shininess);
        if (nl <= 0 && m != NO_GATE)
            S = 0;
    }
    if (s->look == DIFFUSE)
        S = 0;
    vec ambient = mul(ka, 1 + (m == NO_GLOBAL_AMBIENT ? 0 : 0.8));
    if (m == AMBIENT_ATTENUATED)
        ambient = mul(ambient, attenuation);
    return add(ambient, add(mul(kd, attenuation * D), mul(ks, (m == BARE_SPECULAR ? 1 : attenuation) * S)));
}

static double light_distance(const struct study *s, vec p) { return sqrt(dot(sub(s->light, p), sub(s->light, p))); }

// The nearest triangle that a ray hits (Möller and Trumbore, 1997), as a fragment.
static bool cast(const struct study *s, enum mistake m, vec direction, struct fragment *out)
{
    double nearest = 1e300;
    float sx = (float)(direction.x / -direction.z), sy = (float)(direction.y / -direction.z);
    for (int c = 0; c + 2 < corner_count; c += 3) {
        const float *in = bounds[c / 3];
        if (sx < in[0] || sy < in[1] || sx > in[2] || sy > in[3])
            continue;
        vec p[3], e1, e2;
        for (int k = 0; k < 3; k++)
            p[k] = times(corners[c + k].p, s->scale);
        e1 = sub(p[1], p[0]);
        e2 = sub(p[2], p[0]);
        vec q = cross(direction, e2), t = sub(eye, p[0]), r = cross(t, e1);
        double det = dot(e1, q), b1 = dot(t, q) / det, b2 = dot(direction, r) / det, at = dot(e2, r) / det;
        if (det == 0 || b1 < 0 || b2 < 0 || b1 + b2 > 1 || at <= 0 || at >= nearest)
            continue;
        nearest = at;
        double b[3] = {1 - b1 - b2, b1, b2}, screen[3], sum = 0;
        *out = (struct fragment){.face = unit(cross(e1, e2)), .last_normal = vertex_normal(s, m, corners[c + 2].n)};
        for (int k = 0; k < 3; k++)
            sum += screen[k] = b[k] * (eye.z - p[k].z); // weights on the screen: perspective taken out
        for (int k = 0; k < 3; k++) {
            out->p = add(out->p, mul(p[k], b[k]));
            out->n = add(out->n, mul(vertex_normal(s, m, corners[c + k].n), b[k]));
            out->mean_distance += b[k] * light_distance(s, p[k]);
            out->affine = add(out->affine, mul(p[k], screen[k] / sum));
        }
    }
    return nearest < 1e300;
}

static uint8_t encode(double x)
{
    x = fmin(fmax(x, 0), 1);
    return (uint8_t)floor(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055) + 0.5);
}

static void draw_half(const struct study *s, enum mistake m, lam_image *image, int left)
{
    build(s);
    find_bounds(s);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            vec sum = {0, 0, 0};
            enum { SIDE = 3 };
            for (int k = 0; k < SIDE * SIDE; k++) {
                double px = (x + (k % SIDE + 0.5) / SIDE) / SIZE * 2 - 1,
                       py = 1 - (y + (k / SIDE + 0.5) / SIDE) / SIZE * 2;
                vec direction = unit((vec){px * 0.27, py * 0.27, -1});
                struct fragment f = {0};
                vec colour = {1, 1, 1};
                if (cast(s, m, direction, &f))
                    colour = light_fragment(s, m, f);
                sum =
                    add(sum, (vec){fmin(fmax(colour.x, 0), 1), fmin(fmax(colour.y, 0), 1), fmin(fmax(colour.z, 0), 1)});
            }
            uint8_t *to = (uint8_t *)image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)(left + x));
            to[0] = encode(sum.x / 9);
            to[1] = encode(sum.y / 9);
            to[2] = encode(sum.z / 9);
        }
}

#define BALL .slices = 24, .stacks = 12, .scale = {1, 1, 1}, .shininess = 40, .attenuation = {1, 0, 0}

static const struct study studies[] = {
    {"normal-by-model", NORMAL_BY_MODEL, PHONG, BALL, .scale = {1, 0.45, 1}, .light = {-2, 3, 4}},
    {"clip-space", CLIP_SPACE, PHONG, BALL, .light = {-2, 3, 4}},
    {"direction-minus-point", DIRECTION_MINUS_POINT, PHONG, BALL, .light = {-2, 3, 4}, .directional = true},
    {"direction-as-point", DIRECTION_AS_POINT, PHONG, BALL, .light = {-0.8, 1.2, 1.6}, .directional = true},
    {"raw-half", RAW_HALF, PHONG, BALL, .light = {-4, 3, 5}},
    {"no-gate", NO_GATE, PHONG, BALL, .shininess = 4, .light = {-4, 1, -3}},
    {"bare-specular", BARE_SPECULAR, PHONG, BALL, .light = {-2, 3, 4}, .attenuation = {1, 0, 0.12}},
    {"mean-distance", MEAN_DISTANCE, DIFFUSE, .scale = {1, 1, 1}, .light = {0, -0.4, -1}, .attenuation = {0.2, 0, 0.6}},
    {"long-normal", LONG_NORMAL, PHONG, BALL, .slices = 8, .stacks = 5, .light = {-2, 3, 4}},
    {"no-global-ambient", NO_GLOBAL_AMBIENT, PHONG, BALL, .light = {-4, 3, 1}},
    {"normal-with-w", NORMAL_WITH_W, PHONG, BALL, .light = {-2, 3, 4}},
    {"vertex-as-flat", VERTEX_AS_FLAT, FLAT, BALL, .slices = 12, .stacks = 6, .light = {-2, 3, 4}},
    {"light-in-mirror", LIGHT_IN_MIRROR, SKY, BALL, .slices = 48, .stacks = 24, .light = {-2, 3, 4}},
    {"thread-sign", THREAD_SIGN, THREADS, BALL, .light = {-2, 3, 4}},
    {"thread-gate", THREAD_GATE, THREADS, BALL, .light = {-4, 2, -1}},
    {"no-flip", NO_FLIP, PHONG, BALL, .bowl = true, .light = {-1, 3, 2}},
    {"object-eye", OBJECT_EYE, PHONG, BALL, .scale = {1, 0.6, 1}, .light = {-2, 2, 4}},
    {"affine", AFFINE, STRIPES, .scale = {1, 1, 1}, .attenuation = {1, 0, 0}},
    {"ambient-attenuated", AMBIENT_ATTENUATED, PHONG, BALL, .light = {-2, 3, 4}, .attenuation = {1, 0, 0.2}},
    {"inward", INWARD, PHONG, BALL, .light = {-2, 3, 4}},
};

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: mistakes FOLDER\n");
        return 1;
    }
    lam_error error = {0};
    for (size_t i = 0; i < sizeof studies / sizeof studies[0]; i++) {
        lam_image image = {0};
        char path[512];
        snprintf(path, sizeof path, "%s/mistake-%s.png", argv[1], studies[i].name);
        bool ok = lam_image_make(&image, 2 * SIZE + 8, SIZE, LAM_RGBA8, &error);
        if (ok) {
            memset(image.pixels, 255, (size_t)image.width * SIZE * 4);
            draw_half(&studies[i], studies[i].mistake, &image, 0);
            draw_half(&studies[i], NONE, &image, SIZE + 8);
            ok = lam_image_save(&image, path, NULL, &error);
        }
        lam_image_free(&image);
        if (!ok) {
            fprintf(stderr, "mistakes: %s\n", error.text);
            return error.code;
        }
    }
    return 0;
}
