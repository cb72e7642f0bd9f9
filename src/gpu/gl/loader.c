// loader.c: opens libEGL, and looks up the functions of EGL and OpenGL by name. The program links neither library. On a
// machine without OpenGL, the program therefore still starts and draws with the CPU device.
#include "loader.h"

#include "dynamic_library.h"
#include "fail.h"

#include <stdio.h>
#include <string.h>

#define TO_INSTALL "on Debian: apt install libegl1 libegl-mesa0 libgl1-mesa-dri, or the graphics card's own driver"

bool egl_open(struct egl *egl, const char *library, lam_error *error)
{
    memset(egl, 0, sizeof *egl);
    snprintf(egl->library, sizeof egl->library, "%s", library ? library : "libEGL.so.1");
    const char *reason = NULL;
    void *opened = library_open(egl->library, true, &reason);
    if (!opened)
        return fail(error, LAM_UNSUPPORTED, "OpenGL: the library %s cannot be opened (%.150s); " TO_INSTALL,
                    egl->library, reason);
#define FIND(name)                                                                                                     \
    if (!library_find(opened, "egl" #name, &egl->name))                                                                \
        return fail(error, LAM_UNSUPPORTED,                                                                            \
                    "OpenGL: the library %s lacks the function egl" #name ", expected EGL 1.4 or newer; " TO_INSTALL,  \
                    egl->library);
    EGL_FUNCTIONS(FIND)
#undef FIND
    const char *client = egl->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (list_has(client, "EGL_EXT_platform_base"))
        egl->GetPlatformDisplay = (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl->GetProcAddress("eglGetPlatformDisplayEXT");
    if (list_has(client, "EGL_EXT_device_base") || list_has(client, "EGL_EXT_device_enumeration")) {
        egl->QueryDevices = (PFNEGLQUERYDEVICESEXTPROC)egl->GetProcAddress("eglQueryDevicesEXT");
        egl->QueryDeviceString = (PFNEGLQUERYDEVICESTRINGEXTPROC)egl->GetProcAddress("eglQueryDeviceStringEXT");
    }
    return true;
}

const char *egl_reason(const struct egl *egl)
{
    switch (egl->GetError()) {
    case EGL_SUCCESS:
        return "EGL reports no error";
    case EGL_NOT_INITIALIZED:
        return "the driver cannot be started (EGL_NOT_INITIALIZED)";
    case EGL_BAD_ACCESS:
        return "this process has no access to the driver (EGL_BAD_ACCESS)";
    case EGL_BAD_ALLOC:
        return "out of memory (EGL_BAD_ALLOC)";
    case EGL_BAD_ATTRIBUTE:
        return "the driver does not support an attribute (EGL_BAD_ATTRIBUTE)";
    case EGL_BAD_CONFIG:
        return "the driver has no matching configuration (EGL_BAD_CONFIG)";
    case EGL_BAD_MATCH:
        return "the driver does not support this version (EGL_BAD_MATCH)";
    case EGL_BAD_DISPLAY:
        return "no such display (EGL_BAD_DISPLAY)";
    case EGL_CONTEXT_LOST:
        return "the device was lost (EGL_CONTEXT_LOST)";
    default:
        return "unknown EGL error";
    }
}

bool list_has(const char *list, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = list ? strstr(list, word) : NULL; at; at = strstr(at + 1, word))
        if ((at == list || at[-1] == ' ') && (at[length] == 0 || at[length] == ' '))
            return true;
    return false;
}

bool gl_load(struct gl *gl, lam_gl_get_proc *get, void *user, lam_error *error)
{
    memset(gl, 0, sizeof *gl);
#define FIND(name)                                                                                                     \
    gl->name = (__typeof__(gl->name))get(user, "gl" #name);                                                            \
    if (!gl->name)                                                                                                     \
        return fail(error, LAM_UNSUPPORTED,                                                                            \
                    "OpenGL: the driver lacks the function gl" #name ", expected OpenGL 3.3 or OpenGL ES 3.0");
    GL_FUNCTIONS(FIND)
#undef FIND
#define FIND(name) gl->name = (__typeof__(gl->name))get(user, "gl" #name);
    GL_OPTIONAL_FUNCTIONS(FIND)
#undef FIND
    if (!gl->DebugMessageCallback) {
        gl->DebugMessageCallback = (__typeof__(gl->DebugMessageCallback))get(user, "glDebugMessageCallbackKHR");
        gl->DebugMessageControl = (__typeof__(gl->DebugMessageControl))get(user, "glDebugMessageControlKHR");
    }
    return true;
}
