// frame_strokes.c: converts lines and points to polygons that face the eye (frame_strokes.h).
#include "frame_strokes.h"

#include "linear.h"
#include "srgb.h"

#include <string.h>

enum {
    LINE_CORNERS = 4,
    POINT_CORNERS_MAX = 16,
    UNFOLDED_BYTES = 6, // these bytes for lines and points count as a triangle, because more memory follows
};

// The arrays of one mesh's polygons, ordered by alignment; a member is NULL if the mesh lacks the attribute. Corners 0
// and 3 of a line are at its first end, 1 and 2 at the second.
struct stroke_arrays {
    lam_part *parts;
    float *positions, *normals, *tangents, *texcoords, *second_texcoords;
    void *colors;
    uint32_t *indices;
};

static size_t color_size(const lam_mesh *mesh) { return mesh->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4; }

static size_t corners_of(const lam_mesh *mesh, size_t point_corners)
{
    return mesh->line_count ? LINE_CORNERS : point_corners;
}

size_t stroke_triangles(const lam_mesh *mesh, size_t point_corners) { return corners_of(mesh, point_corners) - 2; }

// The size of a single point, as a fraction of the picture's smaller side. The size shrinks with the square root of the
// number of points.
#define POINT_SHARE 0.16
// The minimum size in pixels. For few points: another minimum in pixels, and the maximum as a fraction of the picture's
// smaller side.
#define POINT_LEAST 3.0
#define FEW_LEAST   8.0
#define FEW_MOST    0.025
enum { FEW = 100 };
// The minimum sizes at which points are drawn as octagons, and as polygons with 16 corners.
#define ROUND_FROM   4.0
#define ROUNDER_FROM 12.0

void frame_strokes_size(struct stroke_view *view, const struct lam_scene *scene, const struct frame *frame)
{
    double points = 0, side = frame->width < frame->height ? frame->width : frame->height;
    for (int i = 0; i < scene->objects.count; i++)
        if (scene_shows(scene, i))
            points += scene_mesh(scene, scene_object(scene, i)->mesh)->point_count;
    double least = points < FEW ? FEW_LEAST : POINT_LEAST, most = FEW_MOST * side;
    double size = POINT_SHARE * side / math_sqrt(points > 1 ? points : 1);
    size = size > most ? most : size;
    size = size < least ? least : size;
    view->line_width = (double)frame->settings.line_width;
    view->point_size = frame->settings.point_size > 0 ? (double)frame->settings.point_size : size;
    view->point_corners = view->point_size < ROUND_FROM ? 4 : view->point_size < ROUNDER_FROM ? 8 : POINT_CORNERS_MAX;
}

// Divides memory among the arrays, and returns their size in bytes. If `at` is NULL, the function only returns the
// size.
static size_t divide(const lam_mesh *mesh, size_t point_corners, char *at, struct stroke_arrays *out)
{
    size_t corners = corners_of(mesh, point_corners), items = mesh_items(mesh), vertices = corners * items, size = 0;
    const struct {
        bool there;
        size_t bytes;
    } wanted[] = {{mesh->part_count > 0, mesh->part_count * sizeof(lam_part)},
                  {true, vertices * 3 * sizeof(float)},
                  {mesh->normals != NULL, vertices * 3 * sizeof(float)},
                  {mesh->normals && mesh->tangents, vertices * 4 * sizeof(float)},
                  {mesh->texcoords != NULL, vertices * 2 * sizeof(float)},
                  {mesh->second_texcoords != NULL, vertices * 2 * sizeof(float)},
                  {mesh->colors != NULL, vertices * color_size(mesh)},
                  {true, 3 * (corners - 2) * items * sizeof(uint32_t)}};
    void *arrays[8] = {NULL};
    for (int i = 0; i < 8; i++) {
        arrays[i] = at && wanted[i].there ? at + size : NULL;
        size += wanted[i].there ? (wanted[i].bytes + 15) / 16 * 16 : 0;
    }
    *out =
        (struct stroke_arrays){arrays[0], arrays[1], arrays[2], arrays[3], arrays[4], arrays[5], arrays[6], arrays[7]};
    return size;
}

bool frame_strokes_reserve(struct frame *frame, const struct lam_scene *scene, const struct stroke_view *view,
                           struct call_control *call, lam_error *error)
{
    struct stroke_arrays unused;
    size_t bytes = 0;
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_mesh *mesh = scene_mesh(scene, scene_object(scene, i)->mesh);
        bytes += mesh_is_strokes(mesh) && scene_shows(scene, i) ? divide(mesh, view->point_corners, NULL, &unused) : 0;
    }
    frame->stroke_mesh_count = 0;
    frame->strokes_used = 0;
    // Each instance of a line or point needs its own polygon, unlike instances of triangles.
    if (!call_check_unfolded(call, bytes / UNFOLDED_BYTES, "triangles from lines and points", error))
        return false;
    return !bytes || buffer_reserve(&frame->strokes, bytes, call, error);
}

// Returns the depth offset of a stroke with this width: in perspective, a fraction of the stroke's distance; in an
// orthographic view, a distance. `pixel` is a pixel's height in eye space at w = 1.
static double nearer_by(const struct stroke_view *view, double width, double pixel)
{
    return view->orthographic || width * pixel < 0.25 ? width * pixel : 0.25;
}

void frame_strokes_near(const struct lam_scene *scene, const struct stroke_view *view, double pixel, double *near_plane)
{
    double width = 0;
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_mesh *mesh = scene_mesh(scene, scene_object(scene, i)->mesh);
        double own = !scene_shows(scene, i) ? 0
                     : mesh->line_count     ? view->line_width
                     : mesh->point_count    ? view->point_size
                                            : 0;
        width = own > width ? own : width;
    }
    double nearer = nearer_by(view, width, pixel);
    *near_plane = view->orthographic ? *near_plane - nearer : *near_plane * (1 - nearer);
}

// --- attributes

// A position on a line, at the fraction t of the way from corner a to corner b. For a point, the position is corner a.
struct segment_point {
    size_t a, b;
    double t;
};

static float mixed(float a, float b, double t) { return (float)((double)a + ((double)b - (double)a) * t); }

static void interpolate(const float *from, const uint32_t *own, const lam_mesh *mesh, size_t width,
                        struct segment_point segment_point, float *out)
{
    const float *a = from + width * mesh_element(own, mesh, segment_point.a);
    const float *b = from + width * mesh_element(own, mesh, segment_point.b);
    for (size_t i = 0; i < width; i++)
        out[i] = segment_point.t == 0 ? a[i] : segment_point.t == 1 ? b[i] : mixed(a[i], b[i], segment_point.t);
}

static void interpolate_color(const lam_mesh *mesh, size_t item, struct segment_point segment_point, void *out)
{
    bool each = mesh->colors_rate == LAM_PER_TRIANGLE;
    size_t a = each ? item : mesh_element(mesh->color_indices, mesh, segment_point.a);
    size_t b = each ? item : mesh_element(mesh->color_indices, mesh, segment_point.b);
    if (mesh->colors_format == LAM_COLORS_LINEAR_F32) {
        const float *from = mesh->colors;
        float *to = out;
        for (size_t i = 0; i < 4; i++)
            to[i] = mixed(from[4 * a + i], from[4 * b + i], segment_point.t);
        return;
    }
    const uint8_t *from = mesh->colors;
    uint8_t *to = out;
    bool ends = segment_point.t == 0 || segment_point.t == 1, srgb = mesh->colors_format == LAM_COLORS_SRGB8;
    if (ends) {
        memcpy(to, from + 4 * (segment_point.t == 0 ? a : b), 4);
        return;
    }
    for (size_t i = 0; i < 4; i++) {
        double x = from[4 * a + i] / 255.0, y = from[4 * b + i] / 255.0;
        if (srgb && i < 3) {
            x = srgb_linear(x);
            y = srgb_linear(y);
        }
        double light = x + (y - x) * segment_point.t;
        to[i] = srgb && i < 3 ? srgb_byte(light) : (uint8_t)(light * 255 + 0.5);
    }
}

// --- one polygon

struct builder {
    const lam_mesh *from;
    const struct stroke_view *view;
    struct stroke_arrays to;
    lam_mat4 eye;                        // mesh to eye space
    double normal[3][3];                 // normals to eye space
    double scale[2];                     // width and height of a pixel in eye space at w = 1
    double nearer;                       // the depth offset of a stroke, from nearer_by
    double near_plane;                   // the depth at which the offset moves a point to the near plane
    double half;                         // half the width, pixels
    size_t corners;                      // corners per polygon
    double corner[POINT_CORNERS_MAX][2]; // the corners of a point's polygon, in pixels from its centre
    double bitangent;                    // −1 if the transform mirrors the mesh, otherwise 1
};

static lam_vec3 eye_position(const struct builder *b, size_t corner)
{
    const float *p = b->from->positions + 3 * (size_t)mesh_element(NULL, b->from, corner);
    return mat4_point(&b->eye, v3((double)p[0], (double)p[1], (double)p[2]));
}

static lam_vec3 moved_nearer(const struct builder *b, lam_vec3 p)
{
    return b->view->orthographic ? v3(p.x, p.y, p.z + b->nearer) : v3_scale(p, 1 - b->nearer);
}

static double w_of(const struct builder *b, lam_vec3 p) { return b->view->orthographic ? 1 : -p.z; }

static void store_position(const struct builder *b, size_t vertex, lam_vec3 p)
{
    float *to = b->to.positions + 3 * vertex;
    to[0] = (float)p.x;
    to[1] = (float)p.y;
    to[2] = (float)p.z;
}

static void store_attributes(const struct builder *b, size_t item, size_t vertex, struct segment_point segment_point)
{
    const lam_mesh *mesh = b->from;
    if (b->to.normals) {
        float n[3], *to = b->to.normals + 3 * vertex;
        interpolate(mesh->normals, mesh->normal_indices, mesh, 3, segment_point, n);
        for (int i = 0; i < 3; i++)
            to[i] = (float)(b->normal[i][0] * (double)n[0] + b->normal[i][1] * (double)n[1] +
                            b->normal[i][2] * (double)n[2]);
    }
    if (b->to.tangents) {
        float t[4], *to = b->to.tangents + 4 * vertex;
        interpolate(mesh->tangents, mesh->tangent_indices, mesh, 4, segment_point, t);
        lam_vec3 turned = v3_unit(mat4_vector(&b->eye, v3((double)t[0], (double)t[1], (double)t[2])));
        to[0] = (float)turned.x;
        to[1] = (float)turned.y;
        to[2] = (float)turned.z;
        to[3] = (float)((double)t[3] * b->bitangent);
    }
    if (b->to.texcoords)
        interpolate(mesh->texcoords, mesh->texcoord_indices, mesh, 2, segment_point, b->to.texcoords + 2 * vertex);
    if (b->to.second_texcoords)
        interpolate(mesh->second_texcoords, mesh->second_texcoord_indices, mesh, 2, segment_point,
                    b->to.second_texcoords + 2 * vertex);
    if (b->to.colors)
        interpolate_color(mesh, item, segment_point, (char *)b->to.colors + color_size(mesh) * vertex);
}

// Stores the corners of a rectangle. Corners 0 and 1 are offset from the ends of the line by −(x, y) pixels, corners 2
// and 3 by (x, y) pixels. y points up.
static void store_corners(const struct builder *b, size_t item, const lam_vec3 ends[2], double x, double y)
{
    for (size_t corner = 0; corner < LINE_CORNERS; corner++) {
        lam_vec3 p = ends[corner == 1 || corner == 2];
        double side = corner < 2 ? -w_of(b, p) : w_of(b, p);
        store_position(b, LINE_CORNERS * item + corner,
                       v3(p.x + side * x * b->scale[0], p.y + side * y * b->scale[1], p.z));
    }
}

static void store_nothing(const struct builder *b, size_t item, struct segment_point segment_point)
{
    for (size_t corner = 0; corner < b->corners; corner++) {
        store_position(b, b->corners * item + corner, v3(0, 0, 0));
        store_attributes(b, item, b->corners * item + corner, segment_point);
    }
}

static void build_point(const struct builder *b, size_t item)
{
    lam_vec3 p = eye_position(b, item);
    struct segment_point segment_point = {item, item, 0};
    if (!(-p.z >= b->near_plane)) {
        store_nothing(b, item, segment_point);
        return;
    }
    p = moved_nearer(b, p);
    double w = w_of(b, p), x = w * b->scale[0], y = w * b->scale[1];
    for (size_t corner = 0; corner < b->corners; corner++) {
        const double *to = b->corner[corner];
        store_position(b, b->corners * item + corner, v3(p.x + to[0] * x, p.y + to[1] * y, p.z));
        store_attributes(b, item, b->corners * item + corner, segment_point);
    }
}

static void build_line(const struct builder *b, size_t item)
{
    lam_vec3 p[2] = {eye_position(b, 2 * item), eye_position(b, 2 * item + 1)};
    struct segment_point ends[2] = {{2 * item, 2 * item + 1, 0}, {2 * item, 2 * item + 1, 1}};
    // above 0 if the end is between the eye and the near plane, or behind the eye
    double before[2] = {b->near_plane + p[0].z, b->near_plane + p[1].z};
    if (!(before[0] <= 0) && !(before[1] <= 0)) {
        store_nothing(b, item, ends[0]);
        return;
    }
    for (int i = 0; i < 2; i++)
        if (before[i] > 0) {
            double t = before[0] / (before[0] - before[1]);
            lam_vec3 from = eye_position(b, 2 * item), to = eye_position(b, 2 * item + 1);
            ends[i].t = t;
            p[i] = v3_add(from, v3_scale(v3_sub(to, from), t));
            p[i].z = -b->near_plane;
        }
    double window[2][2];
    for (int i = 0; i < 2; i++) {
        p[i] = moved_nearer(b, p[i]);
        window[i][0] = p[i].x / (w_of(b, p[i]) * b->scale[0]);
        window[i][1] = p[i].y / (w_of(b, p[i]) * b->scale[1]);
    }
    double dx = window[1][0] - window[0][0], dy = window[1][1] - window[0][1], length = math_sqrt(dx * dx + dy * dy);
    if (length > 0)
        store_corners(b, item, p, -dy / length * b->half, dx / length * b->half);
    else // seen end-on
        store_corners(b, item, p, 0, 0);
    for (size_t corner = 0; corner < LINE_CORNERS; corner++)
        store_attributes(b, item, LINE_CORNERS * item + corner, ends[corner == 1 || corner == 2]);
}

// --- whole meshes

// Computes a square or a regular polygon. The side of the square is the point size; the polygon has the area of a disc
// whose diameter is the point size.
static void set_corners(struct builder *b)
{
    double step = 2 * PI / (double)b->corners;
    double radius = b->corners == 4 ? b->half * math_sqrt(2) : b->half * math_sqrt(step / math_sin(step));
    for (size_t i = 0; i < b->corners; i++) {
        b->corner[i][0] = -radius * math_sin(step * ((double)i + 0.5));
        b->corner[i][1] = -radius * math_cos(step * ((double)i + 0.5));
    }
}

static void start(struct builder *b, const struct frame *frame, const lam_mat4 *transform)
{
    const struct stroke_view *view = b->view;
    const lam_mesh *mesh = b->from;
    lam_mat4 origin = mat4_translate(mesh->origin[0], mesh->origin[1], mesh->origin[2]);
    lam_mat4 world = mat4_mul(transform, &origin);
    double width = mesh->line_count ? view->line_width : view->point_size, largest = 0;
    b->eye = mat4_mul(view->view, &world);
    b->half = width / 2;
    b->corners = corners_of(mesh, view->point_corners);
    set_corners(b);
    b->scale[0] = 2 / (view->projection->m[0][0] * frame->width);
    b->scale[1] = 2 / (view->projection->m[1][1] * frame->height);
    b->nearer = nearer_by(view, width, b->scale[1]);
    b->near_plane = view->orthographic ? view->near_plane + b->nearer : view->near_plane / (1 - b->nearer);
    // As in frame_draw: the inverse transpose up to a positive factor, scaled to the range of floats.
    mat4_normal_matrix(&b->eye, b->normal);
    b->bitangent = mat4_determinant3(&b->eye) < 0 ? -1 : 1;
    for (int i = 0; i < 9; i++) {
        double c = b->normal[i / 3][i % 3];
        largest = c > largest ? c : -c > largest ? -c : largest;
    }
    for (int i = 0; i < 9; i++)
        b->normal[i / 3][i % 3] *= b->bitangent / (largest > 0 ? largest : 1);
}

static lam_mesh mesh_of(const struct builder *b)
{
    const lam_mesh *from = b->from;
    size_t items = mesh_items(from);
    size_t triangles = b->corners - 2;
    uint32_t vertices = (uint32_t)(b->corners * items), *to = b->to.indices;
    // The triangles form a fan around the last corner. Both triangles of a line have their last corner at the line's
    // second end, so that flat shading uses the attributes of this end, as OpenGL does for lines.
    for (size_t i = 0; i < items; i++)
        for (size_t k = 0; k < triangles; k++) {
            uint32_t first = (uint32_t)(b->corners * i);
            *to++ = first + (uint32_t)b->corners - 1;
            *to++ = first + (uint32_t)k;
            *to++ = first + (uint32_t)k + 1;
        }
    for (uint32_t i = 0; i < from->part_count; i++) {
        b->to.parts[i] = from->parts[i];
        b->to.parts[i].first_triangle *= (uint32_t)triangles;
        b->to.parts[i].triangle_count *= (uint32_t)triangles;
    }
    return (lam_mesh){.name = from->name,
                      .positions = b->to.positions,
                      .vertex_count = vertices,
                      .indices = b->to.indices,
                      .triangle_count = (uint32_t)(triangles * items),
                      .normals = b->to.normals,
                      .normal_count = b->to.normals ? vertices : 0,
                      .tangents = b->to.tangents,
                      .tangent_count = b->to.tangents ? vertices : 0,
                      .texcoords = b->to.texcoords,
                      .texcoord_count = b->to.texcoords ? vertices : 0,
                      .second_texcoords = b->to.second_texcoords,
                      .second_texcoord_count = b->to.second_texcoords ? vertices : 0,
                      .colors = b->to.colors,
                      .color_count = b->to.colors ? vertices : 0,
                      .colors_format = from->colors_format,
                      .parts = b->to.parts,
                      .part_count = from->part_count};
}

static void set_identity(struct frame_draw *draw, const lam_mat4 *pixel)
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            draw->pixel[i][j] = (float)pixel->m[i][j];
            if (i < 3)
                draw->eye[i][j] = i == j;
            if (i < 3 && j < 3)
                draw->normal[i][j] = draw->tangent[i][j] = i == j;
        }
}

void frame_strokes_build(struct frame *frame, struct frame_draw *draw, const lam_mat4 *transform,
                         const struct stroke_view *view)
{
    struct builder b = {.from = draw->mesh, .view = view};
    frame->strokes_used +=
        divide(b.from, view->point_corners, (char *)frame->strokes.data + frame->strokes_used, &b.to);
    start(&b, frame, transform);
    for (size_t i = 0; i < mesh_items(b.from); i++) {
        if (b.from->line_count)
            build_line(&b, i);
        else
            build_point(&b, i);
    }
    lam_mesh *mesh = &frame->stroke_meshes[frame->stroke_mesh_count++];
    *mesh = mesh_of(&b);
    draw->mesh = mesh;
    draw->strokes = draw->one_sided = true;
    draw->mirrored = false;
    draw->cull = LAM_CULL_NONE;
    draw->crease_rad = 0;
    set_identity(draw, view->pixel);
}
