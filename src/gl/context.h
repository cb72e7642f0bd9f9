// context.h: contexts of OpenGL without a window, on a device of the machine, and which devices there are.
#ifndef CONTEXT_H
#define CONTEXT_H

#include "loader.h"

enum gl_profile {
    GL_PROFILE_CORE,          // OpenGL 3.3 core
    GL_PROFILE_ES,            // OpenGL ES 3.0
    GL_PROFILE_COMPATIBILITY, // desktop OpenGL with everything since 1.0; GLSL without a version line, 120 …
    GL_PROFILE_COUNT
};

// Where a context can be had from.
struct gl_place {
    enum { PLACE_DEVICE, PLACE_SURFACELESS, PLACE_DEFAULT } kind;
    EGLDeviceEXT device;
    bool software; // EGL says so
    char name[64]; // "/dev/dri/card0"
};
enum { GL_PLACES_MAX = 64 };

// Lists the places, hardware before software. Mesa's surfaceless platform and the default display stand in
// only where EGL cannot enumerate devices, or knows none. Returns their number, at most GL_PLACES_MAX.
int gl_places(const struct egl *egl, struct gl_place *places);

// What the driver has said in the context's debug messages.
struct gl_messages {
    int errors, slow; // errors and undefined behaviour; warnings about speed
    char first[256];  // the first of either
};

// A context, with the table of its functions. The caller's own context is one whose `context` is EGL_NO_CONTEXT.
struct gl_context {
    struct gl gl; // valid while the context is current
    struct egl egl;
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface; // EGL_NO_SURFACE where the driver needs none
    bool es, software;
    int major, minor;
    bool debug; // messages are collected
    struct gl_messages messages;
    char renderer[128], driver[128]; // "llvmpipe (…)"; maker and version
};

// The context that was current before, with its surfaces.
struct gl_previous {
    EGLDisplay display;
    EGLContext context;
    EGLSurface draw, read;
    EGLenum api;
};

// A context on one place. It is left current nowhere. LAM_UNSUPPORTED says what the place lacks.
bool gl_context_open(struct gl_context *context, const struct egl *egl, const struct gl_place *place,
                     enum gl_profile profile, bool debug, lam_error *error);

// A context on the device that `device` names (lam_gl_params.device), on the first usable one where it is
// NULL. A struct gl_context must not move while it collects messages.
bool gl_context_make(struct gl_context *context, const char *library, const char *device, enum gl_profile profile,
                     bool debug, lam_error *error);

// Takes the caller's own current context.
bool gl_context_adopt(struct gl_context *context, lam_gl_get_proc *get, void *user, bool debug, lam_error *error);

// Makes the context current on this thread, and gives the thread back what was. Nothing happens for the
// caller's own.
bool gl_context_enter(struct gl_context *context, struct gl_previous *previous, lam_error *error);
void gl_context_leave(struct gl_context *context, const struct gl_previous *previous);

void gl_context_free(struct gl_context *context); // zeroed is fine

// Of the current context: whether it has an extension ("GL_KHR_debug").
bool gl_has(const struct gl *gl, const char *extension);

// The debug messages so far make an error: LAM_UNSUPPORTED with the driver's words. True where there are none.
bool gl_messages_clean(const struct gl_context *context, const char *doing, lam_error *error);

// Finds what the current context is: version, names; starts collecting messages.
bool gl_context_probe(struct gl_context *context, lam_error *error);

#endif
