// context.c: makes OpenGL contexts without a window. Uses a device that EGL enumerates, Mesa's surfaceless platform, or
// a surface of one pixel on the default display.
#include "context.h"
#include "fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- queries a context's version, names and extensions, and collects the driver's debug messages.

bool gl_has_extension(const struct gl *gl, const char *extension)
{
    GLint count = 0;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++) {
        const char *name = (const char *)gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
        if (name && strcmp(name, extension) == 0)
            return true;
    }
    return false;
}

// GL_DEBUG_OUTPUT_SYNCHRONOUS: the driver calls this function during the OpenGL call that caused the message.
static void APIENTRY on_debug_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                      const GLchar *text, const void *user)
{
    (void)id, (void)severity, (void)length;
    struct gl_messages *messages = (struct gl_messages *)(uintptr_t)user;
    // Compiler messages are reported by the code that compiles the shader.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER)
        return;
    bool error = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (error && !messages->errors)
        snprintf(messages->first, sizeof messages->first, "%.250s", text);
    messages->errors += error;
}

static bool collect_messages(struct gl_context *context, lam_error *error)
{
    const struct gl *gl = &context->gl;
    bool built_in =
        context->es ? context->major * 10 + context->minor >= 32 : context->major * 10 + context->minor >= 43;
    if ((!built_in && !gl_has_extension(gl, "GL_KHR_debug")) || !gl->DebugMessageCallback || !gl->DebugMessageControl)
        return fail(error, LAM_UNSUPPORTED, "OpenGL: the driver of '%s' does not support debug messages (GL_KHR_debug)",
                    context->renderer);
    gl->Enable(GL_DEBUG_OUTPUT);
    gl->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl->DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_TRUE);
    gl->DebugMessageCallback(on_debug_message, &context->messages);
    return true;
}

// Reads "3.3 (Core Profile) Mesa 22.3.6" or "OpenGL ES 3.2 Mesa 22.3.6".
static void read_version(struct gl_context *context, const char *version)
{
    context->es = strncmp(version, "OpenGL ES", 9) == 0;
    const char *digits = version + strcspn(version, "0123456789");
    char *end = NULL;
    context->major = (int)strtol(digits, &end, 10);
    context->minor = end && *end == '.' ? (int)strtol(end + 1, NULL, 10) : 0;
}

static bool is_software(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software Rasterizer"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strstr(renderer, names[i]))
            return true;
    return false;
}

// Queries the version and names of the current context, and starts to collect debug messages.
static bool gl_context_probe(struct gl_context *context, lam_error *error)
{
    const struct gl *gl = &context->gl;
    const char *version = (const char *)gl->GetString(GL_VERSION);
    const char *renderer = (const char *)gl->GetString(GL_RENDERER);
    const char *vendor = (const char *)gl->GetString(GL_VENDOR);
    if (!version)
        return fail(error, LAM_UNSUPPORTED, "OpenGL: no context is current on this thread");
    read_version(context, version);
    snprintf(context->renderer, sizeof context->renderer, "%s", renderer ? renderer : "unnamed");
    snprintf(context->driver, sizeof context->driver, "%s, %s", vendor ? vendor : "unnamed", version);
    context->software |= is_software(context->renderer);
    return !context->debug || collect_messages(context, error);
}

bool gl_messages_clean(const struct gl_context *context, const char *doing, lam_error *error)
{
    const struct gl_messages *messages = &context->messages;
    if (!messages->errors)
        return true;
    return fail(error, LAM_UNSUPPORTED, "OpenGL: %s: the driver reports %d errors; the first: %s", doing,
                messages->errors, messages->first);
}

// --- displays

static void name_platform(const struct egl *egl, struct gl_platform *platform)
{
    const char *extensions = egl->QueryDeviceString ? egl->QueryDeviceString(platform->device, EGL_EXTENSIONS) : NULL;
    const char *file = list_has(extensions, "EGL_EXT_device_drm")
                           ? egl->QueryDeviceString(platform->device, EGL_DRM_DEVICE_FILE_EXT)
                           : NULL;
    platform->software = list_has(extensions, "EGL_MESA_device_software");
    snprintf(platform->name, sizeof platform->name, "%s", file ? file : platform->software ? "software" : "device");
}

// Lists the displays, hardware before software: the devices that EGL enumerates or, if there are none, Mesa's
// surfaceless platform and the default display. Returns their number, at most GL_PLATFORMS_MAX.
static int gl_platforms(const struct egl *egl, struct gl_platform *platforms)
{
    EGLDeviceEXT devices[GL_PLATFORMS_MAX];
    EGLint found = 0;
    if (!egl->QueryDevices || !egl->GetPlatformDisplay || !egl->QueryDevices(GL_PLATFORMS_MAX, devices, &found))
        found = 0;
    int count = 0;
    for (int software = 0; software < 2; software++)
        for (int i = 0; i < found; i++) {
            struct gl_platform platform = {.kind = PLATFORM_DEVICE, .device = devices[i]};
            name_platform(egl, &platform);
            if (platform.software == (software == 1))
                platforms[count++] = platform;
        }
    if (count)
        return count;
    const char *client = egl->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (egl->GetPlatformDisplay && list_has(client, "EGL_MESA_platform_surfaceless"))
        platforms[count++] = (struct gl_platform){.kind = PLATFORM_SURFACELESS, .name = "surfaceless"};
    platforms[count++] = (struct gl_platform){.kind = PLATFORM_DEFAULT, .name = "default display"};
    return count;
}

static EGLDisplay display_of(const struct egl *egl, const struct gl_platform *platform)
{
    switch (platform->kind) {
    case PLATFORM_DEVICE:
        return egl->GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, platform->device, NULL);
    case PLATFORM_SURFACELESS:
        return egl->GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    default:
        return egl->GetDisplay(EGL_DEFAULT_DISPLAY);
    }
}

// --- contexts

static const char *const profile_names[GL_PROFILE_COUNT] = {"OpenGL 3.3 core", "OpenGL ES 3.0",
                                                            "OpenGL's compatibility profile"};

static EGLContext create(const struct egl *egl, EGLDisplay display, EGLConfig config, enum gl_profile profile,
                         bool debug)
{
    EGLint a[16];
    int n = 0;
    a[n++] = EGL_CONTEXT_MAJOR_VERSION_KHR;
    a[n++] = 3;
    a[n++] = EGL_CONTEXT_MINOR_VERSION_KHR;
    a[n++] = profile == GL_PROFILE_ES ? 0 : 3;
    if (profile != GL_PROFILE_ES) {
        a[n++] = EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR;
        a[n++] = profile == GL_PROFILE_CORE ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR
                                            : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT_KHR;
    }
    if (debug) {
        a[n++] = EGL_CONTEXT_FLAGS_KHR;
        a[n++] = EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR;
    }
    a[n] = EGL_NONE;
    EGLContext made = egl->CreateContext(display, config, EGL_NO_CONTEXT, a);
    // A driver without a compatibility profile of 3.3 may still support OpenGL 2.1.
    if (made == EGL_NO_CONTEXT && profile == GL_PROFILE_COMPATIBILITY) {
        static const EGLint any[] = {EGL_NONE};
        made = egl->CreateContext(display, config, EGL_NO_CONTEXT, any);
    }
    return made;
}

static bool start(struct gl_context *context, const struct gl_platform *platform, enum gl_profile profile,
                  lam_error *error)
{
    const struct egl *egl = &context->egl;
    EGLint major, minor;
    context->display = display_of(egl, platform);
    if (context->display == EGL_NO_DISPLAY || !egl->Initialize(context->display, &major, &minor))
        return fail(error, LAM_UNSUPPORTED,
                    "OpenGL on %s: %s; for Mesa's drivers on Debian: apt install libegl-mesa0 libgl1-mesa-dri",
                    platform->name, egl_reason(egl));
    EGLenum api = profile == GL_PROFILE_ES ? EGL_OPENGL_ES_API : EGL_OPENGL_API;
    if (!egl->BindAPI(api))
        return fail(error, LAM_UNSUPPORTED, "OpenGL on %s: the driver does not support %s", platform->name,
                    profile_names[profile]);
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                             profile == GL_PROFILE_ES ? EGL_OPENGL_ES3_BIT_KHR : EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = NULL;
    EGLint configs = 0;
    const char *extensions = egl->QueryString(context->display, EGL_EXTENSIONS);
    if (!egl->ChooseConfig(context->display, wanted, &config, 1, &configs) || configs < 1) {
        if (!list_has(extensions, "EGL_KHR_no_config_context"))
            return fail(error, LAM_UNSUPPORTED, "OpenGL on %s: the driver has no configuration for %s", platform->name,
                        profile_names[profile]);
        config = NULL; // EGL_NO_CONFIG_KHR
        configs = 0;
    }
    context->context = create(egl, context->display, config, profile, context->debug);
    if (context->context == EGL_NO_CONTEXT)
        return fail(error, LAM_UNSUPPORTED, "OpenGL on %s: the driver cannot create a context of %s: %s",
                    platform->name, profile_names[profile], egl_reason(egl));
    if (list_has(extensions, "EGL_KHR_surfaceless_context"))
        return true;
    static const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    context->surface = configs ? egl->CreatePbufferSurface(context->display, config, size) : EGL_NO_SURFACE;
    if (context->surface == EGL_NO_SURFACE)
        return fail(error, LAM_UNSUPPORTED, "OpenGL on %s: the driver cannot create a surface without a window: %s",
                    platform->name, egl_reason(egl));
    return true;
}

static lam_gl_function from_egl(void *user, const char *name)
{
    return ((const struct egl *)user)->GetProcAddress(name);
}

bool gl_context_open(struct gl_context *context, const struct egl *egl, const struct gl_platform *platform,
                     enum gl_profile profile, bool debug, lam_error *error)
{
    *context = (struct gl_context){.egl = *egl, .debug = debug, .software = platform->software};
    EGLenum api = egl->QueryAPI();
    struct gl_previous_context previous;
    bool ok = start(context, platform, profile, error);
    if (ok && (ok = gl_context_enter(context, &previous, error))) {
        ok = gl_load(&context->gl, from_egl, &context->egl, error) && gl_context_probe(context, error);
        gl_context_leave(context, &previous);
    }
    if (!ok)
        gl_context_free(context);
    egl->BindAPI(api);
    return ok;
}

// --- choosing a device

static bool has_part(const char *text, const char *part) { return strcasestr(text, part) != NULL; }

static bool is_number(const char *text) { return *text && strspn(text, "0123456789") == strlen(text); }

static bool make_first(struct gl_context *context, const struct egl *egl, const struct gl_platform *platforms,
                       int count, const char *device, enum gl_profile profile, bool debug, lam_error *error)
{
    char reasons[300] = "", names[200] = "";
    for (int i = 0; i < count; i++) {
        lam_error why;
        if (!gl_context_open(context, egl, &platforms[i], profile, debug, &why)) {
            size_t length = strlen(reasons);
            snprintf(reasons + length, sizeof reasons - length, "%s%.250s", length ? "; " : "", why.text);
            continue;
        }
        if (!device || has_part(context->renderer, device) || has_part(context->driver, device) ||
            has_part(platforms[i].name, device))
            return true;
        size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, "%s%d: %s", length ? ", " : "", i, context->renderer);
        gl_context_free(context);
    }
    if (device && *names)
        return fail(error, LAM_UNSUPPORTED, "OpenGL: no usable device has '%s' in its name, expected one of %s", device,
                    names);
    return fail(error, LAM_UNSUPPORTED, "OpenGL: none of the %d devices is usable: %s", count, reasons);
}

bool gl_context_make(struct gl_context *context, const char *library, const char *device, enum gl_profile profile,
                     bool debug, lam_error *error)
{
    struct egl egl;
    struct gl_platform platforms[GL_PLATFORMS_MAX];
    *context = (struct gl_context){0};
    if (!egl_open(&egl, library, error))
        return false;
    int count = gl_platforms(&egl, platforms);
    if (!device || !is_number(device))
        return make_first(context, &egl, platforms, count, device, profile, debug, error);
    long number = strlen(device) < 6 ? strtol(device, NULL, 10) : count;
    if (number >= count)
        return fail(error, LAM_UNSUPPORTED, "OpenGL: there is no device %s, expected 0 to %d", device, count - 1);
    return gl_context_open(context, &egl, &platforms[number], profile, debug, error);
}

// --- the current context

bool gl_context_enter(struct gl_context *context, struct gl_previous_context *previous, lam_error *error)
{
    if (context->context == EGL_NO_CONTEXT)
        return true;
    const struct egl *egl = &context->egl;
    *previous = (struct gl_previous_context){egl->GetCurrentDisplay(), egl->GetCurrentContext(),
                                             egl->GetCurrentSurface(EGL_DRAW), egl->GetCurrentSurface(EGL_READ),
                                             egl->QueryAPI()};
    if (egl->MakeCurrent(context->display, context->surface, context->surface, context->context))
        return true;
    return fail(error, LAM_UNSUPPORTED, "OpenGL: the context cannot be made current: %s", egl_reason(egl));
}

void gl_context_leave(struct gl_context *context, const struct gl_previous_context *previous)
{
    if (context->context == EGL_NO_CONTEXT)
        return;
    const struct egl *egl = &context->egl;
    egl->MakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl->BindAPI(previous->api);
    if (previous->context != EGL_NO_CONTEXT)
        egl->MakeCurrent(previous->display, previous->draw, previous->read, previous->context);
}

// The display stays initialized, because the calling program may use the process's only display.
void gl_context_free(struct gl_context *context)
{
    if (context->surface != EGL_NO_SURFACE)
        context->egl.DestroySurface(context->display, context->surface);
    if (context->context != EGL_NO_CONTEXT)
        context->egl.DestroyContext(context->display, context->context);
    context->surface = EGL_NO_SURFACE;
    context->context = EGL_NO_CONTEXT;
}

bool gl_context_adopt(struct gl_context *context, lam_gl_get_proc *get, void *user, bool debug, lam_error *error)
{
    *context = (struct gl_context){.debug = debug};
    return gl_load(&context->gl, get, user, error) && gl_context_probe(context, error);
}

// --- implements lam_gl_devices: lists the OpenGL devices, and tries to make a context on each device.

static void try_platform(const struct egl *egl, const struct gl_platform *platform, int number, lam_gl_device *out)
{
    static const struct {
        enum gl_profile profile;
        const char *name;
    } tries[] = {{GL_PROFILE_CORE, "OpenGL 3.3"}, {GL_PROFILE_ES, "OpenGL ES 3.0"}};
    *out = (lam_gl_device){.number = number, .software = platform->software};
    snprintf(out->path, sizeof out->path, "%s", platform->name);
    for (int i = 0; i < 2; i++) {
        struct gl_context context;
        lam_error why;
        if (!gl_context_open(&context, egl, platform, tries[i].profile, false, &why)) {
            if (!*out->reason)
                snprintf(out->reason, sizeof out->reason, "%.190s", why.text);
            continue;
        }
        size_t length = strlen(out->versions);
        snprintf(out->versions + length, sizeof out->versions - length, "%s%s", length ? ", " : "", tries[i].name);
        if (!out->usable) {
            snprintf(out->name, sizeof out->name, "%s", context.renderer);
            snprintf(out->driver, sizeof out->driver, "%s", context.driver);
            out->software |= context.software;
        }
        out->usable = true;
        gl_context_free(&context);
    }
    if (out->usable)
        *out->reason = 0;
}

int lam_gl_devices(const lam_gl_params *params, lam_gl_device *devices, int capacity, lam_error *error)
{
    struct egl egl;
    struct gl_platform platforms[GL_PLATFORMS_MAX];
    if (params && !check_reserved("lam_gl_params", params, error))
        return -1;
    if (!egl_open(&egl, params ? params->library : NULL, error))
        return -1;
    int count = gl_platforms(&egl, platforms);
    for (int i = 0; i < count && i < capacity; i++)
        try_platform(&egl, &platforms[i], i, &devices[i]);
    return count;
}
