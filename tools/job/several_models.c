// several_models.c: places several models in one picture, in a row or in a grid.
#include "several_models.h"

// The gap between models, as a fraction of the largest.
#define GAP 0.15

static lam_vec3 up_vector(lam_up up)
{
    const double sign = up >= LAM_UP_NEGATIVE_X ? -1 : 1;
    const int axis = up == LAM_UP_AUTO ? 1 : (up - LAM_UP_X) % 3;
    return (lam_vec3){axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
}

static bool turn_up(lam_scene *scene, lam_up up, lam_error *error)
{
    const lam_vec3 a = up_vector(lam_scene_up(scene)), b = up_vector(up), origin = {0, 0, 0};
    const double cosine = a.x * b.x + a.y * b.y + a.z * b.z, pi = 3.14159265358979323846;
    lam_vec3 axis = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    if (cosine < 0)
        axis = (lam_vec3){a.y, a.z, a.x}; // any axis across
    return cosine > 0 || lam_scene_rotate(scene, origin, axis, cosine < 0 ? pi : 0.5 * pi, error);
}

// The box of a scene: right, up and back.
struct box {
    double low[3], high[3];
};

static struct box box_of(const lam_scene *scene, const int axes[3])
{
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    const double lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z};
    struct box box;
    for (int k = 0; k < 3; k++) {
        box.low[k] = lows[axes[k]];
        box.high[k] = highs[axes[k]];
    }
    return box;
}

static bool move_to(lam_scene *scene, const struct box *box, const int axes[3], double right, double back,
                    bool downwards, lam_error *error)
{
    lam_mat4 move = lam_mat4_identity();
    move.m[axes[0]][3] = right - box->low[0];
    move.m[axes[1]][3] = downwards ? -box->high[1] : -box->low[1]; // all stand on one plane
    move.m[axes[2]][3] = back - 0.5 * (box->low[2] + box->high[2]);
    return lam_scene_transform(scene, &move, error);
}

static bool place(lam_scene **scenes, int count, bool grid, lam_error *error)
{
    static const int all_axes[3][3] = {{1, 0, 2}, {0, 1, 2}, {0, 2, 1}}; // for x, y and z up
    const lam_up up = lam_scene_up(scenes[0]);
    const int *axes = all_axes[up == LAM_UP_AUTO ? 1 : (up - LAM_UP_X) % 3];
    const double backwards = axes[2] == 1 ? 1 : -1; // the front of a model with z up is at -y
    double widest = 0, deepest = 0, largest = 0, right = 0;
    int columns = grid ? 1 : count;
    while (columns * columns < count)
        columns++;
    for (int i = 0; i < count; i++) {
        const struct box box = box_of(scenes[i], axes);
        for (int k = 0; k < 3; k++)
            largest = box.high[k] - box.low[k] > largest ? box.high[k] - box.low[k] : largest;
        widest = box.high[0] - box.low[0] > widest ? box.high[0] - box.low[0] : widest;
        deepest = box.high[2] - box.low[2] > deepest ? box.high[2] - box.low[2] : deepest;
    }
    for (int i = 0; i < count; i++) {
        const struct box box = box_of(scenes[i], axes);
        const double width = box.high[0] - box.low[0], cell = widest + GAP * largest;
        const double at = grid ? i % columns * cell + 0.5 * (widest - width) : right;
        const double back = grid ? backwards * (i / columns) * (deepest + GAP * largest) : 0;
        if (!move_to(scenes[i], &box, axes, at, back, up >= LAM_UP_NEGATIVE_X, error))
            return false;
        right += width + GAP * largest;
    }
    return true;
}

lam_scene *several_models_join(lam_scene **scenes, int count, enum arrange arrange, lam_error *error)
{
    bool ok = true;
    for (int i = 1; ok && arrange != ARRANGE_AS_IS && i < count; i++)
        ok = turn_up(scenes[i], lam_scene_up(scenes[0]), error);
    ok = ok && (arrange == ARRANGE_AS_IS || place(scenes, count, arrange == ARRANGE_GRID, error));
    for (int i = 1; i < count; i++)
        if (ok)
            ok = lam_scene_add_scene(scenes[0], scenes[i], error);
        else
            lam_scene_free(scenes[i]);
    if (ok)
        return scenes[0];
    lam_scene_free(scenes[0]);
    return NULL;
}
