// up_guess.c: guesses the up axis of a model whose format defines none, if the shape is unambiguous.
#include "up_guess.h"

#include "linear.h"

// A model is a terrain if it is thinner along z than THIN times its smaller side in x and y, and if its area, projected
// along z, is more than FACING times its whole area. (Area that faces −z counts as negative.)
#define THIN     0.3
#define NOT_FLAT 0.01 // thinner models are flat pictures, which usually stand upright
#define FACING   0.6
#define EVEN     0.999 // if the projected part of the area is larger, the model has no slopes (stacked cards)

// A model with fewer different planes per point of the lattice may be an upright sheet.
#define DETAIL 0.05

static bool is_terrain_on_z(const struct lam_scene *scene, struct pool *pool)
{
    lam_vec3 low, high;
    if (!lam_scene_bounds(scene, &low, &high))
        return false;
    double x = high.x - low.x, y = high.y - low.y, z = high.z - low.z, smaller = x < y ? x : y;
    if (!(z > NOT_FLAT * smaller && z < THIN * smaller))
        return false;
    const struct surface_facts facts = surface_facts(scene, pool);
    return facts.detail > DETAIL && facts.facing.z > FACING && facts.facing.z < EVEN;
}

// A model stands on an axis if the middle of its box is above the polygon around its lowest points, and if that polygon
// is not narrow. (Feet, wheels and bases form such polygons; the back of a lying figure does not.)
#define LOWEST 0.03 // of the height: the lowest points
#define NARROW 0.3  // of the box's smaller side: a narrower polygon does not carry a model
#define CLEAR  0.4  // the same, for an axis that overrides the usual one
#define TIPS   0.1  // of half the height: the distance of the middle from the polygon's edge, for such an axis
#define TALL   0.3  // of the box's larger side: lower models may as well lie as stand

enum { DIRECTIONS = 8 }; // half of the directions in which the polygon is measured; the others are opposite

static const double directions[DIRECTIONS][2] = {{1, 0},
                                                 {0.92387953251128674, 0.38268343236508977},
                                                 {0.70710678118654752, 0.70710678118654752},
                                                 {0.38268343236508977, 0.92387953251128674},
                                                 {0, 1},
                                                 {-0.38268343236508977, 0.92387953251128674},
                                                 {-0.70710678118654752, 0.70710678118654752},
                                                 {-0.92387953251128674, 0.38268343236508977}};

struct polygon {
    double least[DIRECTIONS], most[DIRECTIONS]; // the extent of the points in each direction
};

// Adds the points of a mesh that are among the lowest of the box along an axis.
static void add_lowest(struct polygon *polygon, const lam_mesh *mesh, const double low[3], const double high[3],
                       int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const float limit = (float)(low[axis] + LOWEST * (high[axis] - low[axis]) - mesh->origin[axis]);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * (size_t)i;
        if (!(p[axis] <= limit))
            continue;
        const double at[3] = {(double)p[0] + mesh->origin[0], (double)p[1] + mesh->origin[1],
                              (double)p[2] + mesh->origin[2]};
        bool inside = true; // vertices without a triangle are outside
        for (int k = 0; k < 3; k++)
            inside = inside && at[k] >= low[k] && at[k] <= high[k];
        for (int k = 0; inside && k < DIRECTIONS; k++) {
            const double along = at[a] * directions[k][0] + at[b] * directions[k][1];
            polygon->least[k] = along < polygon->least[k] ? along : polygon->least[k];
            polygon->most[k] = along > polygon->most[k] ? along : polygon->most[k];
        }
    }
}

// Returns whether the model stands on an axis, as wide and as stable as stated.
static bool stands(const struct lam_scene *scene, const double low[3], const double high[3], int axis, double wide,
                   double stable)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const double sides[] = {high[a] - low[a], high[b] - low[b]}, smaller = sides[sides[1] < sides[0]];
    struct polygon polygon;
    for (int k = 0; k < DIRECTIONS; k++)
        polygon.least[k] = 1e308, polygon.most[k] = -1e308;
    for (int i = 0; i < scene->objects.count; i++)
        add_lowest(&polygon, scene_mesh(scene, scene_object(scene, i)->mesh), low, high, axis);
    for (int k = 0; k < DIRECTIONS; k++) {
        const double middle = 0.5 * ((low[a] + high[a]) * directions[k][0] + (low[b] + high[b]) * directions[k][1]);
        const double edge = stable * 0.5 * (high[axis] - low[axis]);
        if (polygon.most[k] - polygon.least[k] < wide * smaller || polygon.most[k] - middle < edge ||
            middle - polygon.least[k] < edge)
            return false;
    }
    return true;
}

// Returns the axis that a lying model stands on, or the usual axis. 0 is x, 1 is y, 2 is z. An open surface that faces
// one side, such as a hilly landscape, is not turned.
static int standing_axis(const struct lam_scene *scene, int usual, struct pool *pool)
{
    lam_vec3 corners[2];
    if (!lam_scene_triangle_count(scene) || !lam_scene_bounds(scene, &corners[0], &corners[1]))
        return usual;
    const double low[] = {corners[0].x, corners[0].y, corners[0].z},
                 high[] = {corners[1].x, corners[1].y, corners[1].z};
    if (stands(scene, low, high, usual, NARROW, 0))
        return usual;
    int found = usual;
    for (int axis = 0; axis < 3; axis++) {
        const double height = high[axis] - low[axis];
        bool tall = true;
        for (int k = 0; k < 3; k++)
            tall = tall && height >= TALL * (high[k] - low[k]);
        if (axis == usual || !tall || !stands(scene, low, high, axis, CLEAR, TIPS))
            continue;
        if (found != usual)
            return usual;
        found = axis;
    }
    return found != usual && v3_length(surface_facts(scene, pool).facing) > FACING ? usual : found;
}

void guess_up(struct lam_scene *scene, const struct importer *importer, bool may_turn,
              const struct import_source *source)
{
    if (importer->up_is_habit && is_terrain_on_z(scene, source->pool)) {
        scene->up = LAM_UP_Z;
        scene_warn(scene,
                   "%s: z is assumed to be up, because the model is a terrain in the plane of x and y "
                   "(lam_load_params.up overrides this)",
                   source->name);
    } else if (importer->may_lie && may_turn) {
        scene->up = LAM_UP_X + standing_axis(scene, importer->up - LAM_UP_X, source->pool);
        if (scene->up != importer->up)
            scene_warn(
                scene,
                "%s: %s is assumed to be up, because the model stands on that axis; with %s up, as usual for this "
                "format, it would lie (lam_load_params.up overrides this)",
                source->name, lam_up_name(scene->up), lam_up_name(importer->up));
    }
}
