// loader.h: libEGL, opened when it is first asked for, and OpenGL's functions by their names.
#ifndef LOADER_H
#define LOADER_H

#include "gl_functions.h"

#include <lambent/gl.h>

#define EGL_NO_X11 // no header of a window system is wanted
#include <EGL/egl.h>
#include <EGL/eglext.h>

#define EGL_FUNCTIONS(X)                                                                                               \
    X(BindAPI)                                                                                                         \
    X(ChooseConfig)                                                                                                    \
    X(CreateContext)                                                                                                   \
    X(CreatePbufferSurface)                                                                                            \
    X(DestroyContext)                                                                                                  \
    X(DestroySurface)                                                                                                  \
    X(GetCurrentContext)                                                                                               \
    X(GetCurrentDisplay)                                                                                               \
    X(GetCurrentSurface)                                                                                               \
    X(GetDisplay)                                                                                                      \
    X(GetError)                                                                                                        \
    X(GetProcAddress)                                                                                                  \
    X(Initialize)                                                                                                      \
    X(MakeCurrent)                                                                                                     \
    X(QueryAPI)                                                                                                        \
    X(QueryString)

struct egl {
#define EGL_FIELD(name) __typeof__(&egl##name) name;
    EGL_FUNCTIONS(EGL_FIELD)
#undef EGL_FIELD
    // Extensions; NULL: not there.
    PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay;
    PFNEGLQUERYDEVICESEXTPROC QueryDevices;
    PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString;
    char library[256]; // its name, for messages
};

// Opens the library (NULL: "libEGL.so.1") and finds its functions. It stays open until the program ends:
// drivers start threads and exit handlers that must not lose their code. LAM_UNSUPPORTED says what is missing
// and what to install.
bool egl_open(struct egl *egl, const char *library, lam_error *error);

// What the last EGL call failed with, in words.
const char *egl_reason(const struct egl *egl);

// Whether a space-separated list (NULL: empty) has the whole word.
bool list_has(const char *list, const char *word);

// Fills the table. LAM_UNSUPPORTED names the first function that is not there.
bool gl_load(struct gl *gl, lam_gl_get_proc *get, void *user, lam_error *error);

#endif
