// camera_option.c: the value of --camera.
#include "camera_option.h"

#include <string.h>

#include "console.h"
#include "options.h"
#include "suggest.h"

double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

// "x/y/z"
static bool read_vector(const char *text, lam_vec3 *out)
{
    double *part[3] = {&out->x, &out->y, &out->z};
    for (int i = 0; i < 3; i++) {
        text = read_number(text, part[i]);
        if (!text || *text != (i < 2 ? '/' : 0))
            return false;
        text++;
    }
    return true;
}

static bool read_real(const char *text, double *out)
{
    text = read_number(text, out);
    return text && !*text;
}

static const char *const keys[] = {"eye", "target", "up", "fovy", "ortho", "near", "far", NULL};
enum key { EYE, TARGET, UP, FOVY, ORTHO, NEAR, FAR, KEY_COUNT };

static enum key find_key(const char *name)
{
    int key = 0;
    while (keys[key] && strcmp(keys[key], name) != 0)
        key++;
    return (enum key)key;
}

static bool unknown_key(const char *name, lam_error *error)
{
    struct suggestion nearest = suggest_start(name);
    for (int i = 0; keys[i]; i++)
        suggest_try(&nearest, keys[i]);
    return complain(error, LAM_BAD_ARGUMENT, "unknown key '%.60s'%s%s%s", name, nearest.best ? "; did you mean '" : "",
                    nearest.best ? nearest.best : "",
                    nearest.best ? "'?" : "; expected eye, target, up, fovy, ortho, near or far");
}

static bool read_pair(char *pair, struct camera_option *option, bool seen[KEY_COUNT], lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value)
        return complain(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as eye=2/1/4", pair);
    *value++ = 0;
    enum key key = find_key(pair);
    if (key == KEY_COUNT)
        return unknown_key(pair, error);
    if (seen[key])
        return complain(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    seen[key] = true;
    lam_camera *camera = &option->camera;
    double *real[KEY_COUNT] = {[FOVY] = &camera->fovy_rad,
                               [ORTHO] = &camera->ortho_half_height,
                               [NEAR] = &camera->near_plane,
                               [FAR] = &camera->far_plane};
    lam_vec3 *vector[KEY_COUNT] = {[EYE] = &camera->eye, [TARGET] = &camera->target, [UP] = &camera->up};
    if (vector[key] && !read_vector(value, vector[key]))
        return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected three numbers x/y/z", pair, value);
    if (real[key] && !read_real(value, real[key]))
        return complain(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected a number", pair, value);
    return true;
}

static bool check(struct camera_option *option, const bool seen[KEY_COUNT], lam_error *error)
{
    lam_camera *camera = &option->camera;
    if (!seen[EYE])
        return complain(error, LAM_BAD_ARGUMENT, "'eye' is missing, expected eye=x/y/z");
    if (seen[FOVY] && seen[ORTHO])
        return complain(error, LAM_BAD_ARGUMENT, "'fovy' and 'ortho' are given, expected one of them");
    if (seen[FOVY] && !(camera->fovy_rad > 0 && camera->fovy_rad < 180))
        return complain(error, LAM_BAD_ARGUMENT, "fovy is %.10g, expected degrees above 0 and below 180",
                        camera->fovy_rad);
    if (seen[ORTHO] && !(camera->ortho_half_height > 0))
        return complain(error, LAM_BAD_ARGUMENT, "ortho is %.10g, expected half the height of the view, above 0",
                        camera->ortho_half_height);
    if (seen[NEAR] != seen[FAR])
        return complain(error, LAM_BAD_ARGUMENT, "only '%s' is given, expected both of near and far, or neither",
                        seen[NEAR] ? "near" : "far");
    if (seen[NEAR] && !(camera->near_plane < camera->far_plane && (seen[ORTHO] || camera->near_plane > 0)))
        return complain(error, LAM_BAD_ARGUMENT, "near is %.10g and far is %.10g, expected %snear < far",
                        camera->near_plane, camera->far_plane, seen[ORTHO] ? "" : "0 < ");
    const lam_vec3 *eye = &camera->eye, *target = &camera->target, *up = &camera->up;
    if (seen[TARGET] && eye->x == target->x && eye->y == target->y && eye->z == target->z)
        return complain(error, LAM_BAD_ARGUMENT, "eye and target are the same point");
    if (seen[UP] && up->x == 0 && up->y == 0 && up->z == 0)
        return complain(error, LAM_BAD_ARGUMENT, "up is 0/0/0, expected a direction");
    return true;
}

bool camera_option_parse(const char *text, struct camera_option *option, lam_error *error)
{
    *option = (struct camera_option){.camera = lam_camera_default()};
    bool seen[KEY_COUNT] = {false};
    char copy[1024];
    if (strlen(text) >= sizeof copy)
        return complain(error, LAM_BAD_ARGUMENT, "it is %zu letters long, expected less than %zu", strlen(text),
                        sizeof copy);
    strcpy(copy, text);
    for (char *rest = copy, *pair; (pair = strsep(&rest, ",")) != NULL;)
        if (!read_pair(pair, option, seen, error))
            return false;
    if (!check(option, seen, error))
        return false;
    option->camera.fovy_rad = radians(seen[FOVY] ? option->camera.fovy_rad : 30);
    option->has_target = seen[TARGET];
    option->has_up = seen[UP];
    return true;
}

lam_camera camera_option_complete(const struct camera_option *option, const lam_scene *scene)
{
    lam_camera camera = option->camera;
    if (!option->has_target) {
        lam_vec3 least, most;
        lam_scene_bounds(scene, &least, &most);
        camera.target = (lam_vec3){(least.x + most.x) / 2, (least.y + most.y) / 2, (least.z + most.z) / 2};
    }
    if (!option->has_up) {
        lam_up up = lam_scene_up(scene);
        camera.up = (lam_vec3){up == LAM_UP_X, up == LAM_UP_Y || up == LAM_UP_AUTO, up == LAM_UP_Z};
    }
    return camera;
}
