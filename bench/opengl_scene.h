// opengl_scene.h: the scene of the OpenGL program, read from the text file that scenes.py writes next to Lambent's
// scene file.
#ifndef OPENGL_SCENE_H
#define OPENGL_SCENE_H

#include <stddef.h>
#include <stdint.h>

enum shading { PHONG, GOURAUD, FLAT };

// A point light: its position in the world, its colour times the material's diffuse and specular colours, and the
// numbers a, b, c of its attenuation 1/(a + b d + c d^2).
struct point_light {
    float position[3], diffuse[3], specular[3], attenuation[3];
};

struct gl_scene {
    int width, height, samples;
    enum shading shading;
    double eye[3], target[3], up[3], fovy_degrees, near_plane, far_plane;
    float ambient[3]; // the material's ambient colour times the ambient light
    int shininess;
    struct point_light *lights;
    int light_count;
    float *positions; // x, y, z of each vertex
    float *normals;   // unit, smooth
    uint32_t *indices;
    size_t vertices, triangles;
};

// Reads the scene and its model (a PLY that model.c wrote). On failure it prints an error message and exits.
struct gl_scene gl_scene_read(const char *path);

#endif
