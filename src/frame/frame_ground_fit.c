// frame_ground_fit.c: a camera that shows a scene and where its shadows fall on the ground.
//
// The scene is taken as the convex hull of its farthest vertices in fixed directions; each is projected onto the ground
// from every light that casts shadows. The hull is a little smaller than the scene: in 15 degrees between two
// directions, at most by 1 − cos 7.5° = 0.9 % of its radius, which the picture's margin holds.
#include "frame_ground.h"

#include "call_control.h"
#include "camera_fit.h"
#include "float_state.h"
#include "linear.h"
#include "view_extents.h"

#include <stdlib.h>

// The least share of its size without a ground that the scene keeps.
#define SIZE_KEPT 0.7
// Steps of bisection of the distance at which shadows are cut: of 3 radii, to a thousandth of a radius.
enum { CUT_STEPS = 12 };
// How far out a shadow is still seen: of a light's radius, and of the radius of occlusion.
#define LIGHT_SEEN     0.25
#define OCCLUSION_SEEN 0.5
// Directions of the hull: AZIMUTHS over half a turn, two elevations of each and their opposites.
enum { AZIMUTHS = 12, HULL_POINTS = AZIMUTHS * 2 * EXTENT_DIRECTIONS };
// Angles of a scene that turns.
enum { TURNS = 24 };
// Places of the middle and the rim of a light, and of occlusion around a foot.
enum { LIGHT_POINTS = 5, RIM_POINTS = 8 };
// The most shadows of points, 72 bytes each. A scene file can have any number of lights.
#define FALLS_MAX ((size_t)1 << 20)

// A shadow on the ground: the foot of a point of the hull, and where the point's shadow ends, relative to that.
struct fall {
    lam_vec3 foot, shadow;
};

struct falls {
    struct fall *items;
    lam_vec3 *points; // their ends, cut
    int count;
};

static int find_hull(const lam_scene *scene, const struct frame_ground *ground, lam_vec3 points[HULL_POINTS])
{
    int count = 0;
    for (int i = 0; i < AZIMUTHS; i++)
        for (int j = 1; j <= 2; j++) {
            double azimuth = PI * i / AZIMUTHS, elevation = PI / 6 * j;
            double sin_a = math_sin(azimuth), cos_a = math_cos(azimuth), sin_e = math_sin(elevation),
                   cos_e = math_cos(elevation);
            lam_vec3 across = v3_add(v3_scale(ground->right, sin_a), v3_scale(ground->front, cos_a));
            struct view_axes axes = {
                .right = v3_sub(v3_scale(ground->right, cos_a), v3_scale(ground->front, sin_a)),
                .above = v3_sub(v3_scale(ground->up, cos_e), v3_scale(across, sin_e)),
                .back = v3_add(v3_scale(ground->up, sin_e), v3_scale(across, cos_e)),
                .centre = ground->middle,
            };
            struct view_extents extents = {.kx = 0};
            view_extents_find(&(struct view_points){.scene = scene, .axes = &axes, .axes_count = 1}, &extents);
            for (int d = 0; d < EXTENT_DIRECTIONS; d++) {
                lam_vec3 p = extents.point[d];
                lam_vec3 flat = v3_add(v3_scale(axes.right, p.x), v3_scale(axes.above, p.y));
                points[count++] = v3_add(ground->middle, v3_add(flat, v3_scale(axes.back, p.z)));
            }
        }
    return count;
}

// A ball around the centre, for a scene that turns about any axis.
static int find_ball(const struct frame_ground *ground, lam_vec3 centre, double radius, lam_vec3 points[HULL_POINTS])
{
    int count = 0;
    for (int i = 0; i < 2 * AZIMUTHS; i++)
        for (int j = -2; j <= 2; j++) {
            double azimuth = PI * i / AZIMUTHS, elevation = PI / 6 * j, out = radius * math_cos(elevation);
            lam_vec3 flat = v3_add(v3_scale(ground->right, out * math_cos(azimuth)),
                                   v3_scale(ground->front, out * math_sin(azimuth)));
            points[count++] = v3_add(centre, v3_add(flat, v3_scale(ground->up, radius * math_sin(elevation))));
        }
    return count;
}

static void add_fall(struct falls *falls, lam_vec3 foot, lam_vec3 shadow)
{
    falls->items[falls->count++] = (struct fall){.foot = foot, .shadow = shadow};
}

// The direction to the place k of a light, from a point: its middle, and part of its radius out to four sides. Of a
// directional light the disc lies flat, as if it stood overhead, which makes a low one's shadow no shorter.
static lam_vec3 to_light(const struct frame_light *light, const struct frame_ground *ground, int k, lam_vec3 point)
{
    const double *axis = light->world_axis, *at = light->world_position;
    lam_vec3 to =
        light->kind == LIGHT_DIRECTIONAL ? v3(-axis[0], -axis[1], -axis[2]) : v3_sub(v3(at[0], at[1], at[2]), point);
    lam_vec3 side = k < 3 ? ground->right : ground->front;
    return k ? v3_add(to, v3_scale(side, (k & 1 ? LIGHT_SEEN : -LIGHT_SEEN) * light->radius)) : to;
}

static int light_points(const struct frame_light *light) { return light->radius > 0 ? LIGHT_POINTS : 1; }

// Where the shadow of a point at this height above its foot ends, for the places of a light.
static void add_shadows(struct falls *falls, const struct frame_light *light, const struct frame_ground *ground,
                        lam_vec3 foot, double height)
{
    lam_vec3 point = v3_add(foot, v3_scale(ground->up, height));
    for (int k = 0; k < light_points(light); k++) {
        lam_vec3 to = to_light(light, ground, k, point);
        double rise = v3_dot(to, ground->up);
        lam_vec3 flat = v3_sub(to, v3_scale(ground->up, rise));
        double length = v3_length(flat), reach = height * length;
        // A lamp as low as the point, or lower, throws its shadow without end.
        reach = rise > 0 && reach < ground->whole * rise ? reach / rise : ground->whole;
        if (length > 0 && (rise > 0 || light->kind != LIGHT_DIRECTIONAL))
            add_fall(falls, foot, v3_scale(flat, -reach / length));
    }
}

// Adds the shadows of one point of the hull.
static void add_point(struct falls *falls, const struct frame *frame, lam_vec3 foot, double height)
{
    const struct frame_ground *ground = &frame->ground;
    for (int i = 0; i < frame->light_count && frame->shadows; i++)
        if (frame->lights[i].casts_shadows)
            add_shadows(falls, &frame->lights[i], ground, foot, height);
    double r = (double)frame->occlusion_radius;
    for (int k = 0; k < RIM_POINTS && height < r; k++) {
        double out = OCCLUSION_SEEN * math_sqrt(r * r - height * height), angle = 2 * PI * k / RIM_POINTS;
        add_fall(
            falls, foot,
            v3_add(v3_scale(ground->right, out * math_cos(angle)), v3_scale(ground->front, out * math_sin(angle))));
    }
}

// False: there are too many, or no memory.
static bool find_falls(struct falls *falls, const struct frame *frame, const lam_vec3 *hull, int hull_count,
                       lam_vec3 centre, const lam_vec3 *axis)
{
    bool turns = axis && v3_length(*axis) > 0 && v3_finite(centre) && v3_finite(*axis);
    int angles = turns ? TURNS : 1;
    size_t each = RIM_POINTS;
    for (int i = 0; i < frame->light_count && frame->shadows; i++)
        each += frame->lights[i].casts_shadows ? (size_t)light_points(&frame->lights[i]) : 0;
    size_t most = (size_t)angles * (size_t)hull_count * each;
    if (most > FALLS_MAX)
        return false;
    falls->items = malloc(most * sizeof *falls->items);
    falls->points = malloc(most * sizeof *falls->points);
    if (!falls->items || !falls->points)
        return false;
    lam_vec3 up = frame->ground.up;
    for (int a = 0; a < angles; a++) {
        lam_mat4 turn = mat4_rotate(turns ? 2 * PI * a / TURNS : 0, turns ? *axis : v3(0, 0, 1));
        lam_vec3 at[HULL_POINTS];
        double lowest = 0;
        for (int i = 0; i < hull_count; i++) {
            at[i] = a ? v3_add(centre, mat4_vector(&turn, v3_sub(hull[i], centre))) : hull[i];
            double height = v3_dot(v3_sub(at[i], frame->ground.middle), up);
            lowest = i == 0 || height < lowest ? height : lowest;
        }
        for (int i = 0; i < hull_count; i++) {
            double height = v3_dot(v3_sub(at[i], frame->ground.middle), up);
            add_point(falls, frame, v3_sub(at[i], v3_scale(up, height - lowest)), height - lowest);
        }
    }
    return true;
}

// The points to be shown where nothing falls farther than `longest` from its foot.
static struct camera_points cut(const struct falls *falls, double longest)
{
    for (int i = 0; i < falls->count; i++) {
        lam_vec3 shadow = falls->items[i].shadow;
        double length = v3_length(shadow);
        if (length > longest)
            shadow = v3_scale(shadow, longest / length);
        falls->points[i] = v3_add(falls->items[i].foot, shadow);
    }
    return (struct camera_points){.points = falls->points, .count = falls->count};
}

// How much larger the middle of a scene is seen by one camera than by another, which looks the same way.
static double relative_size(const lam_camera *camera, const lam_camera *other, lam_vec3 middle)
{
    if (camera->ortho_half_height > 0)
        return other->ortho_half_height / camera->ortho_half_height;
    lam_vec3 ahead = v3_unit(v3_sub(camera->target, camera->eye));
    double far = v3_dot(ahead, v3_sub(middle, camera->eye)), other_far = v3_dot(ahead, v3_sub(middle, other->eye));
    return far > 0 ? other_far / far : 1;
}

// The camera for a frame that was built with the camera for the scene alone.
static lam_camera fit_frame(const struct frame *frame, const lam_scene *scene, int width, int height,
                            const lam_view *view, lam_vec3 centre, const lam_vec3 *axis, const lam_camera *alone)
{
    lam_vec3 hull[HULL_POINTS], middle;
    double radius;
    lam_camera camera = *alone;
    bool ball = axis && v3_length(*axis) == 0;
    struct falls falls = {.count = 0};
    int count = ball ? find_ball(&frame->ground, centre, scene_radius(scene, centre), hull)
                     : find_hull(scene, &frame->ground, hull);
    if (find_falls(&falls, frame, hull, count, centre, axis) && lam_scene_sphere(scene, -1, &middle, &radius)) {
        double shown = 0, hidden = frame->ground.whole, longest = hidden;
        for (int i = 0; i <= CUT_STEPS; i++) {
            struct camera_points points = cut(&falls, longest);
            camera = camera_fit(scene, width, height, view, centre, axis, &points);
            bool large = relative_size(&camera, alone, middle) >= SIZE_KEPT;
            if (i == 0 && large)
                break; // all of it is shown
            *(large ? &shown : &hidden) = longest;
            longest = i < CUT_STEPS - 1 ? 0.5 * (shown + hidden) : shown;
        }
    }
    free(falls.items);
    free(falls.points);
    return camera;
}

lam_camera lam_camera_fit_ground(const lam_scene *scene, const lam_draw_params *params, int width, int height,
                                 const lam_view *view, lam_vec3 centre, const lam_vec3 *axis)
{
    lam_camera camera = camera_fit(scene, width, height, view, centre, axis, &(struct camera_points){.count = 0});
    bool lines_alone = params && params->no_surfaces && params->output == LAM_OUTPUT_PICTURE; // they have no ground
    if (!scene || !params || !params->ground || lines_alone)
        return camera;
    uint64_t state = float_state_enter();
    struct frame frame = {.width = 0};
    struct call_control call;
    call_start(&call, NULL);
    lam_draw_params picture = *params;
    picture.output = LAM_OUTPUT_PICTURE; // with all lights, whatever is shown
    if (frame_build(&frame, scene, &camera, &picture, width < 1 ? 1 : width, height < 1 ? 1 : height, &call, NULL) &&
        frame.ground.kind)
        camera = fit_frame(&frame, scene, width, height, view, centre, axis, &camera);
    frame_free(&frame);
    float_state_leave(state);
    return camera;
}
