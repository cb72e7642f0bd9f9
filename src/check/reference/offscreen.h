// offscreen.h: a picture of floats that OpenGL draws the reference meshes into.
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#include "context.h"
#include "reference_scene.h"

struct target {
    struct gl_context context; // current between open and close; a struct target must not move
    struct gl_previous previous;
    int size;
    bool built_ins; // a compatibility context: gl_Vertex and gl_Normal
    GLuint framebuffer, color, depth, array;
    GLuint positions[STUDY_MESHES], normals[STUDY_MESHES]; // 3 floats, 4 floats (w 0)
    int counts[STUDY_MESHES];
};

bool target_open(struct target *t, enum gl_profile profile, const char *gl_device, int size, lam_error *error);
void target_close(struct target *t);

// The mesh's buffers, made when it is first asked for.
bool target_mesh(struct target *t, enum study_mesh mesh, lam_error *error);

// Clears, draws the mesh with the current program, and reads the picture, rows top-down. Where −1 is given,
// attributes are the built-in ones of compatibility contexts.
bool target_draw(struct target *t, enum study_mesh mesh, int position, int normal, float *pixels, lam_error *error);

// A shader of `kind`; 0, with the driver's words, where it does not compile.
GLuint target_compile(struct target *t, GLenum kind, const char *text, char *log, size_t room);
GLuint target_link(struct target *t, GLuint vertex, GLuint fragment, char *log, size_t room);

#endif
