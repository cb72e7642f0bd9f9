// environment_scene.h: spheres under an environment given by a formula (a sky over a ground, and three discs with soft
// edges), for tests that compare environment light with sums in double precision.
#ifndef ENVIRONMENT_SCENE_H
#define ENVIRONMENT_SCENE_H

#include <lambent/lambent.h>

#define PI 3.14159265358979323846

// The light from a unit direction.
void radiance(const double d[3], double out[3]);

// The same as an environment of 1024×512 pixels.
lam_environment *make_environment(void);

enum { ACROSS = 7, DOWN = 5, CELL = 44 };
extern const float roughnesses[ACROSS];
extern const double base_color[3];

// Spheres of all roughnesses, from left to right, and of all metalnesses, from dielectric to metal, CELL pixels each.
lam_scene *make_spheres(const lam_environment *environment, lam_rgb color);

// Their picture in linear floats, with one sample per pixel, seen along −z without perspective.
lam_image draw_spheres(const lam_scene *scene, lam_draw_params params, int threads, lam_isa isa);

// In a uniform environment of 1, white metals return all of its light, whatever their roughness.
void check_white_furnace(lam_draw_params params);

// The same bytes with every instruction set and with 1, 2 and 5 threads. Each picture prefilters the environment anew.
void check_same_bytes(lam_draw_params params);

#endif
