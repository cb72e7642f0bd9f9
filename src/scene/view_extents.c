// view_extents.c: how far a scene's vertices reach in the axes of a view.
//
// The values themselves are worked out vertex by vertex, always by the same operations; boxes only tell which
// vertices cannot matter.
#include "view_extents.h"

#include "linear.h"
#include "scene_internal.h"

// One mesh in the axes of the view: x, y and z of a vertex are row · position + shift. Looked for are the
// directions from `first` to before `end`.
struct search {
    const lam_mesh *mesh;
    const struct scene_extent *extent;
    struct reach *reach;
    int first, end;
    lam_vec3 row[3];
    double shift[3];
    // The values of a reach, each as axis · position + offset, and how far rounding may move them.
    lam_vec3 axis[REACH_DIRECTIONS], axis_size[REACH_DIRECTIONS];
    double offset[REACH_DIRECTIONS];
};

static double size_of(double a) { return a < 0 ? -a : a; }

static void set_directions(struct search *s)
{
    const double across[REACH_DIRECTIONS][3] = {
        {1, 0, s->reach->kx}, {-1, 0, s->reach->kx}, {0, 1, s->reach->ky}, {0, -1, s->reach->ky}, {0, 0, 1}};
    const double *o = s->mesh->origin;
    lam_vec3 low = s->extent->minimum, high = s->extent->maximum;
    // The farthest coordinates, origin taken out again: a little more than they are.
    double far[3] = {(size_of(low.x) + size_of(high.x) + 2 * size_of(o[0])),
                     (size_of(low.y) + size_of(high.y) + 2 * size_of(o[1])),
                     (size_of(low.z) + size_of(high.z) + 2 * size_of(o[2]))};
    for (int d = s->first; d < s->end; d++) {
        const double *f = across[d];
        double steps = 0; // the sum of the sizes of all terms
        s->offset[d] = f[0] * s->shift[0] + f[1] * s->shift[1] + f[2] * s->shift[2];
        double sum[3] = {0};
        for (int i = 0; i < 3; i++) {
            const double row[3] = {s->row[i].x, s->row[i].y, s->row[i].z};
            steps += size_of(f[i] * s->shift[i]);
            for (int a = 0; a < 3; a++) {
                sum[a] += f[i] * row[a];
                steps += size_of(f[i] * row[a]) * far[a];
            }
        }
        s->axis[d] = v3(sum[0], sum[1], sum[2]);
        s->axis_size[d] = v3(size_of(sum[0]), size_of(sum[1]), size_of(sum[2]));
        // Fewer than 64 operations, each wrong by less than 2⁻⁵² of that sum.
        s->offset[d] += steps * 0x1p-46;
    }
}

static void reach_for(const struct search *s, lam_vec3 q)
{
    struct reach *reach = s->reach;
    const double kx = reach->kx, ky = reach->ky;
    double x = v3_dot(s->row[0], q) + s->shift[0], y = v3_dot(s->row[1], q) + s->shift[1],
           z = v3_dot(s->row[2], q) + s->shift[2];
    const double value[REACH_DIRECTIONS] = {x + kx * z, -x + kx * z, y + ky * z, -y + ky * z, z};
    for (int d = s->first; d < s->end; d++)
        reach->value[d] = value[d] > reach->value[d] ? value[d] : reach->value[d];
}

// Most vertices are told by their limit, which takes fewer operations than their values.
static void look_into(const struct search *s, size_t block, int d)
{
    const struct aabb_tree *tree = &s->extent->boxes;
    size_t first = block * tree->block, end = box_end(first, tree->block, tree->vertices);
    const lam_vec3 axis = s->axis[d];
    const double offset = s->offset[d];
    for (size_t v = first; v < end; v++) {
        const float *p = s->mesh->positions + 3 * (size_t)(s->extent->used ? s->extent->used[v] : v);
        lam_vec3 q = v3((double)p[0], (double)p[1], (double)p[2]);
        if (v3_dot(axis, q) + offset > s->reach->value[d])
            reach_for(s, q);
    }
}

// What no vertex of a box reaches beyond: the box's middle, and its half sides along the direction.
static double limit_of(const struct search *s, const box_of_six box, int d)
{
    lam_vec3 low = v3((double)box[0], (double)box[1], (double)box[2]);
    lam_vec3 high = v3((double)box[3], (double)box[4], (double)box[5]);
    lam_vec3 middle = v3_scale(v3_add(low, high), 0.5), half = v3_scale(v3_sub(high, low), 0.5);
    return v3_dot(s->axis[d], middle) + v3_dot(s->axis_size[d], half) + s->offset[d];
}

// From the topmost level down to the box that promises most: with what is found there, most others cannot matter.
static void look_at_most_promising(const struct search *s, int d)
{
    const struct aabb_tree *tree = &s->extent->boxes;
    size_t first = 0, best = 0;
    for (int level = tree->levels - 1; level >= 0; level--, first = best * BOX_CHILDREN) {
        const box_of_six *boxes = boxes_of_level(tree, level);
        size_t end = box_end(first, BOX_CHILDREN, tree->count[level]);
        double most = -1e308;
        best = first;
        for (size_t i = first; i < end; i++) {
            double limit = limit_of(s, boxes[i], d);
            if (limit > most) {
                most = limit;
                best = i;
            }
        }
    }
    look_into(s, best, d);
}

static void look_at_level(const struct search *s, int level, size_t first)
{
    const struct aabb_tree *tree = &s->extent->boxes;
    const box_of_six *boxes = boxes_of_level(tree, level);
    size_t end = box_end(first, BOX_CHILDREN, tree->count[level]);
    for (size_t i = first; i < end; i++)
        for (int d = s->first; d < s->end; d++) {
            if (!(limit_of(s, boxes[i], d) > s->reach->value[d]))
                continue;
            if (level == 0) {
                look_into(s, i, d);
            } else {
                look_at_level(s, level - 1, i * BOX_CHILDREN);
                break;
            }
        }
}

static void search_object(const lam_scene *scene, const lam_object *object, const struct view_axes *axes,
                          struct reach *reach, int first, int end)
{
    struct search s = {.mesh = scene_mesh(scene, object->mesh),
                       .extent = scene_extent(scene, object->mesh),
                       .reach = reach,
                       .first = first,
                       .end = end};
    if (!s.extent->used_count)
        return;
    // View axes times the transform, so that each vertex costs three dot products.
    const lam_mat4 *t = &object->transform;
    lam_vec3 rows[3] = {axes->right, axes->above, axes->back};
    lam_vec3 origin = mat4_point(t, v3(s.mesh->origin[0], s.mesh->origin[1], s.mesh->origin[2]));
    for (int i = 0; i < 3; i++) {
        s.row[i] = v3(t->m[0][0] * rows[i].x + t->m[1][0] * rows[i].y + t->m[2][0] * rows[i].z,
                      t->m[0][1] * rows[i].x + t->m[1][1] * rows[i].y + t->m[2][1] * rows[i].z,
                      t->m[0][2] * rows[i].x + t->m[1][2] * rows[i].y + t->m[2][2] * rows[i].z);
        s.shift[i] = v3_dot(rows[i], origin);
    }
    set_directions(&s);
    for (int d = first; d < end; d++)
        look_at_most_promising(&s, d);
    look_at_level(&s, s.extent->boxes.levels - 1, 0);
}

static void search(const lam_scene *scene, const struct view_axes *axes, struct reach *reach, int first, int end)
{
    for (int d = first; d < end; d++)
        reach->value[d] = -1e308;
    for (int i = 0; i < scene->objects.count; i++)
        search_object(scene, scene_object(scene, i), axes, reach, first, end);
}

void view_extents_find(const lam_scene *scene, const struct view_axes *axes, struct reach *reach)
{
    search(scene, axes, reach, 0, REACH_DIRECTIONS);
}

void reach_across(const lam_scene *scene, const struct view_axes *axes, double kx, struct reach *reach)
{
    reach->kx = kx;
    search(scene, axes, reach, REACH_RIGHT, REACH_LEFT + 1);
}

void reach_upwards(const lam_scene *scene, const struct view_axes *axes, double ky, struct reach *reach)
{
    reach->ky = ky;
    search(scene, axes, reach, REACH_TOP, REACH_BOTTOM + 1);
}
