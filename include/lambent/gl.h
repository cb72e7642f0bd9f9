// lambent/gl.h: OpenGL on this machine.
//
// OpenGL is found at run time: a program that links this library starts and draws on a machine that has none
// of it.
#ifndef LAMBENT_GL_H
#define LAMBENT_GL_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// A function of OpenGL by its name ("glDrawArrays"); NULL: there is none. For a window made by SDL, GLFW or
// GTK it hands on to SDL_GL_GetProcAddress, glfwGetProcAddress, eglGetProcAddress …
typedef void (*lam_gl_function)(void);
typedef lam_gl_function lam_gl_get_proc(void *user, const char *name);

typedef struct lam_gl_params {
    const char *library; // the EGL library; NULL: "libEGL.so.1"
} lam_gl_params;

// One device of this machine that OpenGL can be had from, without a window.
typedef struct lam_gl_device {
    int number;     // in this list
    char name[128]; // the driver's own name of it: "llvmpipe (LLVM 15.0.6, 256 bits)"; "" where it cannot be
                    // started
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
LAM_API
int lam_gl_devices(const lam_gl_params *params, lam_gl_device *devices, int room, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
