// animate_frame.c: sets up a frame of an animation: the common centre of rotation, the camera and the frame's lights.
#include "animate_frame.h"

#include <string.h>

#include "light_place.h"
#include "vectors.h"

bool animation_wanted(const struct options *o) { return o->animation.turntable || o->animation.sweeps.count; }

const char *animation_option(const struct options *o) { return o->animation.turntable ? "turntable" : "sweep"; }

bool animation_sweeps(const struct animation *a, const char *option)
{
    for (int i = 0; i < a->sweep_count; i++)
        if (sweep_is_option(&a->sweeps[i], option))
            return true;
    return false;
}

// Returns the turntable's angle in a frame, in degrees.
double animation_turn(const struct animation *a, int frame) { return 360.0 * frame / a->count; }

void animation_sphere(const struct job *job, struct model_sphere *sphere)
{
    struct animation *a = job->animation;
    if (!a)
        return;
    if (!a->has_sphere) {
        lam_scene_sphere(job->scene, -1, &a->sphere.centre, &a->sphere.radius);
        if (!(a->sphere.radius > 0))
            a->sphere.radius = 1;
        a->has_sphere = true;
    }
    *sphere = a->sphere;
}

bool animation_camera(const struct job *job, lam_camera *camera)
{
    const struct animation *a = job->animation;
    if (!a || !a->has_camera)
        return false;
    *camera = a->camera;
    return true;
}

static void turn_camera(lam_camera *camera, lam_vec3 centre, lam_vec3 axis, double degrees)
{
    lam_mat4 turn = lam_mat4_rotation(axis, radians(degrees));
    lam_vec3 zero = {0, 0, 0}, back = minus(zero, centre);
    camera->eye = minus(matrix_apply(&turn, minus(camera->eye, centre), 0), back);
    camera->target = minus(matrix_apply(&turn, minus(camera->target, centre), 0), back);
    camera->up = matrix_apply(&turn, camera->up, 0);
}

// Returns the value of a swept option minus its value in the first frame.
static double swept(const struct animation *a, const char *option)
{
    for (int i = a->sweep_count - 1; i >= 0; i--) // a later sweep overrides an earlier sweep
        if (sweep_is_option(&a->sweeps[i], option))
            return sweep_value(&a->sweeps[i], a->index, a->count) - sweep_value(&a->sweeps[i], 0, a->count);
    return 0;
}

// Moves the camera of the first frame around the model.
static void move_camera(struct job *job)
{
    const struct animation *a = job->animation;
    lam_vec3 up, front;
    scene_axes(job->scene, &up, &front);
    double higher = swept(a, "elevation"), around = swept(a, "azimuth");
    if (job->options->animation.turntable && job->options->animation.turntable_light == TURNTABLE_LIGHT_MODEL)
        around -= animation_turn(a, a->index);
    if (higher != 0) {
        lam_view view = lam_view_of_side((lam_side)job->options->view.side);
        double azimuth_rad =
            job->options->view.has_azimuth ? radians(job->options->view.azimuth_deg) : view.azimuth_rad;
        lam_vec3 side = {up.y * front.z - up.z * front.y, up.z * front.x - up.x * front.z,
                         up.x * front.y - up.y * front.x};
        lam_mat4 turn = lam_mat4_rotation(up, azimuth_rad);
        turn_camera(&job->camera, a->sphere.centre, matrix_apply(&turn, side, 0), -higher);
    }
    if (around != 0)
        turn_camera(&job->camera, a->sphere.centre, up, around);
}

bool animation_arrange(struct job *job, lam_error *error)
{
    struct animation *a = job->animation;
    if (!a)
        return true;
    if (!a->has_camera && !animation_sweeps(a, "zoom") && !animation_sweeps(a, "fov")) {
        a->camera = job->camera;
        a->has_camera = true;
    }
    for (int i = 0; i < a->sweep_count; i++)
        if (a->sweeps[i].kind == SWEEP_LIGHT &&
            !light_sweep(job, &a->sweeps[i], sweep_value(&a->sweeps[i], a->index, a->count), a->sphere.centre, error))
            return false;
    if (job->options->animation.turntable && job->options->animation.turntable_light == TURNTABLE_LIGHT_MODEL &&
        !lights_fix_to_world(job, error))
        return false;
    move_camera(job);
    return true;
}
