// loader.h: loads libEGL at run time, and looks up the OpenGL functions by name.
#ifndef LOADER_H
#define LOADER_H

#include "gl_functions.h"

#include <lambent/gl.h>

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
    // Extensions; NULL if not available.
    PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay;
    PFNEGLQUERYDEVICESEXTPROC QueryDevices;
    PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString;
    char library[256]; // file name, for error messages
};

// Opens the library (NULL: "libEGL.so.1") and looks up its functions. The library stays open until the program ends,
// because drivers start threads and install exit handlers. Fails with LAM_UNSUPPORTED, and names the missing library or
// function and its package.
bool egl_open(struct egl *egl, const char *library, lam_error *error);

// Returns the error of the last EGL call as a phrase.
const char *egl_reason(const struct egl *egl);

// Returns whether a space-separated list (NULL if empty) contains the word.
bool list_has(const char *list, const char *word);

// Fills the table of functions. Fails with LAM_UNSUPPORTED, and names the first missing function.
bool gl_load(struct gl *gl, lam_gl_get_proc *get, void *user, lam_error *error);

#endif
