// light_place.c: converts lights from their coordinate frames to world coordinates, and sweeps values of lights in an
// animation.
#include "light_place.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lambent/fields.h>
#include <lambent/light.h>

#include "console.h"
#include "vectors.h"

// --- vectors

lam_vec3 matrix_apply(const lam_mat4 *m, lam_vec3 v, double w)
{
    return (lam_vec3){m->m[0][0] * v.x + m->m[0][1] * v.y + m->m[0][2] * v.z + w * m->m[0][3],
                      m->m[1][0] * v.x + m->m[1][1] * v.y + m->m[1][2] * v.z + w * m->m[1][3],
                      m->m[2][0] * v.x + m->m[2][1] * v.y + m->m[2][2] * v.z + w * m->m[2][3]};
}

static lam_vec3 add(lam_vec3 a, lam_vec3 b) { return (lam_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static lam_vec3 times(lam_vec3 v, double s) { return (lam_vec3){v.x * s, v.y * s, v.z * s}; }

static lam_vec3 turned(lam_vec3 v, lam_vec3 axis, double degrees)
{
    lam_mat4 turn = lam_mat4_rotation(axis, radians(degrees));
    return matrix_apply(&turn, v, 0);
}

void scene_axes(const lam_scene *scene, lam_vec3 *up, lam_vec3 *front)
{
    lam_up axis = lam_scene_up(scene);
    double sign = axis >= LAM_UP_NEGATIVE_X ? -1 : 1;
    bool x = axis == LAM_UP_X || axis == LAM_UP_NEGATIVE_X, z = axis == LAM_UP_Z || axis == LAM_UP_NEGATIVE_Z;
    *up = (lam_vec3){x ? sign : 0, x || z ? 0 : sign, z ? sign : 0};
    *front = z ? (lam_vec3){0, -1, 0} : (lam_vec3){0, 0, 1};
}

// --- frames

lam_mat4 light_to_world(const struct job *job, const lam_light *light)
{
    lam_mat4 m = lam_mat4_identity();
    if (light->frame == LAM_FRAME_CAMERA ||
        light->frame ==
            LAM_FRAME_VIEW) { // the inverse of a rigid view: the transposed rotation, with the eye as the origin
        lam_mat4 view = lam_camera_view_matrix(&job->camera);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                m.m[i][j] = view.m[j][i];
        lam_vec3 low, high, origin = job->camera.eye;
        if (light->frame == LAM_FRAME_VIEW && lam_scene_bounds(job->scene, &low, &high))
            origin = times(add(low, high), 0.5);
        m.m[0][3] = origin.x;
        m.m[1][3] = origin.y;
        m.m[2][3] = origin.z;
    } else if (light->frame != LAM_FRAME_WORLD) {
        // --rotate rotates the whole model, so the transform of any object contains the rotation.
        for (int i = 0; i < lam_scene_object_count(job->scene); i++) {
            const lam_object *object = lam_scene_object(job->scene, i);
            bool meant = light->frame == LAM_FRAME_MODEL || !light->object ||
                         (object->name && strcmp(object->name, light->object) == 0);
            if (meant)
                return object->transform;
        }
    }
    return m;
}

bool lights_fix_to_world(struct job *job, lam_error *error)
{
    for (int i = 0; i < lam_scene_light_count(job->scene); i++) {
        lam_light light = *lam_scene_light(job->scene, i);
        if (light.frame != LAM_FRAME_CAMERA && light.frame != LAM_FRAME_VIEW)
            continue;
        lam_mat4 world = light_to_world(job, &light);
        light.position = matrix_apply(&world, light.position, 1);
        light.direction = matrix_apply(&world, light.direction, 0);
        light.up = matrix_apply(&world, light.up, 0);
        light.frame = LAM_FRAME_WORLD;
        if (!lam_scene_set_light(job->scene, i, &light, error))
            return false;
    }
    return true;
}

// --- directions towards a light

// The axes of a light's frame, and the reference point for its position.
struct surroundings {
    lam_vec3 up, front, centre;
};

static struct surroundings surroundings_of(const struct job *job, const lam_light *light, lam_vec3 centre)
{
    struct surroundings s = {{0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    if (light->frame == LAM_FRAME_CAMERA) {
        lam_mat4 view = lam_camera_view_matrix(&job->camera);
        s.centre = matrix_apply(&view, centre, 1);
    } else if (light->frame != LAM_FRAME_VIEW) {
        scene_axes(job->scene, &s.up, &s.front);
        s.centre = centre;
    }
    if (light->frame == LAM_FRAME_OBJECT) {
        double radius;
        for (int i = 0; i < lam_scene_object_count(job->scene); i++) {
            const char *name = lam_scene_object(job->scene, i)->name;
            if (!light->object || (name && strcmp(name, light->object) == 0)) {
                lam_scene_sphere(job->scene, i, &s.centre, &radius);
                break;
            }
        }
    }
    return s;
}

// Moves a light to another azimuth or elevation. `way` is the vector to the light; returns the new vector.
static lam_vec3 placed(lam_vec3 way, const struct surroundings *s, bool azimuth, double degrees)
{
    double height = dot(way, s->up), length = sqrt(dot(way, way));
    lam_vec3 level = minus(way, times(s->up, height));
    double across = sqrt(dot(level, level));
    lam_vec3 ahead = across > 1e-9 * length ? times(level, 1 / across) : s->front;
    if (azimuth)
        return add(times(s->up, height), times(turned(s->front, s->up, degrees), across));
    return times(turned(ahead, cross(ahead, s->up), degrees), length);
}

// Applies to `v` the rotation without roll that maps the direction `from` to the direction `to`.
static lam_vec3 carried(lam_vec3 v, lam_vec3 from, lam_vec3 to, const struct surroundings *s)
{
    lam_vec3 axes[2][3];
    for (int i = 0; i < 2; i++) {
        lam_vec3 way = i ? to : from, side = cross(s->up, way);
        double length = sqrt(dot(way, way)), width = sqrt(dot(side, side));
        side = width > 1e-9 * length ? times(side, 1 / width) : cross(s->up, s->front);
        axes[i][0] = times(way, 1 / length);
        axes[i][1] = side;
        axes[i][2] = cross(axes[i][0], side);
    }
    lam_vec3 out = {0, 0, 0};
    for (int i = 0; i < 3; i++)
        out = add(out, times(axes[1][i], dot(v, axes[0][i])));
    return out;
}

static bool set_angle(const struct job *job, lam_light *light, bool azimuth, double degrees, lam_vec3 centre)
{
    struct surroundings s = surroundings_of(job, light, centre);
    if (light->type == LAM_LIGHT_DIRECTIONAL) {
        light->direction = times(placed(times(light->direction, -1), &s, azimuth, degrees), -1);
        return true;
    }
    if (light->type != LAM_LIGHT_POINT && light->type != LAM_LIGHT_SPOT)
        return false;
    lam_vec3 from = minus(light->position, s.centre);
    if (dot(from, from) == 0)
        return false;
    lam_vec3 to = placed(from, &s, azimuth, degrees);
    light->position = add(s.centre, to);
    light->direction = carried(light->direction, from, to, &s);
    return true;
}

// --- one number

static void brighten(lam_rgb *color, double factor)
{
    color->r = (float)((double)color->r * factor);
    color->g = (float)((double)color->g * factor);
    color->b = (float)((double)color->b * factor);
}

void light_brighten(lam_light *light, double factor)
{
    brighten(&light->ambient, factor);
    brighten(&light->diffuse, factor);
    brighten(&light->specular, factor);
    brighten(&light->sky, factor);
    brighten(&light->ground, factor);
}

// Returns the field with this key, or NULL if lights of this type do not have such a field.
static const lam_field *field_of(const lam_light *light, const char *key)
{
    for (int i = 0; lam_light_field(i); i++)
        if (strcmp(lam_light_field(i)->key, key) == 0 && (lam_light_field(i)->light_types & 1u << light->type))
            return lam_light_field(i);
    return NULL;
}

static bool set_field(lam_light *light, const struct sweep *sweep, double value)
{
    const lam_field *field = field_of(light, sweep->field);
    double numbers[4];
    if (!field)
        return false;
    int count = lam_field_get(field, light, numbers);
    if (field->type == LAM_FIELD_ANGLE)
        value = radians(value);
    for (int i = 0; i < count; i++)
        if (sweep->component < 0 || sweep->component == i)
            numbers[i] = value;
    lam_field_set(field, light, numbers);
    return true;
}

// Sets a numeric property of the light. Returns false if the light does not have this property.
static bool set_number(const struct job *job, const struct sweep *sweep, double value, lam_vec3 centre,
                       lam_light *light)
{
    switch (sweep->light) {
    case SWEEP_LIGHT_FIELD:
        return set_field(light, sweep, value);
    case SWEEP_LIGHT_INTENSITY:
        light_brighten(light, value);
        return true;
    default:
        return set_angle(job, light, sweep->light == SWEEP_LIGHT_AZIMUTH, value, centre);
    }
}

static bool is_meant(const struct sweep *sweep, const lam_light *light, int index)
{
    char number[16];
    snprintf(number, sizeof number, "%d", index + 1);
    return !*sweep->which || strcmp(sweep->which, number) == 0 ||
           (light->name && strcmp(sweep->which, light->name) == 0);
}

static bool no_such_light(const lam_scene *scene, const struct sweep *sweep, bool found, lam_error *error)
{
    static const char *const words[] = {[SWEEP_LIGHT_AZIMUTH] = "azimuth",
                                        [SWEEP_LIGHT_ELEVATION] = "elevation",
                                        [SWEEP_LIGHT_INTENSITY] = "intensity"};
    const char *number = sweep->light == SWEEP_LIGHT_FIELD ? sweep->field : words[sweep->light];
    char known[300] = "";
    for (int i = 0; i < lam_scene_light_count(scene) && strlen(known) < sizeof known - 80; i++) {
        const lam_light *light = lam_scene_light(scene, i);
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%d (%s%s%.40s)", i ? ", " : "", i + 1,
                 lam_light_type_describe(light->type)->word, light->name ? " " : "", light->name ? light->name : "");
    }
    if (found)
        return complain(error, LAM_BAD_ARGUMENT, "option '--sweep': light %s has no %s; the lights are %s",
                        sweep->which, number, known);
    if (*sweep->which)
        return complain(error, LAM_BAD_ARGUMENT, "option '--sweep': there is no light '%s'; the lights are %s",
                        sweep->which, *known ? known : "none");
    return complain(error, LAM_BAD_ARGUMENT, "option '--sweep': no light has '%s'; the lights are %s", number,
                    *known ? known : "none");
}

bool light_sweep(const struct job *job, const struct sweep *sweep, double value, lam_vec3 centre, lam_error *error)
{
    bool found = false;
    for (int i = 0; i < lam_scene_light_count(job->scene); i++) {
        lam_light light = *lam_scene_light(job->scene, i);
        if (!is_meant(sweep, &light, i))
            continue;
        found = true;
        if (set_number(job, sweep, value, centre, &light)) {
            lam_error reason = {0};
            return lam_scene_set_light(job->scene, i, &light, &reason) ||
                   complain(error, reason.code, "option '--sweep': %.400s", reason.text);
        }
        if (*sweep->which)
            break;
    }
    return no_such_light(job->scene, sweep, found && *sweep->which, error);
}
