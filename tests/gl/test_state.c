// test_state.c: the OpenGL calls of the device. A frame of an unchanged scene creates no objects, uploads nothing, and
// sets no state or uniform to its current value; after a change only the changed data are uploaded. The context reports
// errors and performance warnings, and either makes the frame fail.
#include "device_or_skip.h"
#include "floor_scene.h"
#include "gl_device.h"
#include "scenes.h"
#include "texture_levels.h"

#include <lambent/light.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct gl real;
static int created, uploaded, drawn, calls, again; // `again` counts state that is set to its current value
static char first_again[64];

// --- the last value of each state

enum state {
    STATE_PROGRAM,
    STATE_ARRAY,
    STATE_FRAMEBUFFER,
    STATE_UNIT,
    STATE_TEXTURE, // for a unit and a target
    STATE_BUFFER,  // for a target
    STATE_BLOCK,   // for a point
    STATE_SWITCH,  // for a capability
    STATE_BLEND,
    STATE_CULLED,
    STATE_FRONT,
    STATE_VIEWPORT,
    STATE_PIXELS,
    STATE_UNIFORM, // for a program and a location
};

static struct known {
    enum state state;
    uint64_t of, value;
} known[4096];
static int known_count;
static GLuint current_program, current_unit;

static uint64_t hash(const void *bytes, size_t count)
{
    uint64_t h = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < count; i++)
        h = (h ^ ((const uint8_t *)bytes)[i]) * UINT64_C(0x100000001b3);
    return h;
}

static void set(const char *name, enum state state, uint64_t of, const void *value, size_t size)
{
    uint64_t h = hash(value, size);
    calls++;
    for (int i = 0; i < known_count; i++)
        if (known[i].state == state && known[i].of == of) {
            if (known[i].value == h && !again++)
                snprintf(first_again, sizeof first_again, "gl%s of %llu", name, (unsigned long long)of);
            known[i].value = h;
            return;
        }
    assert_true(known_count < 4096);
    known[known_count++] = (struct known){state, of, h};
}

#define SETS(name, state, of, parameters, arguments)                                                                   \
    static void APIENTRY record_##name parameters                                                                      \
    {                                                                                                                  \
        const uint64_t value[] = {VALUE arguments};                                                                    \
        set(#name, state, of, value, sizeof value);                                                                    \
        real.name arguments;                                                                                           \
    }
#define VALUE(...) __VA_ARGS__
SETS(BlendFunc, STATE_BLEND, 0, (GLenum a, GLenum b), (a, b))
SETS(CullFace, STATE_CULLED, 0, (GLenum a), (a))
SETS(FrontFace, STATE_FRONT, 0, (GLenum a), (a))
SETS(BindVertexArray, STATE_ARRAY, 0, (GLuint a), (a))
SETS(BindFramebuffer, STATE_FRAMEBUFFER, a, (GLenum a, GLuint b), (a, b))
SETS(BindBuffer, STATE_BUFFER, a, (GLenum a, GLuint b), (a, b))
SETS(BindTexture, STATE_TEXTURE, (uint64_t)current_unit << 32 | a, (GLenum a, GLuint b), (a, b))
#undef SETS

static void APIENTRY record_UseProgram(GLuint a)
{
    set("UseProgram", STATE_PROGRAM, 0, &a, sizeof a);
    real.UseProgram(current_program = a);
}
static void APIENTRY record_ActiveTexture(GLenum a)
{
    set("ActiveTexture", STATE_UNIT, 0, &a, sizeof a);
    real.ActiveTexture(current_unit = a);
}
static void APIENTRY record_Viewport(GLint a, GLint b, GLsizei c, GLsizei d)
{
    const int value[] = {a, b, c, d};
    set("Viewport", STATE_VIEWPORT, 0, value, sizeof value);
    real.Viewport(a, b, c, d);
}
static void APIENTRY record_PixelStorei(GLenum a, GLint b)
{
    set("PixelStorei", STATE_PIXELS, a, &b, sizeof b);
    real.PixelStorei(a, b);
}
static void APIENTRY record_Enable(GLenum a)
{
    set("Enable", STATE_SWITCH, a, &(int){1}, sizeof(int));
    real.Enable(a);
}
static void APIENTRY record_Disable(GLenum a)
{
    set("Disable", STATE_SWITCH, a, &(int){0}, sizeof(int));
    real.Disable(a);
}
static void APIENTRY record_BindBufferRange(GLenum a, GLuint b, GLuint c, GLintptr d, GLsizeiptr e)
{
    const int64_t value[] = {c, d, e};
    set("BindBufferRange", STATE_BLOCK, b, value, sizeof value);
    real.BindBufferRange(a, b, c, d, e);
}

#define UNIFORM(name, parameters, arguments, value, bytes)                                                             \
    static void APIENTRY record_##name parameters                                                                      \
    {                                                                                                                  \
        set(#name, STATE_UNIFORM, (uint64_t)current_program << 32 | (uint32_t)at, value, bytes);                       \
        real.name arguments;                                                                                           \
    }
UNIFORM(Uniform1f, (GLint at, GLfloat b), (at, b), &b, sizeof b)
UNIFORM(Uniform1i, (GLint at, GLint b), (at, b), &b, sizeof b)
UNIFORM(Uniform4fv, (GLint at, GLsizei n, const GLfloat *c), (at, n, c), c, (size_t)n * 16)
UNIFORM(UniformMatrix3fv, (GLint at, GLsizei n, GLboolean t, const GLfloat *d), (at, n, t, d), d, (size_t)n * 36)
UNIFORM(UniformMatrix4fv, (GLint at, GLsizei n, GLboolean t, const GLfloat *d), (at, n, t, d), d, (size_t)n * 64)

#define COUNT(name, counter, parameters, arguments)                                                                    \
    static void APIENTRY record_##name parameters                                                                      \
    {                                                                                                                  \
        counter++;                                                                                                     \
        calls++;                                                                                                       \
        real.name arguments;                                                                                           \
    }
COUNT(BufferData, created, (GLenum a, GLsizeiptr b, const void *c, GLenum d), (a, b, c, d))
COUNT(GenBuffers, created, (GLsizei a, GLuint *b), (a, b))
COUNT(GenTextures, created, (GLsizei a, GLuint *b), (a, b))
COUNT(GenVertexArrays, created, (GLsizei a, GLuint *b), (a, b))
COUNT(GenFramebuffers, created, (GLsizei a, GLuint *b), (a, b))
COUNT(GenQueries, created, (GLsizei a, GLuint *b), (a, b))
COUNT(TexImage2D, created,
      (GLenum a, GLint b, GLint c, GLsizei d, GLsizei e, GLint f, GLenum g, GLenum h, const void *i),
      (a, b, c, d, e, f, g, h, i))
COUNT(TexImage3D, created,
      (GLenum a, GLint b, GLint c, GLsizei d, GLsizei e, GLsizei f, GLint g, GLenum h, GLenum i, const void *j),
      (a, b, c, d, e, f, g, h, i, j))
COUNT(LinkProgram, created, (GLuint a), (a))
COUNT(BufferSubData, uploaded, (GLenum a, GLintptr b, GLsizeiptr c, const void *d), (a, b, c, d))
COUNT(TexSubImage2D, uploaded,
      (GLenum a, GLint b, GLint c, GLint d, GLsizei e, GLsizei f, GLenum g, GLenum h, const void *i),
      (a, b, c, d, e, f, g, h, i))
COUNT(DrawArrays, drawn, (GLenum a, GLint b, GLsizei c), (a, b, c))
COUNT(DrawElements, drawn, (GLenum a, GLsizei b, GLenum c, const void *d), (a, b, c, d))

static lam_device *start(lam_gl_api api)
{
    lam_device *device = device_or_skip(api);
    struct gl *gl = &((struct gl_device *)device)->context.gl;
    real = *gl;
    known_count = 0;
#define RECORD(name) gl->name = record_##name;
    RECORD(BlendFunc)
    RECORD(CullFace)
    RECORD(FrontFace)
    RECORD(BindVertexArray)
    RECORD(BindFramebuffer)
    RECORD(BindBuffer)
    RECORD(BindTexture)
    RECORD(UseProgram)
    RECORD(ActiveTexture)
    RECORD(Viewport)
    RECORD(PixelStorei)
    RECORD(Enable)
    RECORD(Disable)
    RECORD(BindBufferRange)
    RECORD(Uniform1f)
    RECORD(Uniform1i)
    RECORD(Uniform4fv)
    RECORD(UniformMatrix3fv)
    RECORD(UniformMatrix4fv)
    RECORD(BufferData)
    RECORD(GenBuffers)
    RECORD(GenTextures)
    RECORD(GenVertexArrays)
    RECORD(GenFramebuffers)
    RECORD(GenQueries)
    RECORD(TexImage2D)
    RECORD(TexImage3D)
    RECORD(LinkProgram)
    RECORD(BufferSubData)
    RECORD(TexSubImage2D)
    RECORD(DrawArrays)
    RECORD(DrawElements)
#undef RECORD
    return device;
}

static void build(const char *name, struct demo *demo)
{
    lam_error error = {0};
    if (!demo_build_named(name, demo, &error))
        fail_msg("%s", error.text);
}

static lam_frame_report frame(lam_device *device, const struct demo *demo, const lam_draw_params *params)
{
    lam_image image = {0};
    lam_error error = {0};
    created = uploaded = drawn = calls = again = 0;
    if (!lam_image_make(&image, 64, 48, LAM_RGBA8, &error) ||
        !lam_draw(device, demo->scene, &demo->camera, params, &image, NULL, &error))
        fail_msg("%s", error.text);
    lam_image_free(&image);
    lam_frame_report report;
    lam_device_report(device, &report);
    return report;
}

static void test_unchanged(void **state)
{
    (void)state;
    static const char *const names[] = {"lights", "translucent", "mirror-gouraud", "two-sides-mirrored", "culled-back"};
    static const lam_stage stages[] = {LAM_STAGE_APPLICATION, LAM_STAGE_VERTEX, LAM_STAGE_FRAGMENT};
    for (int api = 0; api < 2; api++) {
        lam_device *device = start(api ? LAM_GL_ES : LAM_GL_CORE);
        for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
            struct demo demo;
            build(names[n], &demo);
            for (int method = 0; method < 3; method++) {
                lam_draw_params params = demo.params;
                params.samples = api ? 4 : 1;
                params.occlusion = LAM_OCCLUSION_OFF; // which is uploaded again for each frame
                params.stage = stages[method];
                params.shading = method == 2 ? LAM_SHADING_PHONG : LAM_SHADING_GOURAUD;
                frame(device, &demo, &params);
                assert_true(drawn > 0 && (created > 0 || method > 0));
                lam_frame_report second = frame(device, &demo, &params), third = frame(device, &demo, &params);
                if (created || uploaded || again || third.bytes_uploaded || third.points_lit)
                    fail_msg("%s, stage %d: %d created, %d uploaded, %d set again (%s), %llu bytes", names[n], method,
                             created, uploaded, again, first_again, (unsigned long long)third.bytes_uploaded);
                assert_int_equal(third.memory_bytes, second.memory_bytes);
            }
            print_message("%-20s unchanged: %d draw calls, %d state calls\n", names[n], drawn, calls - drawn);
            lam_scene_free(demo.scene);
        }
        lam_device_free(device);
    }
}

// The colours of the stage `application` are uploaded again only after one of their inputs has changed; the other stages
// upload lights and materials only.
static void test_changed(void **state)
{
    (void)state;
    lam_device *device = start(LAM_GL_CORE);
    lam_error error = {0};
    for (int vertex = 0; vertex < 2; vertex++) {
        struct demo demo;
        build("lights", &demo);
        lam_draw_params params = demo.params;
        params.samples = 1;
        params.shading = LAM_SHADING_GOURAUD;
        params.stage = vertex ? LAM_STAGE_VERTEX : LAM_STAGE_APPLICATION;
        frame(device, &demo, &params);
        uint64_t all = 0; // points lit when all colours are uploaded
        for (int change = 0; change < 6; change++) {
            lam_material m = *lam_scene_material(demo.scene, 0);
            lam_object o = *lam_scene_object(demo.scene, 0);
            lam_light l = *lam_scene_light(demo.scene, 0);
            bool lit = true;
            switch (change) {
            case 0:
                params.exposure = 1; // applied after the lighting
                lit = false;
                break;
            case 1:
                demo.camera.eye.x += 0.25;
                break;
            case 2:
                l.ambient.r += 0.125f;
                l.diffuse.r += 0.125f;
                assert_true(lam_scene_set_light(demo.scene, 0, &l, &error));
                break;
            case 3:
                m.diffuse.g *= 0.5f;
                assert_true(lam_scene_set_material(demo.scene, 0, &m, &error));
                break;
            case 5:
                o.transform.m[0][3] += 0.25;
                assert_true(lam_scene_set_object(demo.scene, 0, &o, &error));
                break;
            default:
                params.reflection = LAM_REFLECTION_PHONG;
                break;
            }
            lam_frame_report report = frame(device, &demo, &params);
            all = change == 1 ? report.points_lit : all;
            uint64_t colors = 4 * sizeof(float) * report.points_lit;
            if (!lit)
                assert_int_equal(report.bytes_uploaded, 0);
            else if (vertex && change > 3)
                assert_int_equal(report.bytes_uploaded, 0); // another program, or a uniform
            else if (vertex)
                assert_true(report.bytes_uploaded > 0 && report.bytes_uploaded < 20000); // lights and products
            else
                assert_int_equal(report.bytes_uploaded, colors);
            if (!vertex && change == 5) // the plane's colours are still valid
                assert_true(report.points_lit > 0 && report.points_lit < all);
            else if (!vertex && lit)
                assert_true(report.points_lit > 0 && report.points_lit == all);
        }
        lam_scene_free(demo.scene);
    }
    lam_device_free(device);
}

static EGLBoolean EGLAPIENTRY refuse_current(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context)
{
    (void)display, (void)draw, (void)read, (void)context;
    return EGL_FALSE;
}

// A device whose context can no longer be made current frees its memory, and the texture then belongs only to the test.
static void test_lost_context(void **state)
{
    (void)state;
    lam_device *device = start(LAM_GL_CORE);
    lam_texture *texture = random_texture(8, 8, 1);
    lam_texture_map map = {.texture = texture};
    lam_scene *scene = floor_scene(&map);
    lam_image image = floor_draw(device, scene, 16, 1, &(lam_draw_params){0});
    lam_image_free(&image);
    lam_scene_free(scene);
    assert_true(texture->references > 1);
    ((struct gl_device *)device)->context.egl.MakeCurrent = refuse_current;
    lam_device_free(device);
    assert_int_equal(texture->references, 1);
    lam_texture_free(texture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_unchanged), cmocka_unit_test(test_changed),
                                       cmocka_unit_test(test_lost_context)};
    return cmocka_run_group_tests_name("gl-state", tests, NULL, NULL);
}
