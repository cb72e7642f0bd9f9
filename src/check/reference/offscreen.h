// offscreen.h: a picture of floats that OpenGL draws the reference meshes into.
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#include "context.h"
#include "reference_scene.h"

struct offscreen {
    struct gl_context context; // current between open and close; a struct target must not move
    struct gl_previous previous;
    int size;
    bool built_ins; // a compatibility context: gl_Vertex and gl_Normal
    GLuint framebuffer, color, depth, array;
    GLuint positions[STUDY_MESHES], normals[STUDY_MESHES]; // 3 floats, 4 floats (w 0)
    int counts[STUDY_MESHES];
};

bool offscreen_open(struct offscreen *t, enum gl_profile profile, const char *gl_device, int size, lam_error *error);
void offscreen_close(struct offscreen *t);

// The mesh's buffers, made when it is first asked for.
bool offscreen_mesh(struct offscreen *t, enum reference_mesh mesh, lam_error *error);

// Clears, draws the mesh with the current program, and reads the picture, rows top-down. Where −1 is given,
// attributes are the built-in ones of compatibility contexts.
bool offscreen_draw(struct offscreen *t, enum reference_mesh mesh, int position, int normal, float *pixels,
                    lam_error *error);

// A shader of `kind`; 0, with the driver's words, where it does not compile.
GLuint offscreen_compile(struct offscreen *t, GLenum kind, const char *text, char *log, size_t room);
GLuint offscreen_link(struct offscreen *t, GLuint vertex, GLuint fragment, char *log, size_t room);

#endif
