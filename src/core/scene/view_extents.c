// view_extents.c: extents of a scene's vertices along the axes of a view.
//
// The tree of boxes does not affect the result. The tree only skips vertices that cannot change the extents. All other
// vertices are measured with the same operations.
#include "view_extents.h"

#include "linear.h"
#include "scene_internal.h"

// The state of the search in one mesh, for the directions [first, end). A component of a vertex in the axes of the view
// is row · position + shift.
struct search {
    const lam_mesh *mesh;
    const struct scene_extent *extent;
    struct view_extents *extents;
    int first, end;
    lam_vec3 row[3];
    double shift[3];
    // Upper bounds: axis · position + offset, where offset includes the rounding error; axis_size is |axis|.
    lam_vec3 axis[EXTENT_DIRECTIONS], axis_size[EXTENT_DIRECTIONS];
    double offset[EXTENT_DIRECTIONS];
};

static double absolute(double a) { return a < 0 ? -a : a; }

// Computes the directions along which the extents are measured, in the axes of the view.
static void set_across(const struct view_extents *extents, lam_vec3 across[EXTENT_DIRECTIONS])
{
    across[EXTENT_RIGHT] = v3(1, 0, extents->kx);
    across[EXTENT_LEFT] = v3(-1, 0, extents->kx);
    across[EXTENT_TOP] = v3(0, 1, extents->ky);
    across[EXTENT_BOTTOM] = v3(0, -1, extents->ky);
    across[EXTENT_FRONT] = v3(0, 0, 1);
}

static void set_directions(struct search *s)
{
    lam_vec3 across[EXTENT_DIRECTIONS];
    set_across(s->extents, across);
    box_of_six box; // relative to the mesh's origin, like the positions
    box_tree_whole(&s->extent->boxes, box);
    double far[3]; // upper bounds of |coordinate|
    for (int a = 0; a < 3; a++)
        far[a] = absolute((double)box[a]) + absolute((double)box[a + 3]);
    for (int d = s->first; d < s->end; d++) {
        const double f[3] = {across[d].x, across[d].y, across[d].z};
        double steps = 0; // upper bound of the sum of the absolute values of all terms
        s->offset[d] = f[0] * s->shift[0] + f[1] * s->shift[1] + f[2] * s->shift[2];
        double sum[3] = {0};
        for (int i = 0; i < 3; i++) {
            const double row[3] = {s->row[i].x, s->row[i].y, s->row[i].z};
            steps += absolute(f[i] * s->shift[i]);
            for (int a = 0; a < 3; a++) {
                sum[a] += f[i] * row[a];
                steps += absolute(f[i] * row[a]) * far[a];
            }
        }
        s->axis[d] = v3(sum[0], sum[1], sum[2]);
        s->axis_size[d] = v3(absolute(sum[0]), absolute(sum[1]), absolute(sum[2]));
        // There are fewer than 64 operations, each with a relative error below 2⁻⁵².
        s->offset[d] += steps * 0x1p-46;
    }
}

static void extend(const struct search *s, lam_vec3 q)
{
    struct view_extents *extents = s->extents;
    const double kx = extents->kx, ky = extents->ky;
    double x = v3_dot(s->row[0], q) + s->shift[0], y = v3_dot(s->row[1], q) + s->shift[1],
           z = v3_dot(s->row[2], q) + s->shift[2];
    const double value[EXTENT_DIRECTIONS] = {x + kx * z, -x + kx * z, y + ky * z, -y + ky * z, z};
    for (int d = s->first; d < s->end; d++)
        if (value[d] > extents->value[d]) {
            extents->value[d] = value[d];
            extents->point[d] = v3(x, y, z);
        }
}

// Searches the vertices of a block. Most vertices are skipped because of an upper bound, which is cheaper to compute
// than their extents.
static void search_block(const struct search *s, size_t block, int d)
{
    const struct aabb_tree *tree = &s->extent->boxes;
    size_t first = block * tree->block, end = box_end(first, tree->block, tree->vertices);
    const lam_vec3 axis = s->axis[d];
    const double offset = s->offset[d];
    for (size_t v = first; v < end; v++) {
        const float *p = s->mesh->positions + 3 * (size_t)(s->extent->used ? s->extent->used[v] : v);
        lam_vec3 q = v3((double)p[0], (double)p[1], (double)p[2]);
        if (v3_dot(axis, q) + offset > s->extents->value[d])
            extend(s, q);
    }
}

// Returns the upper bound for the vertices of a box: the value at the centre of the box plus the half extents along the
// direction.
static double bound_of(const struct search *s, const box_of_six box, int d)
{
    lam_vec3 low = v3((double)box[0], (double)box[1], (double)box[2]);
    lam_vec3 high = v3((double)box[3], (double)box[4], (double)box[5]);
    lam_vec3 middle = v3_scale(v3_add(low, high), 0.5), half = v3_scale(v3_sub(high, low), 0.5);
    return v3_dot(s->axis[d], middle) + v3_dot(s->axis_size[d], half) + s->offset[d];
}

// Descends to the box with the largest bound and searches this box first, because the extents found in this box exclude
// most other boxes.
static void search_best_block(const struct search *s, int d)
{
    const struct aabb_tree *tree = &s->extent->boxes;
    size_t first = 0, best = 0;
    for (int level = tree->levels - 1; level >= 0; level--, first = best * BOX_CHILDREN) {
        const box_of_six *boxes = boxes_of_level(tree, level);
        size_t end = box_end(first, BOX_CHILDREN, tree->count[level]);
        double best_bound = -1e308;
        best = first;
        for (size_t i = first; i < end; i++) {
            double bound = bound_of(s, boxes[i], d);
            if (bound > best_bound) {
                best_bound = bound;
                best = i;
            }
        }
    }
    search_block(s, best, d);
}

static void search_level(const struct search *s, int level, size_t first)
{
    const struct aabb_tree *tree = &s->extent->boxes;
    const box_of_six *boxes = boxes_of_level(tree, level);
    size_t end = box_end(first, BOX_CHILDREN, tree->count[level]);
    for (size_t i = first; i < end; i++)
        for (int d = s->first; d < s->end; d++) {
            if (!(bound_of(s, boxes[i], d) > s->extents->value[d]))
                continue;
            if (level == 0) {
                search_block(s, i, d);
            } else {
                search_level(s, level - 1, i * BOX_CHILDREN);
                break;
            }
        }
}

static void search_object(const lam_scene *scene, const lam_object *object, const struct view_axes *axes,
                          struct view_extents *extents, int first, int end)
{
    struct search s = {.mesh = scene_mesh(scene, object->mesh),
                       .extent = scene_extent(scene, object->mesh),
                       .extents = extents,
                       .first = first,
                       .end = end};
    if (!s.extent->used_count)
        return;
    // The view axes are multiplied by the transform once, so that each vertex needs three dot products.
    const lam_mat4 *t = &object->transform;
    lam_vec3 rows[3] = {axes->right, axes->above, axes->back};
    lam_vec3 origin = mat4_point(t, v3(s.mesh->origin[0], s.mesh->origin[1], s.mesh->origin[2]));
    for (int i = 0; i < 3; i++) {
        s.row[i] = v3(t->m[0][0] * rows[i].x + t->m[1][0] * rows[i].y + t->m[2][0] * rows[i].z,
                      t->m[0][1] * rows[i].x + t->m[1][1] * rows[i].y + t->m[2][1] * rows[i].z,
                      t->m[0][2] * rows[i].x + t->m[1][2] * rows[i].y + t->m[2][2] * rows[i].z);
        s.shift[i] = v3_dot(rows[i], v3_sub(origin, axes->centre));
    }
    set_directions(&s);
    for (int d = first; d < end; d++)
        search_best_block(&s, d);
    search_level(&s, s.extent->boxes.levels - 1, 0);
}

// Sets the extents of a direction to the extents of a ball around the centre.
static void find_ball(double radius, struct view_extents *extents, int d)
{
    lam_vec3 direction[EXTENT_DIRECTIONS];
    set_across(extents, direction);
    extents->value[d] = radius * v3_length(direction[d]);
    extents->point[d] = v3_scale(v3_unit(direction[d]), radius);
}

static void search(const struct view_points *points, struct view_extents *extents, int first, int end)
{
    for (int d = first; d < end; d++) {
        extents->value[d] = -1e308;
        if (points->ball_radius > 0)
            find_ball(points->ball_radius, extents, d);
    }
    // The extents found for one set of axes exclude most vertices for the next set.
    for (int a = 0; a < points->axes_count && !(points->ball_radius > 0); a++)
        for (int i = 0; i < points->scene->objects.count; i++)
            if (scene_shows(points->scene, i))
                search_object(points->scene, scene_object(points->scene, i), &points->axes[a], extents, first, end);
}

bool view_extents_centre(const lam_scene *scene, lam_vec3 *centre)
{
    *centre = v3(0, 0, 0);
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        const lam_object *object = scene_object(scene, i);
        const struct scene_extent *extent = scene_extent(scene, object->mesh);
        if (!extent->used_count || !scene_shows(scene, i))
            continue;
        lam_vec3 half = v3_scale(v3_sub(extent->maximum, extent->minimum), 0.5);
        *centre = mat4_point(&object->transform, v3_add(extent->minimum, half));
        return true;
    }
    return false;
}

void view_extents_find(const struct view_points *points, struct view_extents *extents)
{
    search(points, extents, 0, EXTENT_DIRECTIONS);
}

void view_extents_horizontal(const struct view_points *points, double kx, struct view_extents *extents)
{
    extents->kx = kx;
    search(points, extents, EXTENT_RIGHT, EXTENT_LEFT + 1);
}

void view_extents_vertical(const struct view_points *points, double ky, struct view_extents *extents)
{
    extents->ky = ky;
    search(points, extents, EXTENT_TOP, EXTENT_BOTTOM + 1);
}

bool view_extents_depth(const lam_scene *scene, const lam_mat4 *view, double *nearest, double *farthest)
{
    lam_vec3 centre;
    if (!view_extents_centre(scene, &centre))
        return false;
    double from_centre[2], depth = -mat4_point(view, centre).z;
    for (int away = 0; away < 2; away++) {
        struct view_axes axes = {.centre = centre};
        axes.back = v3_scale(v3(view->m[2][0], view->m[2][1], view->m[2][2]), away ? -1 : 1);
        struct view_extents extents = {0};
        search(&(struct view_points){.scene = scene, .axes = &axes, .axes_count = 1}, &extents, EXTENT_FRONT,
               EXTENT_DIRECTIONS);
        from_centre[away] = extents.value[EXTENT_FRONT];
    }
    *nearest = depth - from_centre[0];
    *farthest = depth + from_centre[1];
    return true;
}
