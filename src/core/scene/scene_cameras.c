// scene_cameras.c: the cameras of a model's file.
#include "scene_internal.h"

#include "linear.h"

#include <lambent/camera.h>

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static const struct scene_camera *camera_at(const lam_scene *scene, int index)
{
    return scene && index >= 0 && index < scene->cameras.count
               ? (const struct scene_camera *)scene->cameras.items + index
               : NULL;
}

int lam_scene_camera_count(const lam_scene *scene) { return scene ? scene->cameras.count : 0; }

const char *lam_scene_camera_name(const lam_scene *scene, int index)
{
    const struct scene_camera *camera = camera_at(scene, index);
    return camera ? camera->name : NULL;
}

int lam_scene_find_camera(const lam_scene *scene, const char *name)
{
    int count = lam_scene_camera_count(scene);
    for (int i = 0; name && i < count; i++) {
        const char *own = lam_scene_camera_name(scene, i);
        if (own && strcmp(own, name) == 0)
            return i;
    }
    char *end;
    unsigned long number = name && *name >= '0' && *name <= '9' ? strtoul(name, &end, 10) : ULONG_MAX;
    return number < (unsigned long)count && !*end ? (int)number : -1;
}

// Returns a distance along the line of sight that exceeds the distance of every triangle.
static double behind_scene(const lam_scene *scene, const lam_camera *camera)
{
    lam_vec3 low, high, forward = v3_unit(v3_sub(camera->target, camera->eye));
    double farthest = 0;
    if (lam_scene_bounds(scene, &low, &high))
        for (int i = 0; i < 8; i++) {
            lam_vec3 corner = v3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
            double distance = v3_dot(v3_sub(corner, camera->eye), forward);
            farthest = distance > farthest ? distance : farthest;
        }
    farthest *= 1.01;
    return farthest > 2 * camera->near_plane ? farthest : 2 * camera->near_plane;
}

bool lam_scene_camera(const lam_scene *scene, int index, lam_camera *camera)
{
    const struct scene_camera *found = camera_at(scene, index);
    if (!camera)
        return found;
    *camera = found ? found->camera : lam_camera_default();
    if (found && camera->near_plane > 0 && camera->far_plane == 0)
        camera->far_plane = behind_scene(scene, camera);
    return found;
}
