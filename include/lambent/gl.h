// lambent/gl.h: a device that draws with OpenGL: the same picture as the CPU device's within a stated
// tolerance (docs/opengl.md).
//
// OpenGL is found at run time: a program that links this library starts and draws on a machine that has none
// of it.
#ifndef LAMBENT_GL_H
#define LAMBENT_GL_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lam_gl_api {
    LAM_GL_CORE = 0, // OpenGL 3.3, core profile
    LAM_GL_ES,       // OpenGL ES 3.0, which is what WebGL 2 has
} lam_gl_api;

// A function of OpenGL by its name ("glDrawArrays"); NULL: there is none. For a window made by SDL, GLFW or
// GTK it hands on to SDL_GL_GetProcAddress, glfwGetProcAddress, eglGetProcAddress …
typedef void (*lam_gl_function)(void);
typedef lam_gl_function lam_gl_get_proc(void *user, const char *name);

// What a device of OpenGL is made of. All zero: OpenGL 3.3 core without a window on the first usable device.
typedef struct lam_gl_params {
    lam_gl_api api; // without a window only; the caller's own context says itself which it is
    // Which device, by its number in lam_gl_devices ("0") or a part of its name or driver ("llvmpipe"), upper
    // and lower case alike; NULL: the first that can be used, hardware before software.
    const char *device;
    // Not NULL: the caller's own context, current on the calling thread now, in each lam_draw and in
    // lam_device_free; OpenGL 3.3 (core or compatibility) or OpenGL ES 3.0. The device draws into
    // framebuffers of its own, and gives back all state that it changes.
    lam_gl_get_proc *get_proc_address;
    void *user; // handed to get_proc_address
    // The driver's debug messages are collected (KHR_debug): an error, or a warning about speed, fails the
    // draw with LAM_UNSUPPORTED and the driver's sentence. For tests; slower.
    bool debug;
    const char *library; // the EGL library; NULL: "libEGL.so.1". Without a window only
} lam_gl_params;

// The OpenGL device. NULL and the reason, LAM_UNSUPPORTED, when a library, a driver or a version is missing:
// the sentence says which, and what to install. `params` may be NULL.
LAM_API lam_device *lam_device_gl(const lam_gl_params *params, lam_error *error);

// One device of this machine that OpenGL can be had from, without a window.
typedef struct lam_gl_device {
    int number; // as in lam_gl_params.device
    // the driver's own name of it: "llvmpipe (LLVM 15.0.6, 256 bits)"; "" where it cannot be started
    char name[128];
    char driver[128];  // the driver's maker and version: "Mesa, 4.5 (Core Profile) Mesa 22.3.6"
    char place[64];    // what EGL calls it: "/dev/dri/card0", "software"
    char versions[64]; // what it can do: "OpenGL 3.3, OpenGL ES 3.0"
    bool software;     // the processor does the work
    bool usable;       // has at least one of the two
    char reason[192];  // why not, one sentence; "" where it is usable
} lam_gl_device;

// Looks for devices: each is started and let go again, which takes some milliseconds to some hundreds. Writes
// at most `room` of them and returns how many there are, hardware first; −1 and the reason (LAM_UNSUPPORTED)
// when OpenGL cannot be had at all. `params` may be NULL; only `library` is looked at.
LAM_API int lam_gl_devices(const lam_gl_params *params, lam_gl_device *devices, int room, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
