// test_known_scenes.c: compares scene files with a mesh with normals and tangents, drawn as linear floats, with the
// textbook's sums over the same triangles: rays through the pixels' centres, in double, implemented independently of
// the renderer.

#include "test.h"
#include "vec.h"

enum { W = 96, H = 72, AROUND = 14, ALONG = 9, VERTICES = (AROUND + 1) * (ALONG + 1), TRIANGLES = 2 * AROUND * ALONG };

static vec each(vec a, vec b) { return of(a.x * b.x, a.y * b.y, a.z * b.z); }

// --- the mesh: an open piece of a sphere, so that both sides are visible

static float corner[VERTICES][9]; // position, normal, tangent
static int triangle[TRIANGLES][3];
static char ply[VERTICES * 160 + TRIANGLES * 24 + 600];

static void make_mesh(void)
{
    size_t used = (size_t)sprintf(ply, "ply\nformat ascii 1.0\nelement vertex %d\n", VERTICES);
    static const char *const names[9] = {"x", "y", "z", "nx", "ny", "nz", "tx", "ty", "tz"};
    for (int i = 0; i < 9; i++)
        used += (size_t)sprintf(ply + used, "property float %s\n", names[i]);
    used +=
        (size_t)sprintf(ply + used, "element face %d\nproperty list uchar int vertex_indices\nend_header\n", TRIANGLES);
    for (int j = 0; j <= ALONG; j++)
        for (int i = 0; i <= AROUND; i++) {
            double theta = 0.5 + 2.1 * j / ALONG, phi = 4.4 * i / AROUND;
            vec n = of(sin(theta) * cos(phi), cos(theta), -sin(theta) * sin(phi));
            double all[9] = {n.x, n.y, n.z, n.x, n.y, n.z, -sin(phi), 0, -cos(phi)};
            for (int k = 0; k < 9; k++) {
                corner[j * (AROUND + 1) + i][k] = (float)all[k];
                used += (size_t)sprintf(ply + used, "%.9g%c", (double)(float)all[k], k < 8 ? ' ' : '\n');
            }
        }
    for (int j = 0, t = 0; j < ALONG; j++)
        for (int i = 0; i < AROUND; i++) {
            int a = j * (AROUND + 1) + i, b = a + AROUND + 1;
            int two[2][3] = {{a, b, b + 1}, {a, b + 1, a + 1}};
            for (int k = 0; k < 2; k++, t++) {
                memcpy(triangle[t], two[k], sizeof two[k]);
                used += (size_t)sprintf(ply + used, "3 %d %d %d\n", two[k][0], two[k][1], two[k][2]);
            }
        }
}

static bool open_mesh(void *user, const char *name, lam_bytes *bytes, lam_error *error)
{
    (void)user, (void)name, (void)error;
    bytes->size = strlen(ply);
    bytes->data = malloc(bytes->size);
    memcpy(bytes->data, ply, bytes->size);
    return true;
}

// --- one case: the scene file's words, and the same numbers for the sums

enum law { POINT, DIRECTIONAL, CUTOFF, CONES };
enum method { PHONG_SHADING, GOURAUD, FLAT };
enum model { BLINN, PHONG, KAJIYA, LAMBERT };

struct light {
    enum law law;
    const char *frame; // "world", "camera", "object"
    vec at, way;       // position; the direction in which the light travels
    vec attenuation, ambient, diffuse, specular;
    double range, a, b; // cutoff and exponent, or inner and outer, degrees
};

struct known {
    const char *name;
    enum method method;
    enum model model;
    vec move, scale;
    double turn; // about y, degrees; M = translate · rotate · scale
    bool two_sided;
    struct light lights[2];
    int light_count;
};

static const vec ka = {0.3, 0.2, 0.25}, kd = {0.7, 0.5, 0.2}, ks = {0.6, 0.7, 0.8}, ke = {0.02, 0.01, 0.03},
                 la = {0.1, 0.2, 0.15};
static const vec back_kd = {0.1, 0.3, 0.9};
static const double shininess = 30;
static const vec eye = {0.4, 1.1, 4.2}, target = {0.1, 0, 0};
static const double fovy = 38;

static vec turned(const struct known *k, vec v)
{
    double c = cos(k->turn * M_PI / 180), s = sin(k->turn * M_PI / 180);
    return of(c * v.x + s * v.z, v.y, -s * v.x + c * v.z);
}
static vec direction_out(const struct known *k, vec v) { return turned(k, each(v, k->scale)); }
static vec point_out(const struct known *k, vec v) { return add(direction_out(k, v), k->move); }
static vec normal_out(const struct known *k, vec v) // the inverse transpose of rotate · scale
{
    return unit(turned(k, of(v.x / k->scale.x, v.y / k->scale.y, v.z / k->scale.z)));
}

static void camera_axes(vec *x, vec *y, vec *z)
{
    *z = unit(sub(eye, target));
    *x = unit(cross(of(0, 1, 0), *z));
    *y = cross(*z, *x);
}

// The light that leaves the point towards the eye.
static vec lit(const struct known *k, vec p, vec n, vec t, bool back)
{
    vec x, y, z, v = unit(sub(eye, p)), diffuse = back ? back_kd : kd, sum = add(ke, each(ka, la));
    camera_axes(&x, &y, &z);
    t = unit(sub(t, times(n, dot(n, t))));
    for (int i = 0; i < k->light_count; i++) {
        const struct light *light = &k->lights[i];
        vec at = light->at, way = light->way;
        if (strcmp(light->frame, "camera") == 0) {
            at = add(eye, add(add(times(x, at.x), times(y, at.y)), times(z, at.z)));
            way = add(add(times(x, way.x), times(y, way.y)), times(z, way.z));
        } else if (strcmp(light->frame, "object") == 0) {
            at = point_out(k, at);
            way = direction_out(k, way);
        }
        way = unit(way);
        vec l = light->law == DIRECTIONAL ? times(way, -1) : unit(sub(at, p));
        double d = sqrt(dot(sub(at, p), sub(at, p))), reach = 1, cone = 1, c = -dot(l, way);
        if (light->law != DIRECTIONAL) {
            reach = 1 / (light->attenuation.x + light->attenuation.y * d + light->attenuation.z * d * d);
            reach *= light->range > 0 ? fmax(fmin(1 - pow(d / light->range, 4), 1), 0) : 1;
        }
        if (light->law == CUTOFF)
            cone = c < cos(light->a * M_PI / 180) ? 0 : pow(c, light->b);
        if (light->law == CONES) {
            double inner = cos(light->a * M_PI / 180), outer = cos(light->b * M_PI / 180);
            cone = pow(fmin(fmax((c - outer) / fmax(0.001, inner - outer), 0), 1), 2);
        }
        double nl = dot(n, l), D = fmax(nl, 0), S = 0;
        vec h = unit(add(l, v)), r = sub(times(n, 2 * nl), l);
        if (k->model == BLINN)
            S = nl > 0 ? pow(fmax(dot(n, h), 0), shininess) : 0;
        if (k->model == PHONG)
            S = nl > 0 ? pow(fmax(dot(r, v), 0), shininess) : 0;
        if (k->model == KAJIYA) {
            vec tl = cross(t, l), tv = cross(t, v);
            double sine_l = sqrt(dot(tl, tl)), sine_v = sqrt(dot(tv, tv));
            D = nl > 0 ? sine_l : 0;
            S = nl > 0 ? pow(fmax(sine_l * sine_v - dot(t, l) * dot(t, v), 0), shininess) : 0;
        }
        sum = add(sum, each(ka, light->ambient));
        sum = add(sum, times(add(times(each(diffuse, light->diffuse), D), times(each(ks, light->specular), S)),
                             reach * cone));
    }
    return sum;
}

// The mesh in world space, with known sides.
struct world {
    vec p[VERTICES], n[VERTICES], t[VERTICES];
    double sign; // of the determinant
};

// The nearest triangle along a ray, and the weights of its corners. −1 means none.
static int hit(const struct world *w, vec way, double weights[3])
{
    double nearest = 1e300;
    int found = -1;
    for (int i = 0; i < TRIANGLES; i++) {
        vec a = w->p[triangle[i][0]], e1 = sub(w->p[triangle[i][1]], a), e2 = sub(w->p[triangle[i][2]], a);
        vec q = cross(way, e2), s = sub(eye, a), r = cross(s, e1);
        double f = 1 / dot(e1, q), u = f * dot(s, q), v = f * dot(way, r), d = f * dot(e2, r);
        if (u < 0 || v < 0 || u + v > 1 || d <= 0 || d >= nearest)
            continue;
        nearest = d;
        found = i;
        weights[0] = 1 - u - v;
        weights[1] = u;
        weights[2] = v;
    }
    return found;
}

static vec mix(const vec *of_corners, const int *c, const double *b)
{
    return add(add(times(of_corners[c[0]], b[0]), times(of_corners[c[1]], b[1])), times(of_corners[c[2]], b[2]));
}

static vec expected(const struct known *k, const struct world *w, int i, const double b[3])
{
    const int *c = triangle[i];
    vec face = times(cross(sub(w->p[c[1]], w->p[c[0]]), sub(w->p[c[2]], w->p[c[0]])), w->sign);
    bool back = dot(face, sub(eye, w->p[c[0]])) < 0 && k->two_sided;
    double flip = back ? -1 : 1;
    if (k->method == PHONG_SHADING)
        return lit(k, mix(w->p, c, b), times(unit(mix(w->n, c, b)), flip), mix(w->t, c, b), back);
    if (k->method == FLAT)
        return lit(k, w->p[c[2]], times(unit(face), flip), w->t[c[2]], back);
    vec sum = of(0, 0, 0);
    for (int j = 0; j < 3; j++)
        sum = add(sum, times(lit(k, w->p[c[j]], times(w->n[c[j]], flip), w->t[c[j]], back), b[j]));
    return sum;
}

// --- the scene file

static char scene_text[4096];

static void add_light(const struct light *l)
{
    static const char *const types[] = {"point", "directional", "spot", "spot"};
    char *at = scene_text + strlen(scene_text);
    at += sprintf(at, "{\"type\": \"%s\", \"frame\": \"%s\", ", types[l->law], l->frame);
    if (l->law != DIRECTIONAL)
        at += sprintf(at,
                      "\"position\": [%.17g, %.17g, %.17g], \"attenuation\": [%.17g, %.17g, %.17g], \"range\": %.17g, ",
                      l->at.x, l->at.y, l->at.z, l->attenuation.x, l->attenuation.y, l->attenuation.z, l->range);
    if (l->law != POINT)
        at += sprintf(at, "\"direction\": [%.17g, %.17g, %.17g], ", l->way.x, l->way.y, l->way.z);
    if (l->law == CUTOFF)
        at += sprintf(at, "\"cutoff\": %.17g, \"exponent\": %.17g, ", l->a, l->b);
    if (l->law == CONES)
        at += sprintf(at, "\"inner\": %.17g, \"outer\": %.17g, ", l->a, l->b);
    sprintf(at,
            "\"ambient\": [%.17g, %.17g, %.17g], \"diffuse\": [%.17g, %.17g, %.17g], \"specular\": [%.17g, "
            "%.17g, %.17g]}",
            l->ambient.x, l->ambient.y, l->ambient.z, l->diffuse.x, l->diffuse.y, l->diffuse.z, l->specular.x,
            l->specular.y, l->specular.z);
}

static lam_scene *load(const struct known *k)
{
    static const char *const methods[] = {"phong", "gouraud", "flat"};
    static const char *const models[] = {"blinn-phong", "phong", "kajiya-kay", "lambert"};
    sprintf(scene_text,
            "{\"lambent\": 1, \"image\": {\"size\": [%d, %d], \"samples\": 1, \"color\": \"raw\"}, "
            "\"camera\": {\"eye\": [%.17g, "
            "%.17g, %.17g], \"target\": [%.17g, 0, 0], \"fovy\": %.17g, \"near\": 0.5, \"far\": 50}, "
            "\"ambient\": [%.17g, %.17g, "
            "%.17g], \"shading\": \"%s\", \"reflection\": \"%s\", \"objects\": [{\"file\": \"m.ply\", "
            "\"two_sided\": %s, "
            "\"material\": {\"ambient\": [0.3, 0.2, 0.25], \"diffuse\": [0.7, 0.5, 0.2], \"specular\": [0.6, "
            "0.7, 0.8], "
            "\"emission\": [0.02, 0.01, 0.03], \"shininess\": 30}, \"back_material\": {\"diffuse\": [0.1, "
            "0.3, 0.9]}, "
            "\"transform\": [[\"translate\", %.17g, %.17g, %.17g], [\"rotate\", %.17g, 0, 1, 0], [\"scale\", "
            "%.17g, %.17g, "
            "%.17g]]}], \"lights\": [",
            W, H, eye.x, eye.y, eye.z, target.x, fovy, la.x, la.y, la.z, methods[k->method], models[k->model],
            k->two_sided ? "true" : "false", k->move.x, k->move.y, k->move.z, k->turn, k->scale.x, k->scale.y,
            k->scale.z);
    for (int i = 0; i < k->light_count; i++) {
        if (i)
            strcat(scene_text, ", ");
        add_light(&k->lights[i]);
    }
    strcat(scene_text, "]}");
    lam_load_params params = {.threads = 1, .open = open_mesh};
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(scene_text, strlen(scene_text), "s.json", &params, NULL, &error);
    if (!scene)
        fail_msg("%s: %s", k->name, error.text);
    return scene;
}

static void compare(const struct known *k)
{
    static struct world w;
    AUTO_SCENE scene = load(k);
    lam_picture_settings settings;
    AUTO_IMAGE image = {0};
    lam_error error = {0};
    AUTO_DEVICE device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, &error);
    assert_true(lam_scene_picture_settings(scene, &settings));
    assert_true(lam_image_make(&image, settings.width, settings.height, LAM_RGBA32F, &error));
    if (!lam_draw(device, scene, &settings.camera, &settings.draw, &image, NULL, &error))
        fail_msg("%s: %s", k->name, error.text);
    for (int i = 0; i < VERTICES; i++) {
        const float *c = corner[i];
        w.p[i] = point_out(k, of((double)c[0], (double)c[1], (double)c[2]));
        w.n[i] = normal_out(k, of((double)c[3], (double)c[4], (double)c[5]));
        // as a vertex shader passes it on
        w.t[i] = unit(direction_out(k, of((double)c[6], (double)c[7], (double)c[8])));
    }
    w.sign = k->scale.x * k->scale.y * k->scale.z < 0 ? -1 : 1;
    vec x, y, z;
    camera_axes(&x, &y, &z);
    double half = tan(fovy * M_PI / 360), largest = 0, total = 0;
    int counted = 0;
    for (int j = 0; j < H; j++)
        for (int i = 0; i < W; i++) {
            double b[3] = {0}, px = (2 * (i + 0.5) / W - 1) * half * W / H, py = (1 - 2 * (j + 0.5) / H) * half;
            int t = hit(&w, sub(add(times(x, px), times(y, py)), z), b);
            const float *got = (const float *)image.pixels + 4 * (j * W + i);
            // Coverage is determined from snapped corners, so a pixel at an edge may show its neighbour.
            if (t < 0 || !(got[3] > 0) || b[0] < 0.01 || b[1] < 0.01 || b[2] < 0.01)
                continue;
            vec want = expected(k, &w, t, b);
            const double parts[3] = {want.x, want.y, want.z};
            for (int c = 0; c < 3; c++) {
                double off = fabs(parts[c] - (double)got[c]);
                largest = fmax(largest, off);
                total += off;
            }
            counted++;
        }
    print_message("%-28s %4d pixels, at most %.2e, on average %.2e\n", k->name, counted, largest,
                  total / (3 * counted));
    assert_true(counted > 1000);
    assert_true(largest <= 2e-4);
    assert_true(total / (3 * counted) <= 2e-6);
}

#define WHITE      {1, 1, 1}
#define STRAIGHT   .scale = WHITE, .two_sided = true
#define PLAIN      .attenuation = {1, 0, 0}, .diffuse = WHITE, .specular = WHITE
#define FROM_POINT {POINT, "world", .at = {2, 3, 4}, PLAIN}

TEST(test_known_scenes)
{
    static const struct known cases[] = {
        {"point", STRAIGHT, .lights = {FROM_POINT}, .light_count = 1},
        {"point, attenuated, ranged", STRAIGHT,
         .lights = {{POINT,
                     "world",
                     {1, 1.5, 2},
                     .attenuation = {0.2, 0.1, 0.3},
                     .ambient = {0.1, 0, 0.2},
                     .diffuse = {1, 0.6, 0.3},
                     .specular = {0.2, 0.9, 1},
                     .range = 4}},
         .light_count = 1},
        {"directional, phong", STRAIGHT, .model = PHONG,
         .lights = {{DIRECTIONAL, "world", .way = {-1, -2, -1.5}, PLAIN}}, .light_count = 1},
        {"spot, cutoff", STRAIGHT,
         .lights = {{CUTOFF, "world", {0.5, 2, 2.5}, {-0.2, -0.9, -1.1}, PLAIN, .a = 40, .b = 8}}, .light_count = 1},
        {"spot, cones, camera", STRAIGHT,
         .lights = {{CONES, "camera", {0.3, 0.2, 0}, {0, 0, -1}, PLAIN, .a = 5, .b = 18}}, .light_count = 1},
        {"spot in the object's frame", .move = {0.2, -0.1, 0.3}, .turn = 35, .scale = {1.2, 0.7, 1}, .two_sided = true,
         .lights = {{CONES, "object", {0, 1, 2.5}, {0, -0.3, -1}, PLAIN, .a = 10, .b = 30}}, .light_count = 1},
        {"non-uniform scale, two lights", .move = {0, 0.1, 0}, .turn = -50, .scale = {0.6, 1.3, 1.1}, .two_sided = true,
         .lights = {FROM_POINT,
                    {DIRECTIONAL, "camera", .way = {1, -1, -1}, .diffuse = {0.2, 0.3, 0.6}, .specular = {0.3, 0, 0}}},
         .light_count = 2},
        {"mirrored", .turn = 20, .scale = {1, -1.2, 1}, .two_sided = true, .lights = {FROM_POINT}, .light_count = 1},
        {"one-sided", .turn = 100, .scale = WHITE, .two_sided = false, .lights = {FROM_POINT}, .light_count = 1},
        {"gouraud", STRAIGHT, .method = GOURAUD, .turn = 60, .lights = {FROM_POINT}, .light_count = 1},
        {"flat", .method = FLAT, .turn = 60, .scale = {1, 1.2, 0.8}, .two_sided = true, .lights = {FROM_POINT},
         .light_count = 1},
        {"flat, mirrored", .method = FLAT, .scale = {-1, 1.2, 0.8}, .two_sided = true, .lights = {FROM_POINT},
         .light_count = 1},
        {"lambert", STRAIGHT, .model = LAMBERT, .lights = {FROM_POINT}, .light_count = 1},
        {"kajiya-kay, tangents", .model = KAJIYA, .turn = 25, .scale = {1.1, 0.8, 1}, .two_sided = true,
         .lights = {FROM_POINT}, .light_count = 1},
    };
    make_mesh();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        compare(&cases[i]);
}
