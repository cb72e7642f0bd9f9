// context.h: finds the OpenGL devices of the machine, and makes contexts on them without a window.
#ifndef CONTEXT_H
#define CONTEXT_H

#include "loader.h"

enum gl_profile {
    GL_PROFILE_CORE,          // OpenGL 3.3 core
    GL_PROFILE_ES,            // OpenGL ES 3.0
    GL_PROFILE_COMPATIBILITY, // desktop OpenGL with all functions since 1.0, and all versions of GLSL
    GL_PROFILE_COUNT
};

// An EGL platform display.
struct gl_platform {
    enum { PLATFORM_DEVICE, PLATFORM_SURFACELESS, PLATFORM_DEFAULT } kind;
    EGLDeviceEXT device;
    bool software; // as EGL reports
    char name[64]; // "/dev/dri/card0"
};
enum { GL_PLATFORMS_MAX = 64 };

// Debug messages of the driver.
struct gl_messages {
    int errors;      // number of messages about errors or undefined behaviour
    char first[256]; // text of the first counted message
};

// A context and its functions. `context` is EGL_NO_CONTEXT for the caller's own context.
struct gl_context {
    struct gl gl; // valid while the context is current
    struct egl egl;
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface; // EGL_NO_SURFACE if the driver needs no surface
    bool es, software;
    int major, minor;
    bool debug; // whether debug messages are collected
    struct gl_messages messages;
    char renderer[128], driver[128]; // "llvmpipe (…)"; maker and version
};

// The context that was current before gl_context_enter, with its surfaces.
struct gl_previous_context {
    EGLDisplay display;
    EGLContext context;
    EGLSurface draw, read;
    EGLenum api;
};

// Makes a context on one display; the context is not current afterwards. Fails with LAM_UNSUPPORTED, and the message
// names the missing feature.
bool gl_context_open(struct gl_context *context, const struct egl *egl, const struct gl_platform *platform,
                     enum gl_profile profile, bool debug, lam_error *error);

// Makes a context on the device that `device` names (lam_gl_params.device) or, if `device` is NULL, on the first usable
// device. The struct must not move while the context collects messages.
bool gl_context_make(struct gl_context *context, const char *library, const char *device, enum gl_profile profile,
                     bool debug, lam_error *error);

// Wraps the caller's current context.
bool gl_context_adopt(struct gl_context *context, lam_gl_get_proc *get, void *user, bool debug, lam_error *error);

// Makes the context current on this thread; gl_context_leave restores the previous context. Both functions do nothing
// for the caller's own context.
bool gl_context_enter(struct gl_context *context, struct gl_previous_context *previous, lam_error *error);
void gl_context_leave(struct gl_context *context, const struct gl_previous_context *previous);

void gl_context_free(struct gl_context *context); // a zeroed context is allowed

// Returns whether the current context has an extension ("GL_KHR_debug").
bool gl_has_extension(const struct gl *gl, const char *extension);

// Returns true if the driver has sent no debug messages. Otherwise fails with LAM_UNSUPPORTED and the text of the first
// message.
bool gl_messages_clean(const struct gl_context *context, const char *doing, lam_error *error);

#endif
