// up_guess.c: guesses the up axis of a model whose format defines none, if the shape is unambiguous.
#include "up_guess.h"

// A model is a terrain if it is thinner along z than THIN times its smaller side in x and y, and if its area, projected
// along z, is more than FACING times its whole area. (Area that faces −z counts as negative.)
#define THIN     0.3
#define NOT_FLAT 0.01 // thinner models are flat pictures, which usually stand upright
#define FACING   0.6
#define EVEN     0.999 // if the projected part of the area is larger, the model has no slopes (stacked cards)

// A model with fewer different planes per point of the lattice may be an upright sheet.
#define DETAIL 0.05

bool is_terrain_on_z(const struct lam_scene *scene, struct pool *pool)
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
