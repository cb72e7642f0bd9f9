// camera_words.c: parses descriptions of cameras, and lists the named sides of a scene.
#include <lambent/camera.h>

#include <string.h>

#include "fail.h"
#include "linear.h"
#include "up_axis.h"
#include "word_values.h"

// --- sides

static const struct {
    const char *name;
    double azimuth_deg, elevation_deg;
} sides[LAM_SIDE_COUNT] = {
    [LAM_SIDE_THREE_QUARTER] = {"three-quarter", 30, 20},
    [LAM_SIDE_FRONT] = {"front", 0, 0},
    [LAM_SIDE_BACK] = {"back", 180, 0},
    [LAM_SIDE_LEFT] = {"left", -90, 0},
    [LAM_SIDE_RIGHT] = {"right", 90, 0},
    [LAM_SIDE_TOP] = {"top", 0, 90},
    [LAM_SIDE_BOTTOM] = {"bottom", 0, -90},
    [LAM_SIDE_ISO] = {"iso", 45, 35.264389682754654}, // atan(1/√2)
};

const char *lam_side_name(lam_side side) { return (unsigned)side < LAM_SIDE_COUNT ? sides[side].name : NULL; }

lam_side lam_side_find(const char *name)
{
    int side = 0;
    while (side < LAM_SIDE_COUNT && (!name || strcmp(sides[side].name, name) != 0))
        side++;
    return (lam_side)side;
}

lam_view lam_view_of_side(lam_side side)
{
    if ((unsigned)side >= LAM_SIDE_COUNT)
        side = LAM_SIDE_THREE_QUARTER;
    return (lam_view){.from_angles = true,
                      .azimuth_rad = math_radians(sides[side].azimuth_deg),
                      .elevation_rad = math_radians(sides[side].elevation_deg)};
}

// --- cameras

enum key { EYE, TARGET, UP, FOVY, ORTHO, NEAR, FAR, KEY_COUNT };
static const char *const keys[] = {"eye", "target", "up", "fovy", "ortho", "near", "far", NULL};

const char *lam_camera_key(int index) { return index >= 0 && index < KEY_COUNT ? keys[index] : NULL; }

struct parser {
    lam_camera camera; // fovy is stored in degrees
    bool seen[KEY_COUNT];
};

static bool read_pair(char *pair, struct parser *parser, lam_error *error)
{
    char *value = strchr(pair, '=');
    if (!value)
        return fail(error, LAM_BAD_ARGUMENT, "found '%.60s', expected key=value, such as eye=2/1/4", pair);
    *value++ = 0;
    int key = word_key(pair, keys, error);
    if (key < 0)
        return false;
    if (parser->seen[key])
        return fail(error, LAM_BAD_ARGUMENT, "'%s' is given twice", pair);
    parser->seen[key] = true;
    lam_camera *camera = &parser->camera;
    lam_vec3 *vector[KEY_COUNT] = {[EYE] = &camera->eye, [TARGET] = &camera->target, [UP] = &camera->up};
    double *number[KEY_COUNT] = {[FOVY] = &camera->fovy_rad,
                                 [ORTHO] = &camera->ortho_half_height,
                                 [NEAR] = &camera->near_plane,
                                 [FAR] = &camera->far_plane};
    double found[3];
    int count = vector[key] ? 3 : 1;
    if (!word_numbers(value, count, count, found, &count, NULL))
        return fail(error, LAM_BAD_ARGUMENT, "found '%s=%.60s', expected %s", pair, value,
                    vector[key] ? "three numbers x/y/z" : "a number");
    if (vector[key])
        *vector[key] = v3(found[0], found[1], found[2]);
    else
        *number[key] = found[0];
    return true;
}

static bool check(const struct parser *parser, lam_error *error)
{
    const lam_camera *camera = &parser->camera;
    const bool *seen = parser->seen;
    if (!seen[EYE])
        return fail(error, LAM_BAD_ARGUMENT, "'eye' is missing, expected eye=x/y/z");
    if (seen[FOVY] && seen[ORTHO])
        return fail(error, LAM_BAD_ARGUMENT, "'fovy' and 'ortho' are given, expected only one");
    if (seen[FOVY] && !(camera->fovy_rad > 0 && camera->fovy_rad < 180))
        return fail(error, LAM_BAD_ARGUMENT, "fovy is %.10g, expected degrees above 0 and below 180", camera->fovy_rad);
    if (seen[ORTHO] && !(camera->ortho_half_height > 0))
        return fail(error, LAM_BAD_ARGUMENT, "ortho is %.10g, expected half the height of the view, above 0",
                    camera->ortho_half_height);
    if (seen[NEAR] != seen[FAR])
        return fail(error, LAM_BAD_ARGUMENT, "only '%s' is given, expected both of near and far, or neither",
                    seen[NEAR] ? "near" : "far");
    if (seen[NEAR] && !(camera->near_plane < camera->far_plane && (seen[ORTHO] || camera->near_plane > 0)))
        return fail(error, LAM_BAD_ARGUMENT, "near is %.10g and far is %.10g, expected %snear < far",
                    camera->near_plane, camera->far_plane, seen[ORTHO] ? "" : "0 < ");
    const lam_vec3 *eye = &camera->eye, *target = &camera->target, *up = &camera->up;
    if (seen[TARGET] && eye->x == target->x && eye->y == target->y && eye->z == target->z)
        return fail(error, LAM_BAD_ARGUMENT, "eye and target are the same point");
    if (seen[UP] && up->x == 0 && up->y == 0 && up->z == 0)
        return fail(error, LAM_BAD_ARGUMENT, "up is 0/0/0, expected a direction");
    return true;
}

bool lam_camera_parse(const char *text, const lam_scene *scene, lam_camera *camera, lam_error *error)
{
    struct parser parser = {.camera = lam_camera_default()};
    parser.camera.fovy_rad = 30;
    char copy[WORDS_MAX];
    if (!text || !camera)
        return fail(error, LAM_BAD_ARGUMENT, "lam_camera_parse: %s is NULL", text ? "camera" : "text");
    if (!word_copy(text, copy, error))
        return false;
    for (char *rest = copy, *pair; (pair = strsep(&rest, ",")) != NULL;)
        if (!read_pair(pair, &parser, error))
            return false;
    if (!check(&parser, error))
        return false;
    *camera = parser.camera;
    camera->fovy_rad = math_radians(camera->fovy_rad);
    lam_vec3 low, high;
    if (!parser.seen[TARGET] && scene && lam_scene_bounds(scene, &low, &high))
        camera->target = v3((low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2);
    if (!parser.seen[UP] && scene)
        camera->up = from_y_up(lam_scene_up(scene), v3(0, 1, 0));
    return true;
}
