// shapes.c: the table of built-in shapes, and the public functions that tessellate surfaces.
//
// Every shape is built with radius 1, inscribed in the cube from (−1, −1, −1) to (1, 1, 1), and scaled at the end. The
// axis of round shapes is Y; their seam is at the back (−Z), so that the centre of a texture faces the viewer.
#include "shapes.h"

#include "fail.h"
#include "float_state.h"
#include "formula.h"
#include "linear.h"
#include "scene_internal.h"
#include "spelling.h"

#include <string.h>

struct circle_point circle(double steps, double around)
{
    double four = 4 * steps;
    long long quarter = (long long)(four / around + (four >= 0 ? 0.5 : -0.5));
    double rest = (four - (double)quarter * around) / around; // quarter turns, −½…½; the numerator is exact
    double c = math_cos(rest * (PI / 2)), s = math_sin(rest * (PI / 2));
    switch (quarter & 3) {
    case 0:
        return (struct circle_point){c, s};
    case 1:
        return (struct circle_point){-s, c};
    case 2:
        return (struct circle_point){-c, -s};
    default:
        return (struct circle_point){s, -c};
    }
}

// Parameters of the formulas below; u counts slices, v counts stacks.
struct segments {
    double slices, stacks;
};

// Returns the horizontal direction after u slices, from the back to the left, and its derivative with respect to the
// angle.
static lam_vec3 around(const struct segments *n, double u, lam_vec3 *sideways)
{
    struct circle_point at = circle(u, n->slices);
    *sideways = v3(-at.c, 0, at.s);
    return v3(-at.s, 0, -at.c);
}

static lam_vec3 up(double y) { return v3(0, y, 0); }

static void sphere_point(void *user, double u, double v, lam_surface_point *out)
{
    const struct segments *n = user;
    lam_vec3 sideways, outward = around(n, u, &sideways);
    struct circle_point latitude = circle(2 * v - n->stacks, 4 * n->stacks);
    double c = latitude.c, s = latitude.s;
    out->p = v3_add(v3_scale(outward, c), up(s));
    out->dp_du = v3_scale(sideways, (c > 0 ? c : 1) * (2 * PI / n->slices)); // at the poles, the limit of the direction
    out->dp_dv = v3_scale(v3_add(v3_scale(outward, -s), up(c)), PI / n->stacks);
}

#define TORUS_RING 0.7 // radius of the tube's centre line
#define TORUS_TUBE 0.3

static void torus_point(void *user, double u, double v, lam_surface_point *out)
{
    const struct segments *n = user;
    lam_vec3 sideways, outward = around(n, u, &sideways);
    struct circle_point tube = circle(v, n->stacks);
    double c = -tube.c, s = -tube.s; // the seam faces the hole
    double distance = TORUS_RING + TORUS_TUBE * c;
    out->p = v3_add(v3_scale(outward, distance), up(TORUS_TUBE * s));
    out->dp_du = v3_scale(sideways, distance * (2 * PI / n->slices));
    out->dp_dv = v3_scale(v3_add(v3_scale(outward, -s), up(c)), TORUS_TUBE * (2 * PI / n->stacks));
}

static void cylinder_side(void *user, double u, double v, lam_surface_point *out)
{
    const struct segments *n = user;
    lam_vec3 sideways, outward = around(n, u, &sideways);
    out->p = v3_add(outward, up((2 * v - n->stacks) / n->stacks));
    out->dp_du = v3_scale(sideways, 2 * PI / n->slices);
    out->dp_dv = up(2 / n->stacks);
}

static void cone_side(void *user, double u, double v, lam_surface_point *out)
{
    const struct segments *n = user;
    lam_vec3 sideways, outward = around(n, u, &sideways);
    double radius = (n->stacks - v) / n->stacks;
    out->p = v3_add(v3_scale(outward, radius), up((2 * v - n->stacks) / n->stacks));
    out->dp_du = v3_scale(sideways, 2 * PI / n->slices); // the limit of the direction at the apex
    out->dp_dv = v3_scale(v3_sub(up(2), outward), 1 / n->stacks);
}

// Discs. v runs from the rim to the centre on the top disc, and from the centre to the rim on the bottom disc, so that
// ∂p/∂u × ∂p/∂v points outward.
static void top_disc(void *user, double u, double v, lam_surface_point *out)
{
    const struct segments *n = user;
    lam_vec3 sideways, outward = around(n, u, &sideways);
    out->p = v3_add(v3_scale(outward, 1 - v), up(1));
    out->dp_du = v3_scale(sideways, 2 * PI / n->slices);
    out->dp_dv = v3_scale(outward, -1);
}

static void bottom_disc(void *user, double u, double v, lam_surface_point *out)
{
    const struct segments *n = user;
    lam_vec3 sideways, outward = around(n, u, &sideways);
    out->p = v3_add(v3_scale(outward, v), up(-1));
    out->dp_du = v3_scale(sideways, 2 * PI / n->slices);
    out->dp_dv = outward;
}

// A square of side 2: its centre and two axes.
struct square {
    lam_vec3 middle, u, v;
};

static void square_point(void *user, double u, double v, lam_surface_point *out)
{
    const struct square *square = user;
    out->p = v3_add(square->middle, v3_add(v3_scale(square->u, u), v3_scale(square->v, v)));
    out->dp_du = square->u;
    out->dp_dv = square->v;
}

// The torus knot winds KNOT_TURNS times around Y and KNOT_LOOPS times around the tube of a torus: a trefoil. The
// cross-section of the knot's own tube has the axes m and b = m × t. m is the torus's outward normal, which is
// perpendicular to the curve.
enum { KNOT_TURNS = 2, KNOT_LOOPS = 3 };
#define KNOT_RING 0.6
#define KNOT_LOOP 0.25
#define KNOT_TUBE 0.15

static void knot_point(void *user, double u, double v, lam_surface_point *out)
{
    const struct segments *n = user;
    const double p = KNOT_TURNS, q = KNOT_LOOPS;
    // e: horizontal direction; f: its derivative with respect to pθ (f′ = −e); c, s: cosine and sine of qθ.
    lam_vec3 f, e = around(n, p * u, &f);
    struct circle_point loop = circle(q * u, n->slices), tube = circle(v, n->stacks);
    double c = loop.c, s = loop.s;
    double r = KNOT_RING + KNOT_LOOP * c, r1 = -KNOT_LOOP * q * s, r2 = -KNOT_LOOP * q * q * c;
    lam_vec3 curve = v3_add(v3_scale(e, r), up(KNOT_LOOP * s));
    lam_vec3 d1 = v3_add(v3_add(v3_scale(e, r1), v3_scale(f, r * p)), up(KNOT_LOOP * q * c));
    lam_vec3 d2 = v3_add(v3_add(v3_scale(e, r2 - r * p * p), v3_scale(f, 2 * r1 * p)), up(-KNOT_LOOP * q * q * s));
    double speed = v3_length(d1);
    lam_vec3 t = v3_scale(d1, 1 / speed);
    lam_vec3 t1 = v3_scale(v3_sub(d2, v3_scale(t, v3_dot(t, d2))), 1 / speed);
    lam_vec3 m = v3_add(v3_scale(e, c), up(s));
    lam_vec3 m1 = v3_add(v3_add(v3_scale(e, -q * s), v3_scale(f, c * p)), up(q * c));
    lam_vec3 b = v3_cross(m, t), b1 = v3_add(v3_cross(m1, t), v3_cross(m, t1));
    out->p = v3_add(curve, v3_scale(v3_add(v3_scale(m, tube.c), v3_scale(b, tube.s)), KNOT_TUBE));
    lam_vec3 du = v3_add(d1, v3_scale(v3_add(v3_scale(m1, tube.c), v3_scale(b1, tube.s)), KNOT_TUBE));
    out->dp_du = v3_scale(du, 2 * PI / n->slices);
    out->dp_dv = v3_scale(v3_sub(v3_scale(b, tube.c), v3_scale(m, tube.s)), KNOT_TUBE * (2 * PI / n->stacks));
}

// The gyroid g = sin x cos y + sin y cos z + sin z cos x as a wall |g| < GYROID_WALL, intersected with a sphere. With
//
//   a = (g² − wall²)·scale    about the distance to the wall
//   b = |p| − GYROID_REACH    the distance to the sphere
//   f = (a + b + √((a − b)² + rim²))/2
//
// f is a smooth maximum of a and b and never less than either. At the minimum of a (g = 0), f = 0 at b = rim²/4a: the
// sphere is larger by this amount, so that the rim has radius 1.
#define GYROID_WAVES 1.0 // along a radius
#define GYROID_WALL  0.5
#define GYROID_RIM   0.08
#define GYROID_SCALE (1 / (2 * GYROID_WALL * 2 * PI * GYROID_WAVES))
#define GYROID_REACH (1 + GYROID_RIM * GYROID_RIM / (4 * GYROID_WALL * GYROID_WALL * GYROID_SCALE))

static double gyroid_terms(lam_vec3 p, lam_vec3 *gradient)
{
    const double k = 2 * PI * GYROID_WAVES;
    double sx = math_sin(k * p.x), cx = math_cos(k * p.x), sy = math_sin(k * p.y), cy = math_cos(k * p.y);
    double sz = math_sin(k * p.z), cz = math_cos(k * p.z);
    if (gradient)
        *gradient = v3(k * (cx * cy - sz * sx), k * (cy * cz - sx * sy), k * (cz * cx - sy * sz));
    return sx * cy + sy * cz + sz * cx;
}

static double gyroid_value(void *user, lam_vec3 p)
{
    (void)user;
    double b = v3_length(p) - GYROID_REACH;
    if (b > GYROID_RIM) // far outside, only the sign matters
        return b;
    double g = gyroid_terms(p, NULL);
    double a = (g * g - GYROID_WALL * GYROID_WALL) * GYROID_SCALE;
    return 0.5 * (a + b + math_sqrt((a - b) * (a - b) + GYROID_RIM * GYROID_RIM));
}

static lam_vec3 gyroid_gradient(void *user, lam_vec3 p)
{
    (void)user;
    lam_vec3 dg;
    double g = gyroid_terms(p, &dg);
    double a = (g * g - GYROID_WALL * GYROID_WALL) * GYROID_SCALE, b = v3_length(p) - GYROID_REACH;
    lam_vec3 da = v3_scale(dg, 2 * g * GYROID_SCALE), db = v3_unit(p);
    double share = (a - b) / math_sqrt((a - b) * (a - b) + GYROID_RIM * GYROID_RIM);
    return v3_scale(v3_add(v3_scale(da, 1 + share), v3_scale(db, 1 - share)), 0.5);
}

// Metaballs: f = level − Σ (1 − d²/R²)³ over the balls whose distance d is less than their radius of influence R.
static const struct ball {
    double x, y, z, reach;
} balls[] = {
    {0.000, -0.169, 0.000, 1.075}, {0.527, 0.274, 0.148, 0.801},    {-0.485, 0.316, 0.211, 0.738},
    {0.084, 0.590, -0.358, 0.696}, {-0.401, -0.548, -0.253, 0.653}, {0.464, -0.506, 0.316, 0.675},
};
#define BALLS_LEVEL 0.28

static double balls_value(void *user, lam_vec3 p)
{
    (void)user;
    double f = BALLS_LEVEL;
    for (size_t i = 0; i < sizeof balls / sizeof *balls; i++) {
        lam_vec3 d = v3(p.x - balls[i].x, p.y - balls[i].y, p.z - balls[i].z);
        double w = 1 - v3_dot(d, d) / (balls[i].reach * balls[i].reach);
        f -= w > 0 ? w * w * w : 0;
    }
    return f;
}

static lam_vec3 balls_gradient(void *user, lam_vec3 p)
{
    (void)user;
    lam_vec3 sum = v3(0, 0, 0);
    for (size_t i = 0; i < sizeof balls / sizeof *balls; i++) {
        lam_vec3 d = v3(p.x - balls[i].x, p.y - balls[i].y, p.z - balls[i].z);
        double square = balls[i].reach * balls[i].reach, w = 1 - v3_dot(d, d) / square;
        if (w > 0)
            sum = v3_add(sum, v3_scale(d, 6 * w * w / square));
    }
    return sum;
}

// --- Builders

// Returns a surface of `n->slices` segments around the axis and `stacks` segments along it. u and v count segments.
static lam_parametric round_surface(lam_surface_fn *surface, struct segments *n, int stacks)
{
    return (lam_parametric){.surface = surface,
                            .user = n,
                            .u_max = n->slices,
                            .v_max = stacks,
                            .u_segments = (int)n->slices,
                            .v_segments = stacks,
                            .u_closed = true};
}

static bool build_round(const struct shape_request *request, lam_surface_fn *surface, int slices, int stacks,
                        bool v_closed, lam_mesh *mesh)
{
    slices = request->slices ? request->slices : slices;
    stacks = request->stacks ? request->stacks : stacks;
    int min = v_closed ? 3 : 2; // fewer segments enclose no volume
    if (stacks < min)
        return fail(request->error, LAM_BAD_ARGUMENT, "shape: stacks is %d, expected at least %d for this shape",
                    stacks, min);
    struct segments n = {slices, stacks};
    lam_parametric one = round_surface(surface, &n, stacks);
    one.v_closed = v_closed;
    return tessellate_parametric(&one, 1, request, mesh);
}

// With 192 segments, the outline at 1024 pixels deviates from the circle by less than a sixteenth of a pixel.
static bool sphere_build(const struct shape_request *request, lam_mesh *mesh)
{
    return build_round(request, sphere_point, 192, 96, false, mesh);
}

static bool torus_build(const struct shape_request *request, lam_mesh *mesh)
{
    return build_round(request, torus_point, 192, 96, true, mesh);
}

static bool knot_build(const struct shape_request *request, lam_mesh *mesh)
{
    return build_round(request, knot_point, 384, 64, true, mesh);
}

static lam_parametric square_surface(struct square *square, int slices, int stacks)
{
    return (lam_parametric){.surface = square_point,
                            .user = square,
                            .u_min = -1,
                            .u_max = 1,
                            .v_min = -1,
                            .v_max = 1,
                            .u_segments = slices,
                            .v_segments = stacks};
}

static bool plane_build(const struct shape_request *request, lam_mesh *mesh)
{
    struct square ground = {v3(0, 0, 0), v3(1, 0, 0), v3(0, 0, -1)};
    int slices = request->slices ? request->slices : 1, stacks = request->stacks ? request->stacks : 1;
    lam_parametric one = square_surface(&ground, slices, stacks);
    return tessellate_parametric(&one, 1, request, mesh);
}

// Builds six faces with upright textures. Edges along X and Z have `slices` segments, and edges along Y have `stacks`
// segments.
static bool cube_build(const struct shape_request *request, lam_mesh *mesh)
{
    struct square faces[6] = {
        {v3(0, 0, 1), v3(1, 0, 0), v3(0, 1, 0)},   {v3(1, 0, 0), v3(0, 0, -1), v3(0, 1, 0)},
        {v3(0, 0, -1), v3(-1, 0, 0), v3(0, 1, 0)}, {v3(-1, 0, 0), v3(0, 0, 1), v3(0, 1, 0)},
        {v3(0, 1, 0), v3(1, 0, 0), v3(0, 0, -1)},  {v3(0, -1, 0), v3(1, 0, 0), v3(0, 0, 1)},
    };
    int slices = request->slices ? request->slices : 1, stacks = request->stacks ? request->stacks : 1;
    lam_parametric surfaces[6];
    for (int i = 0; i < 6; i++)
        surfaces[i] = square_surface(&faces[i], slices, i < 4 ? stacks : slices);
    return tessellate_parametric(surfaces, 6, request, mesh);
}

static bool build_revolved(const struct shape_request *request, lam_surface_fn *side, bool has_top, lam_mesh *mesh)
{
    int slices = request->slices ? request->slices : 192, stacks = request->stacks ? request->stacks : 1;
    struct segments n = {slices, stacks};
    lam_parametric surfaces[3] = {round_surface(side, &n, stacks), round_surface(bottom_disc, &n, 1),
                                  round_surface(top_disc, &n, 1)};
    return tessellate_parametric(surfaces, has_top ? 3 : 2, request, mesh);
}

static bool cylinder_build(const struct shape_request *request, lam_mesh *mesh)
{
    return build_revolved(request, cylinder_side, true, mesh);
}

static bool cone_build(const struct shape_request *request, lam_mesh *mesh)
{
    return build_revolved(request, cone_side, false, mesh);
}

// Implicit shapes have `slices` cells along the longest side.
static bool build_implicit(const struct shape_request *request, double (*value)(void *, lam_vec3),
                           lam_vec3 (*gradient)(void *, lam_vec3), int cells, lam_mesh *mesh)
{
    if (request->slices > 1024)
        return fail(request->error, LAM_BAD_ARGUMENT,
                    "shape: slices is %d, expected at most 1024 for an implicit surface", request->slices);
    // The box is slightly larger than the surface. The surface is therefore not clipped, and its symmetric points do
    // not fall on the lattice.
    const double side = 1.03;
    lam_implicit one = {.value = value,
                        .gradient = gradient,
                        .minimum = v3(-side, -side, -side),
                        .maximum = v3(side, side, side),
                        .cells = request->slices ? request->slices : cells};
    return tessellate_implicit(&one, request->arena, request->call, mesh, request->error);
}

static bool gyroid_build(const struct shape_request *request, lam_mesh *mesh)
{
    return build_implicit(request, gyroid_value, gyroid_gradient, 100, mesh);
}

static bool metaballs_build(const struct shape_request *request, lam_mesh *mesh)
{
    return build_implicit(request, balls_value, balls_gradient, 96, mesh);
}

// --- The table

static const struct shape {
    const char *name, *summary;
    bool (*build)(const struct shape_request *request, lam_mesh *mesh);
} shapes[] = {
    {"sphere", "a sphere: slices around it, stacks from pole to pole", sphere_build},
    {"torus", "a ring: radius 0.7 to the middle of a tube of radius 0.3", torus_build},
    {"plane", "a horizontal square of side 2, facing up", plane_build},
    {"cube", "a cube of side 2", cube_build},
    {"cylinder", "an upright cylinder of radius 1 and height 2, closed by two discs", cylinder_build},
    {"cone", "an upright cone of radius 1 and height 2, closed by a disc", cone_build},
    {"teapot",
     "the Utah teapot: 32 bicubic Bézier patches; slices around the body (a multiple of 4), stacks along each patch",
     teapot_build},
    {"torus-knot", "a trefoil: a tube that winds twice around and three times through a ring", knot_build},
    {"gyroid", "a ball cut from a gyroid's wall, an implicit surface; slices counts cells", gyroid_build},
    {"metaballs", "six balls that run together, an implicit surface; slices counts cells", metaballs_build},
};

enum { SHAPES = sizeof shapes / sizeof *shapes };

int lam_shape_count(void) { return SHAPES; }

const char *lam_shape_name(int shape) { return shape >= 0 && shape < SHAPES ? shapes[shape].name : NULL; }

const char *lam_shape_summary(int shape) { return shape >= 0 && shape < SHAPES ? shapes[shape].summary : NULL; }

int lam_shape_find(const char *name)
{
    for (int i = 0; name && i < SHAPES; i++)
        if (strcmp(shapes[i].name, name) == 0)
            return i;
    return -1;
}

// --- Adding to a scene

// If `made` is true, adds a mesh whose arrays are in the scene's arena. Returns the mesh's index, or −1 on failure.
static int add_mesh(struct lam_scene *scene, bool made, const lam_mesh *mesh, lam_error *error)
{
    int index = made ? scene_adopt_mesh(scene, mesh, error) : -1;
    if (index >= 0 && !scene_measure(scene, NULL, error)) {
        scene->meshes.count--;
        return -1;
    }
    return index;
}

// Between begin and end, allocations from the scene's arena count towards the limits of the call.
static uint64_t begin(struct lam_scene *scene, struct call_control *call, const lam_control *control)
{
    call_start(call, control);
    scene->arena.call = call;
    return float_state_enter();
}

static int end(struct lam_scene *scene, uint64_t state, int index)
{
    float_state_leave(state);
    scene->arena.call = NULL;
    return index;
}

static void scale_mesh(lam_mesh *mesh, double radius)
{
    float *positions = (float *)(uintptr_t)mesh->positions; // the array is in the arena, so it is writable
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++)
        positions[i] = (float)((double)positions[i] * radius);
}

static bool check_params(const char *name, const lam_shape_params *params, lam_error *error)
{
    if (!check_reserved("lam_shape_params", params, error))
        return false;
    if (!(params->radius >= 0) || params->radius > 1e30)
        return fail(error, LAM_BAD_ARGUMENT, "shape '%s': radius is %g, expected more than 0 and at most 1e30 (0: 1)",
                    name, params->radius);
    if (params->threads < 0 || params->threads > 1024)
        return fail(error, LAM_BAD_ARGUMENT, "shape '%s': threads is %d, expected 1 to 1024 (0: one each processor)",
                    name, params->threads);
    if (params->slices != 0 && (params->slices < 3 || params->slices > 16384))
        return fail(error, LAM_BAD_ARGUMENT, "shape '%s': slices is %d, expected 3 to 16384 (0: its own)", name,
                    params->slices);
    if (params->stacks < 0 || params->stacks > 16384)
        return fail(error, LAM_BAD_ARGUMENT, "shape '%s': stacks is %d, expected 1 to 16384 (0: its own)", name,
                    params->stacks);
    return true;
}

static bool fail_unknown_shape(const char *name, lam_error *error)
{
    const char *names[SHAPES];
    for (int i = 0; i < SHAPES; i++)
        names[i] = shapes[i].name;
    const char *nearest = meant_word(name, names, SHAPES);
    return fail(error, LAM_BAD_ARGUMENT, "no shape is named '%s'%s%s%s", name, nearest ? ", the nearest name is '" : "",
                nearest ? nearest : "", nearest ? "'" : "");
}

int scene_add_shape(struct lam_scene *scene, const char *shape, const lam_shape_params *params,
                    struct call_control *call, lam_error *error)
{
    const lam_shape_params plain = {0};
    params = params ? params : &plain;
    int row = lam_shape_find(shape);
    if (row < 0)
        return fail_unknown_shape(shape, error), -1;
    if (!check_params(shape, params, error))
        return -1;
    struct shape_request request = {params->slices, params->stacks, &scene->arena, call, error, params->threads};
    lam_mesh mesh = {0};
    bool made = shapes[row].build(&request, &mesh);
    if (made && params->radius > 0)
        scale_mesh(&mesh, params->radius);
    mesh.name = shapes[row].name;
    struct scene_origin origin = {
        .shape = shapes[row].name,
        .segments = {.radius = params->radius, .slices = params->slices, .stacks = params->stacks},
        .first_mesh = scene->meshes.count,
        .first_material = scene->materials.count};
    int index = add_mesh(scene, made, &mesh, error);
    if (index < 0 || scene_note_origin(scene, origin, scene->objects.count, error))
        return index;
    scene->meshes.count--;
    scene->extents.count--;
    return -1;
}

int lam_scene_add_shape(lam_scene *scene, const char *shape, const lam_shape_params *params, lam_error *error)
{
    if (!scene || !shape)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_shape: %s is NULL", scene ? "shape" : "scene"), -1;
    struct call_control call;
    uint64_t state = begin(scene, &call, params ? params->control : NULL);
    return end(scene, state, scene_add_shape(scene, shape, params, &call, error));
}

int lam_scene_add_parametric(lam_scene *scene, const lam_parametric *surface, const lam_control *control,
                             lam_error *error)
{
    if (!scene || !surface)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_parametric: %s is NULL", scene ? "surface" : "scene"), -1;
    if (!check_reserved("lam_parametric", surface, error))
        return -1;
    struct call_control call;
    uint64_t state = begin(scene, &call, control);
    lam_mesh mesh = {0};
    const struct shape_request request = {.arena = &scene->arena, .call = &call, .error = error, .threads = 1};
    bool made = tessellate_parametric(surface, 1, &request, &mesh);
    return end(scene, state, add_mesh(scene, made, &mesh, error));
}

int lam_scene_add_implicit(lam_scene *scene, const lam_implicit *surface, const lam_control *control, lam_error *error)
{
    if (!scene || !surface)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_implicit: %s is NULL", scene ? "surface" : "scene"), -1;
    if (!check_reserved("lam_implicit", surface, error))
        return -1;
    struct call_control call;
    uint64_t state = begin(scene, &call, control);
    lam_mesh mesh = {0};
    bool made = tessellate_implicit(surface, &scene->arena, &call, &mesh, error);
    return end(scene, state, add_mesh(scene, made, &mesh, error));
}

// Copies a formula to the scene's arena. Returns NULL if memory runs out.
static const lam_formula *copy_formula(struct lam_scene *scene, const lam_formula *formula)
{
    lam_formula *copy = arena_alloc_zeroed(&scene->arena, sizeof *copy);
    if (!copy)
        return NULL;
    *copy = *formula;
    copy->text = arena_string(&scene->arena, formula->text);
    const char *const from[] = {formula->u, formula->v, formula->x, formula->y, formula->z};
    const char **const to[] = {&copy->u, &copy->v, &copy->x, &copy->y, &copy->z};
    bool copied = copy->text;
    for (int i = 0; i < 5; i++) {
        *to[i] = from[i] ? arena_string(&scene->arena, from[i]) : NULL;
        copied &= !*to[i] == !from[i];
    }
    return copied ? copy : NULL;
}

int scene_add_formula(struct lam_scene *scene, const lam_formula *formula, struct call_control *call, lam_error *error)
{
    lam_mesh mesh = {0};
    bool made = formula->implicit ? tessellate_implicit_formula(formula, &scene->arena, call, &mesh, error)
                                  : tessellate_formula(formula, &scene->arena, call, &mesh, error);
    struct scene_origin origin = {.first_mesh = scene->meshes.count, .first_material = scene->materials.count};
    if (made && !(origin.formula = copy_formula(scene, formula)))
        return call_memory_error(call, strlen(formula->text), error), -1;
    int index = add_mesh(scene, made, &mesh, error);
    return index < 0 || scene_note_origin(scene, origin, scene->objects.count, error) ? index : -1;
}

int lam_scene_add_formula(lam_scene *scene, const lam_formula *formula, const lam_control *control, lam_error *error)
{
    if (!scene || !formula || !formula->text) {
        fail(error, LAM_BAD_ARGUMENT, "lam_scene_add_formula: %s is NULL",
             !scene     ? "scene"
             : !formula ? "formula"
                        : "text");
        return -1;
    }
    if (!check_reserved("lam_formula", formula, error))
        return -1;
    struct call_control call;
    uint64_t state = begin(scene, &call, control);
    return end(scene, state, scene_add_formula(scene, formula, &call, error));
}
