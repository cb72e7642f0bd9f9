// context_probe.c: queries a context's version, names and extensions, and collects the driver's debug messages.
#include "context.h"

#include "fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

bool gl_context_probe(struct gl_context *context, lam_error *error)
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
