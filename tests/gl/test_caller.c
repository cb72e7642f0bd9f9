// test_caller.c: the OpenGL device in the caller's context. The caller's get_proc_address counts draw calls: one for each
// material of a mesh. A draw restores the caller's state.
#include "context.h"
#include "scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct gl_context context; // the caller's
static struct gl real;
static int drawn;

#define COUNT(name, parameters, arguments)                                                                             \
    static void APIENTRY count_##name parameters                                                                       \
    {                                                                                                                  \
        drawn++;                                                                                                       \
        real.name arguments;                                                                                           \
    }
COUNT(DrawArrays, (GLenum a, GLint b, GLsizei c), (a, b, c))
COUNT(DrawElements, (GLenum a, GLsizei b, GLenum c, const void *d), (a, b, c, d))

static lam_gl_function counting(void *user, const char *name)
{
    (void)user;
#define ROW(function)                                                                                                  \
    if (strcmp(name, "gl" #function) == 0) {                                                                           \
        real.function = context.gl.function;                                                                           \
        return (lam_gl_function)count_##function;                                                                      \
    }
    ROW(DrawArrays)
    ROW(DrawElements)
#undef ROW
    return context.egl.GetProcAddress(name);
}

static struct gl_previous_context previous;

static lam_device *start(enum gl_profile profile)
{
    lam_error error = {0};
    if (!gl_context_make(&context, NULL, NULL, profile, false, &error)) {
        print_message("%s\n", error.text);
        skip();
    }
    assert_true(gl_context_enter(&context, &previous, &error));
    lam_gl_params params = {.get_proc_address = counting};
    lam_device *device = lam_device_gl(&params, &error);
    if (!device)
        fail_msg("%s", error.text);
    return device;
}

static void stop(lam_device *device)
{
    lam_device_free(device);
    assert_int_equal(context.gl.GetError(), GL_NO_ERROR);
    gl_context_leave(&context, &previous);
    gl_context_free(&context);
}

static void build(const char *name, struct demo *demo)
{
    lam_error error = {0};
    if (!demo_build_named(name, demo, &error))
        fail_msg("%s", error.text);
}

// A mesh whose parts alternate between materials has one draw call for each material.
static void test_one_call(void **state)
{
    (void)state;
    lam_device *device = start(GL_PROFILE_ES);
    lam_error error = {0};
    struct demo demo = {.width = 64, .height = 64, .scene = lam_scene_make(&error)};
    enum { STRIPS = 64 };
    float positions[3 * (2 * STRIPS + 2)], normals[3 * (2 * STRIPS + 2)];
    uint32_t indices[6 * STRIPS];
    lam_part parts[STRIPS];
    for (int i = 0; i <= STRIPS; i++)
        for (int k = 0; k < 2; k++) {
            memcpy(positions + 3 * (2 * i + k), (float[3]){(float)i / 32 - 1, (float)(2 * k - 1), 0}, 12);
            memcpy(normals + 3 * (2 * i + k), (float[3]){0, 0, 1}, 12);
        }
    for (uint32_t i = 0; i < STRIPS; i++) {
        const uint32_t quad[6] = {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3};
        memcpy(indices + 6 * i, quad, sizeof quad);
        parts[i] = (lam_part){.first_triangle = 2 * i, .triangle_count = 2, .material = (int)i % 3};
    }
    lam_mesh mesh = {.positions = positions,
                     .vertex_count = 2 * STRIPS + 2,
                     .indices = indices,
                     .triangle_count = 2 * STRIPS,
                     .normals = normals,
                     .normal_count = 2 * STRIPS + 2,
                     .parts = parts,
                     .part_count = STRIPS};
    for (int i = 0; i < 3; i++) {
        lam_material m = lam_material_default();
        m.diffuse = (lam_rgba){i == 0, i == 1, i == 2, 1};
        m.ambient = (lam_rgb){0};
        lam_scene_add_material(demo.scene, &m, &error);
    }
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(demo.scene, &mesh, &error);
    assert_true(lam_scene_add_object(demo.scene, &object, &error) >= 0);
    lam_view view = {.from_angles = true};
    demo.camera = lam_camera_fit(demo.scene, 64, 64, &view);
    lam_device *cpu = lam_device_cpu(NULL, &error);
    for (int method = 0; method < 5; method++) {
        lam_draw_params params = {.samples = 1, .occlusion = LAM_OCCLUSION_OFF}; // which first draws the distances
        params.shading = method == 0 ? LAM_SHADING_PHONG : method < 3 ? LAM_SHADING_GOURAUD : LAM_SHADING_FLAT;
        params.stage = method == 1 || method == 3 ? LAM_STAGE_APPLICATION : LAM_STAGE_AUTO;
        lam_image a = {0}, b = {0};
        lam_difference difference;
        assert_true(lam_image_make(&a, 64, 64, LAM_RGBA8, &error) && lam_image_make(&b, 64, 64, LAM_RGBA8, &error));
        assert_true(lam_draw(cpu, demo.scene, &demo.camera, &params, &a, NULL, &error));
        drawn = 0;
        assert_true(lam_draw(device, demo.scene, &demo.camera, &params, &b, NULL, &error));
        assert_int_equal(drawn, 3);
        assert_true(lam_image_compare(&a, &b, &difference, &error));
        assert_true(difference.share_over_1 <= 0.001);
        params.output = LAM_OUTPUT_IDS;
        assert_true(lam_draw(cpu, demo.scene, &demo.camera, &params, &a, NULL, &error));
        assert_true(lam_draw(device, demo.scene, &demo.camera, &params, &b, NULL, &error));
        assert_true(lam_image_compare(&a, &b, &difference, &error));
        assert_true(difference.share_over_1 <= 0.001);
        lam_image_free(&a);
        lam_image_free(&b);
    }
    lam_device_free(cpu);
    lam_scene_free(demo.scene);
    stop(device);
}

// State that a caller may have set, and that can be queried.
static const GLenum queried[] = {GL_CURRENT_PROGRAM,
                                 GL_VERTEX_ARRAY_BINDING,
                                 GL_DRAW_FRAMEBUFFER_BINDING,
                                 GL_READ_FRAMEBUFFER_BINDING,
                                 GL_ACTIVE_TEXTURE,
                                 GL_ARRAY_BUFFER_BINDING,
                                 GL_UNIFORM_BUFFER_BINDING,
                                 GL_DEPTH_FUNC,
                                 GL_CULL_FACE_MODE,
                                 GL_FRONT_FACE,
                                 GL_BLEND_SRC_RGB,
                                 GL_BLEND_DST_ALPHA,
                                 GL_BLEND_EQUATION_RGB,
                                 GL_DEPTH_WRITEMASK,
                                 GL_UNPACK_ALIGNMENT,
                                 GL_PACK_ROW_LENGTH,
                                 GL_PIXEL_PACK_BUFFER_BINDING};
static const GLenum switched[] = {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST};
enum {
    QUERIED = sizeof queried / sizeof *queried,
    SWITCHED = sizeof switched / sizeof *switched,
    VALUES = QUERIED + SWITCHED + 8
};

static void query(const struct gl *gl, GLint out[VALUES])
{
    int n = 0;
    for (int i = 0; i < QUERIED; i++)
        gl->GetIntegerv(queried[i], &out[n++]);
    for (int i = 0; i < SWITCHED; i++)
        out[n++] = gl->IsEnabled(switched[i]);
    gl->GetIntegerv(GL_VIEWPORT, &out[n]);
    n += 4;
    GLint unit;
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    for (GLuint i = 0; i < 2; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &out[n++]);
    }
    gl->ActiveTexture((GLenum)unit);
    gl->GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 1, &out[n++]);
    gl->GetIntegeri_v(GL_UNIFORM_BUFFER_SIZE, 1, &out[n++]);
}

static void test_callers_state(void **state)
{
    (void)state;
    for (int profile = 0; profile < GL_PROFILE_COUNT; profile++) {
        lam_device *device = start((enum gl_profile)profile);
        const struct gl *gl = &context.gl;
        GLuint texture, buffer, array;
        gl->GenTextures(1, &texture);
        gl->GenBuffers(1, &buffer);
        gl->GenVertexArrays(1, &array);
        gl->BindVertexArray(array);
        gl->ActiveTexture(GL_TEXTURE1);
        gl->BindTexture(GL_TEXTURE_2D, texture);
        gl->BindBuffer(GL_UNIFORM_BUFFER, buffer);
        gl->BufferData(GL_UNIFORM_BUFFER, 1024, NULL, GL_STATIC_DRAW);
        gl->BindBufferRange(GL_UNIFORM_BUFFER, 1, buffer, 256, 64);
        gl->Enable(GL_BLEND);
        gl->Enable(GL_SCISSOR_TEST);
        gl->Enable(GL_STENCIL_TEST);
        gl->Enable(GL_CULL_FACE);
        gl->Scissor(1, 1, 2, 2);
        gl->CullFace(GL_FRONT);
        gl->FrontFace(GL_CW);
        gl->BlendFunc(GL_DST_COLOR, GL_ZERO);
        gl->BlendEquation(GL_FUNC_SUBTRACT);
        gl->DepthFunc(GL_GREATER);
        gl->DepthMask(GL_FALSE);
        gl->ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
        gl->Viewport(3, 5, 7, 9);
        gl->PixelStorei(GL_PACK_ROW_LENGTH, 77);
        gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        if (profile != GL_PROFILE_ES)
            gl->PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        GLint before[VALUES], after[VALUES];
        query(gl, before);
        lam_error error = {0};
        lam_device *cpu = lam_device_cpu(NULL, &error);
        static const char *const names[] = {"translucent", "mirror-sky"};
        for (int n = 0; n < 2; n++) {
            struct demo demo;
            build(names[n], &demo);
            lam_draw_params params = demo.params;
            params.samples = 1;
            lam_image a = {0}, b = {0};
            lam_difference difference;
            assert_true(lam_image_make(&a, 160, 120, LAM_RGBA8, &error) &&
                        lam_image_make(&b, 160, 120, LAM_RGBA8, &error));
            for (int again = 0; again < 2; again++) {
                assert_true(lam_draw(device, demo.scene, &demo.camera, &params, &a, NULL, &error));
                assert_true(lam_draw(cpu, demo.scene, &demo.camera, &params, &b, NULL, &error));
                assert_true(lam_image_compare(&a, &b, &difference, &error));
                assert_true(difference.share_over_1 <= 0.001);
                query(gl, after);
                for (int i = 0; i < VALUES; i++)
                    if (before[i] != after[i])
                        fail_msg("profile %d: state %d is %d, expected %d", profile, i, after[i], before[i]);
            }
            lam_image_free(&a);
            lam_image_free(&b);
            lam_scene_free(demo.scene);
        }
        lam_device_free(cpu);
        gl->BindVertexArray(0);
        stop(device);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_one_call), cmocka_unit_test(test_callers_state)};
    return cmocka_run_group_tests_name("gl-caller", tests, NULL, NULL);
}
