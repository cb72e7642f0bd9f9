// offscreen.h: an offscreen OpenGL framebuffer of floats, and drawing the reference meshes into it.
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#include "context.h"
#include "reference_scene.h"

// Must not move between open and close, while its context is current.
struct offscreen {
    struct gl_context context;
    struct gl_previous_context previous;
    int size;
    bool built_ins; // a compatibility context, with gl_Vertex and gl_Normal
    GLuint framebuffer, color, depth, array;
    GLuint positions[MESH_COUNT]; // buffers of 3 floats a vertex
    GLuint normals[MESH_COUNT];   // of 4 floats, w 0
    GLuint tangents[MESH_COUNT];  // of 3 floats
    GLuint indices[MESH_COUNT];   // three of a triangle
    int counts[MESH_COUNT];       // of indices
};

bool offscreen_open(struct offscreen *t, enum gl_profile profile, const char *gl_device, int size, lam_error *error);
void offscreen_close(struct offscreen *t);

// Makes its context no longer current on this thread, and current again, perhaps on another.
void offscreen_rest(struct offscreen *t);
bool offscreen_wake(struct offscreen *t, lam_error *error);

// Attribute locations. −1: of position and normal, the built-in attributes of compatibility contexts; no tangent.
struct offscreen_places {
    int position, normal, tangent;
};

// Clears, draws the mesh with the current program, and reads the picture, rows top-down.
bool offscreen_draw(struct offscreen *t, enum reference_mesh mesh, struct offscreen_places places, float *pixels,
                    lam_error *error);

// Compiles a shader. 0: it does not compile; `log` has the driver's messages.
GLuint offscreen_compile(struct offscreen *t, GLenum kind, const char *text, char *log, size_t capacity);
GLuint offscreen_link(struct offscreen *t, GLuint vertex, GLuint fragment, char *log, size_t capacity);

#endif
