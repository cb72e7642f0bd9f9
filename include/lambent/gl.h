// lambent/gl.h: a device that draws with OpenGL. The device reproduces the CPU device's picture within a stated
// tolerance (docs/opengl.md).
//
// OpenGL is loaded at run time: programs that link this library also start and draw on machines without it.
#ifndef LAMBENT_GL_H
#define LAMBENT_GL_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// The OpenGL interface of a context without a window.
typedef enum lam_gl_api {
    LAM_GL_CORE = 0, // OpenGL 3.3, core profile
    LAM_GL_ES,       // OpenGL ES 3.0, the base of WebGL 2
} lam_gl_api;

// A pointer to an OpenGL function; its actual type depends on its name.
typedef void (*lam_gl_function)(void);

// Returns the function of this name ("glDrawArrays"), or NULL if there is none. For a window made by SDL, GLFW or GTK,
// call SDL_GL_GetProcAddress, glfwGetProcAddress or eglGetProcAddress.
typedef lam_gl_function lam_gl_get_proc(void *user, const char *name);

// Parameters of an OpenGL device. All zero: OpenGL 3.3 core on the first usable device, without a window.
typedef struct lam_gl_params {
    // The interface to use. Ignored if the device draws in the caller's own context.
    lam_gl_api api;
    // The device: its number in lam_gl_devices ("0"), or a part of its name or driver ("llvmpipe"), in upper or lower
    // case. NULL: the first usable device, hardware before software.
    const char *device;
    // If not NULL, the device draws in the caller's own context, which must be current on the calling thread during
    // this call, each lam_draw and lam_device_free. The context must support OpenGL 3.3 (core or compatibility) or
    // OpenGL ES 3.0. The device draws into its own framebuffers and restores every state that it changes.
    lam_gl_get_proc *get_proc_address;
    void *user; // passed to `get_proc_address`
    // Collects the driver's debug messages (KHR_debug): an error fails the draw with LAM_UNSUPPORTED and the driver's
    // sentence. Drawing is then slower; the option is meant for tests.
    bool debug;
    // Path of the EGL library for drawing without a window. NULL: "libEGL.so.1".
    const char *library;
    // Draws with shaders of the lecture style (lam_shader_style); a draw fails with LAM_UNSUPPORTED if the style lacks
    // a feature of the scene.
    bool lecture;
    // The id of a mistake, or of two ("no-gate+no-ambient"), that the lecture-style shader contains; a draw fails with LAM_UNSUPPORTED if its shader
    // cannot contain it. NULL: none.
    const char *mistake;
    // The graphics card filters textures, with 8-bit texels if the picture has 8 bits. Drawing is then faster, but the
    // picture may differ from the CPU device's picture by a few hundredths of the range (docs/opengl.md). By default,
    // the shader filters textures, as the CPU device does.
    bool hardware_filter;
    LAM_RESERVED(5);
} lam_gl_params;

// Makes an OpenGL device; lam_device_free frees it. `params` may be NULL. Returns NULL on failure: LAM_UNSUPPORTED if a
// library, a driver or a version is missing (the sentence names it and the package to install), LAM_LIMIT.
LAM_API lam_device *lam_device_gl(const lam_gl_params *params, lam_error *error);

// A device of this machine on which OpenGL can run without a window. Unknown strings are "".
typedef struct lam_gl_device {
    int number; // the number for lam_gl_params.device
    // The driver's name for the device: "llvmpipe (LLVM 15.0.6, 256 bits)".
    char name[128];
    // The driver's vendor and version: "Mesa, 4.5 (Core Profile) Mesa 22.3.6".
    char driver[128];
    char path[64];     // EGL's name for it: "/dev/dri/card0", "software"
    char versions[64]; // supported versions: "OpenGL 3.3, OpenGL ES 3.0"
    bool software;     // whether the processor does the work
    bool usable;       // whether it supports at least one of the versions
    char reason[192];  // one sentence: the reason if it is not usable
    LAM_RESERVED(8);
} lam_gl_device;

// Finds the devices by starting each of them. Starting a device can take from a few to a few hundred milliseconds.
// Writes the first `capacity` of them, hardware first, and returns the number of devices; −1 and LAM_UNSUPPORTED if
// OpenGL cannot be loaded. `params` may be NULL; only its `library` is used.
LAM_API int lam_gl_devices(const lam_gl_params *params, lam_gl_device *devices, int capacity, lam_error *error);

#ifdef __cplusplus
}
#endif
#endif
