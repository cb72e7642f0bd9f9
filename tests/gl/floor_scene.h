// floor_scene.h: a textured floor that extends away from the eye, for tests of texture filters.
#ifndef FLOOR_SCENE_H
#define FLOOR_SCENE_H

#include <lambent/lambent.h>

// A picture of random texels; if `scale` is above 1, floats up to `scale`.
lam_texture *random_texture(int width, int height, float scale);

// A floor that extends away from the eye: near texels are many pixels wide, far ones a fraction of a pixel. The second
// set of texture coordinates is rotated by 90°. If `map` is NULL, there is no texture.
lam_scene *floor_scene(const lam_texture_map *map);

// The same with an unlit cube of another map, which may be NULL.
lam_scene *floor_and_cube(const lam_texture_map *map, const lam_texture_map *other);

// Draws a scene with the floor's camera into size × size floats; the samples and the ambient occlusion in `more` are
// ignored.
lam_image floor_draw(lam_device *device, const lam_scene *scene, int size, int anisotropy, const lam_draw_params *more);

// Linear light, clamped to 0…1, sRGB-encoded.
double encoded(float linear);

#endif
