// frame_ground.c: places the ground of a frame and builds its mesh: squares that fade out around the model
// (lam_ground).
#include "frame_ground.h"

#include "linear.h"
#include "up_axis.h"
#include "view_extents.h"

// The ground begins to fade at the distance WHOLE, and is invisible from END, in radii of the scene's sphere. A catcher
// shows only its shadow.
#define WHOLE       3.0
#define END         6.0
#define CATCHER_END 4.0
// A catcher fades between these distances from the picture's centre, as fractions of half the picture's size, so that
// no shadow is cut off at the border. If the camera is fitted, the model is inside these distances (FILL_ON_GROUND in
// camera_fit.c).
#define BORDER_FIRST 0.8
#define BORDER_LAST  0.95
// The distance below the lowest point, in radii. Without this distance, a flat underside would have the same depth as
// the ground.
#define DROP 0x1p-14
// The sides of the mesh's squares, as fractions of the ground's radius: for a ground without a checker pattern, and for
// a catcher.
#define PLAIN_SQUARE   0.0625
#define CATCHER_SQUARE 0.015625
// The brightness of a checker's dark squares relative to the bright squares.
#define DARK_SQUARE 0.45f

// Returns the height of the scene's lowest vertex along `up`, from `centre`.
static double lowest(const lam_scene *scene, lam_vec3 right, lam_vec3 front, lam_vec3 up, lam_vec3 centre)
{
    struct view_axes axes = {.right = right, .above = front, .back = v3_scale(up, -1), .centre = centre};
    struct view_points points = {.scene = scene, .axes = &axes, .axes_count = 1};
    struct view_extents extents = {.kx = 0};
    view_extents_find(&points, &extents);
    return -extents.value[EXTENT_FRONT];
}

void frame_ground_place(struct frame *frame, const lam_scene *scene, const lam_camera *camera, const lam_mat4 *view)
{
    const lam_draw_params *params = &frame->settings;
    struct frame_ground *ground = &frame->ground;
    ground->kind = LAM_GROUND_NONE;
    lam_vec3 centre;
    double radius;
    // A catcher is not a surface of the model. The only surface property that it shows is ambient occlusion.
    bool number = !lam_output_is_light(params->output) && params->output != LAM_OUTPUT_CLIPPED &&
                  params->output != LAM_OUTPUT_AMBIENT_OCCLUSION;
    if (!params->ground || (params->ground == LAM_GROUND_SHADOW && number) ||
        !lam_scene_sphere(scene, -1, &centre, &radius) || !(radius > 0))
        return;
    ground->right = from_y_up(scene->up, v3(1, 0, 0));
    ground->up = from_y_up(scene->up, v3(0, 1, 0));
    ground->front = from_y_up(scene->up, v3(0, 0, 1));
    double height = lowest(scene, ground->right, ground->front, ground->up, centre) - DROP * radius;
    ground->middle = v3_add(centre, v3_scale(ground->up, height));
    // The upper side is visible everywhere or nowhere, because the eye is either above or below the plane, and an
    // orthographic view has a single direction.
    bool above = camera->ortho_half_height > 0
                     ? v3_dot(v3_sub(camera->target, camera->eye), ground->up) < 0
                     : v3_dot(v3_sub(camera->eye, ground->middle), ground->up) > 1e-6 * radius;
    if (!above)
        return;
    bool catcher = params->ground == LAM_GROUND_SHADOW;
    ground->whole = (catcher ? 0.5 * CATCHER_END : WHOLE) * radius;
    ground->end = (catcher ? CATCHER_END : END) * radius;
    ground->square = params->ground == LAM_GROUND_CHECKER ? math_round_down(0.5 * radius)
                                                          : (catcher ? CATCHER_SQUARE : PLAIN_SQUARE) * ground->end;
    // A model so small or so large that doubles do not represent its ground has none.
    double reach = v3_dot(ground->middle, ground->middle) + ground->end * ground->end;
    if (!(ground->square > 0 && ground->end <= 1000 * ground->square && reach < 1e300))
        return;
    ground->kind = params->ground;
    lam_vec3 middle = mat4_point(view, ground->middle), up = mat4_vector(view, ground->up);
    ground->eye_up[0] = (float)up.x;
    ground->eye_up[1] = (float)up.y;
    ground->eye_up[2] = (float)up.z;
    ground->eye_middle[0] = (float)middle.x;
    ground->eye_middle[1] = (float)middle.y;
    ground->eye_middle[2] = (float)middle.z;
    ground->eye_height = (float)v3_dot(middle, up);
}

void frame_ground_planes(const struct frame_ground *ground, const lam_mat4 *view, bool orthographic, double *near_plane,
                         double *far_plane)
{
    // Along the view direction, the circle extends from its centre by the radius times the sine of the angle between
    // the view direction and `up`.
    lam_vec3 middle = mat4_point(view, ground->middle), up = mat4_vector(view, ground->up);
    double reach = 1.01 * (ground->end + 2 * ground->square) * math_sqrt(up.z * up.z < 1 ? 1 - up.z * up.z : 0);
    double nearest = -middle.z - reach, farthest = -middle.z + reach;
    *far_plane = farthest > *far_plane ? farthest : *far_plane;
    *near_plane = nearest < *near_plane ? nearest : *near_plane;
    if (!orthographic && *near_plane < *far_plane * 1e-4)
        *near_plane = *far_plane * 1e-4;
}

// Returns 1 up to `first`, and 0 from `last` on.
static double fade(double x, double first, double last)
{
    double t = (last - x) / (last - first);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

// Returns the opacity of a catcher at a point. The opacity depends on the point's distance from the picture's border,
// and is 0 behind the eye.
static double border_fade(const struct frame *frame, const lam_mat4 *to_pixel, lam_vec3 at)
{
    double p[4];
    for (int i = 0; i < 4; i++)
        p[i] = to_pixel->m[i][0] * at.x + to_pixel->m[i][1] * at.y + to_pixel->m[i][2] * at.z + to_pixel->m[i][3];
    if (!(p[3] > 0))
        return 0;
    double x = 2 * p[0] / (p[3] * frame->width) - 1, y = 2 * p[1] / (p[3] * frame->height) - 1;
    return fade(x < 0 ? -x : x, BORDER_FIRST, BORDER_LAST) * fade(y < 0 ? -y : y, BORDER_FIRST, BORDER_LAST);
}

static int64_t whole_number(double x)
{
    if (!(x > -1e15 && x < 1e15))
        return 0; // so far from zero, a double is too coarse to tell squares apart
    int64_t n = (int64_t)x;
    return n - ((double)n > x);
}

bool frame_ground_make(struct frame *frame, const lam_mat4 *view, const lam_mat4 *pixel, struct call_control *call,
                       lam_error *error)
{
    struct frame_ground *ground = &frame->ground;
    lam_mat4 place = mat4_translate(ground->middle.x, ground->middle.y, ground->middle.z),
             to_pixel = mat4_mul(view, &place);
    to_pixel = mat4_mul(pixel, &to_pixel);
    bool catcher = ground->kind == LAM_GROUND_SHADOW;
    // In world space, the edges of a checker's squares are at multiples of the square's size, so that the ground stays
    // the same while a model rotates.
    bool checker = ground->kind == LAM_GROUND_CHECKER;
    double at_x = v3_dot(ground->middle, ground->right), at_y = v3_dot(ground->middle, ground->front);
    int64_t first_x = checker ? whole_number(at_x / ground->square) : 0;
    int64_t first_y = checker ? whole_number(at_y / ground->square) : 0;
    double shift_x = checker ? (double)first_x * ground->square - at_x : 0;
    double shift_y = checker ? (double)first_y * ground->square - at_y : 0;
    if (shift_x < -ground->square || shift_x > 0 || shift_y < -ground->square || shift_y > 0)
        shift_x = shift_y = 0; // so far from zero, a double is too coarse for the squares
    int half = (int)(ground->end / ground->square) + 2, side = 2 * half;
    size_t corners = 4 * (size_t)side * (size_t)side;
    size_t bytes = corners * (3 + 4) * sizeof(float) + corners / 4 * 6 * sizeof(uint32_t);
    if (!buffer_reserve(&ground->memory, bytes, call, error))
        return false;
    float *positions = ground->memory.data, *colors = positions + 3 * corners;
    uint32_t *indices = (uint32_t *)(colors + 4 * corners), vertices = 0, triangles = 0;
    for (int j = -half; j < half; j++)
        for (int i = -half; i < half; i++) {
            bool dark = checker && ((first_x + i + first_y + j) & 1);
            float any = 0, *p = positions + 3 * (size_t)vertices, *c = colors + 4 * (size_t)vertices;
            for (int k = 0; k < 4; k++) { // counter-clockwise seen from above
                double x = (i + (k == 2 || k == 3)) * ground->square + shift_x;
                double y = (j + (k == 1 || k == 2)) * ground->square + shift_y;
                lam_vec3 at = v3_add(v3_scale(ground->right, x), v3_scale(ground->front, y));
                p[3 * k] = (float)at.x;
                p[3 * k + 1] = (float)at.y;
                p[3 * k + 2] = (float)at.z;
                c[4 * k] = c[4 * k + 1] = c[4 * k + 2] = dark ? DARK_SQUARE : 1;
                double opacity = fade(math_sqrt(x * x + y * y), ground->whole, ground->end);
                if (catcher && opacity > 0)
                    opacity *= border_fade(frame, &to_pixel, at);
                c[4 * k + 3] = (float)opacity;
                any = c[4 * k + 3] > any ? c[4 * k + 3] : any;
            }
            if (any == 0)
                continue;
            static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
            for (int k = 0; k < 6; k++)
                indices[3 * (size_t)triangles + (size_t)k] = vertices + order[k];
            vertices += 4;
            triangles += 2;
        }
    ground->mesh = (lam_mesh){.name = "ground",
                              .origin = {ground->middle.x, ground->middle.y, ground->middle.z},
                              .positions = positions,
                              .vertex_count = vertices,
                              .indices = indices,
                              .triangle_count = triangles,
                              .colors = colors,
                              .color_count = vertices,
                              .colors_format = LAM_COLORS_LINEAR_F32};
    return true;
}
