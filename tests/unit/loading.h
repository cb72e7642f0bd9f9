// loading.h: helpers for tests of model formats: makes files in memory, loads and checks them.
#ifndef LOADING_H
#define LOADING_H

#include "arena.h"

#include <lambent/lambent.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

// A file under construction.
struct made {
    uint8_t bytes[8192];
    size_t size;
    bool big; // multi-byte numbers are written big-endian
};

static inline void put(struct made *file, const void *bytes, size_t size)
{
    assert_true(file->size + size <= sizeof file->bytes);
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

static inline void put_number(struct made *file, const void *number, size_t size)
{
    const uint8_t *from = number;
    for (size_t i = 0; i < size; i++) // the tests run on little-endian machines
        put(file, from + (file->big ? size - 1 - i : i), 1);
}

static inline void put_text(struct made *file, const char *text) { put(file, text, strlen(text)); }
static inline void put_u8(struct made *file, uint8_t n) { put(file, &n, 1); }
static inline void put_u16(struct made *file, uint16_t n) { put_number(file, &n, sizeof n); }
static inline void put_u32(struct made *file, uint32_t n) { put_number(file, &n, sizeof n); }
static inline void put_f32(struct made *file, float n) { put_number(file, &n, sizeof n); }
static inline void put_f64(struct made *file, double n) { put_number(file, &n, sizeof n); }

static inline lam_scene *load_with(const void *bytes, size_t size, const char *name, const lam_load_params *params)
{
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(bytes, size, name, params, NULL, &error);
    if (!scene)
        print_error("%s\n", error.text);
    assert_non_null(scene);
    return scene;
}

static inline lam_scene *load(const struct made *file, const char *name)
{
    return load_with(file->bytes, file->size, name, NULL);
}

static inline lam_scene *load_text(const char *text, const char *name)
{
    return load_with(text, strlen(text), name, NULL);
}

// A scene with one object.
static inline lam_scene *scene_of(const lam_mesh *mesh)
{
    lam_error error = {0};
    lam_scene *scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, mesh, &error);
    if (object.mesh < 0)
        fail_msg("%s", error.text);
    assert_true(lam_scene_add_object(scene, &object, NULL) >= 0);
    return scene;
}

// Loading must fail with this code and exactly this message.
static inline void refuse(const void *bytes, size_t size, const char *name, lam_code code, const char *sentence)
{
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(bytes, size, name, NULL, NULL, &error);
    assert_null(scene);
    assert_string_equal(error.text, sentence);
    assert_int_equal(error.code, code);
}

// Loading must succeed with exactly this warning.
static inline void warn_once(const void *bytes, size_t size, const char *name, const lam_load_params *params,
                             const char *sentence)
{
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(bytes, size, name, params, NULL, &error);
    assert_string_equal(error.text, "");
    assert_non_null(scene);
    assert_non_null(lam_scene_warning(scene, 0));
    assert_string_equal(lam_scene_warning(scene, 0), sentence);
    if (lam_scene_warning(scene, 1))
        fail_msg("%s", lam_scene_warning(scene, 1));
    lam_scene_free(scene);
}

static inline void refuse_text(const char *text, const char *name, const char *sentence)
{
    refuse(text, strlen(text), name, LAM_CANNOT_READ, sentence);
}

// Corner `corner` (0 … 2) of a triangle, with the origin added.
static inline lam_vec3 corner_at(const lam_mesh *mesh, uint32_t triangle, uint32_t corner)
{
    uint32_t i = 3 * triangle + corner;
    const float *p = mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[i] : i);
    return (lam_vec3){mesh->origin[0] + (double)p[0], mesh->origin[1] + (double)p[1], mesh->origin[2] + (double)p[2]};
}

static inline void assert_corner(const lam_mesh *mesh, uint32_t triangle, uint32_t corner, double x, double y, double z)
{
    lam_vec3 p = corner_at(mesh, triangle, corner);
    assert_true(p.x == x && p.y == y && p.z == z);
}

static inline void assert_near(double found, double expected, double tolerance)
{
    if (!(found >= expected - tolerance && found <= expected + tolerance))
        fail_msg("found %.17g, expected %.17g within %g", found, expected, tolerance);
}

static inline bool same_array(const void *a, const void *b, size_t bytes)
{
    return (!a && !b) || (a && b && memcmp(a, b, bytes) == 0);
}

// All data that a file provides, bit by bit.
static inline void assert_same_mesh(const lam_mesh *a, const lam_mesh *b)
{
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->normal_count, b->normal_count);
    assert_int_equal(a->color_count, b->color_count);
    assert_int_equal(a->colors_format, b->colors_format);
    assert_int_equal(a->part_count, b->part_count);
    size_t corners = 3 * (size_t)a->triangle_count, vertices = a->vertex_count;
    size_t color_size = a->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4;
    assert_memory_equal(a->origin, b->origin, sizeof a->origin);
    assert_true(same_array(a->positions, b->positions, 12 * vertices));
    assert_true(same_array(a->indices, b->indices, 4 * corners));
    assert_true(same_array(a->normals, b->normals, 12 * (size_t)a->normal_count));
    assert_true(same_array(a->normal_indices, b->normal_indices, 4 * corners));
    assert_true(same_array(a->texcoords, b->texcoords, 8 * (size_t)a->texcoord_count));
    assert_true(same_array(a->tangents, b->tangents, 16 * (size_t)a->tangent_count));
    assert_true(same_array(a->colors, b->colors, color_size * a->color_count));
}

// The same file gives the same mesh with 1, 2 and 5 threads.
static inline void assert_same_for_threads(const void *bytes, size_t size, const char *name)
{
    lam_scene *one = load_with(bytes, size, name, &(lam_load_params){.threads = 1});
    for (int threads = 2; threads <= 5; threads += 3) {
        lam_scene *more = load_with(bytes, size, name, &(lam_load_params){.threads = threads});
        assert_same_mesh(lam_scene_mesh(one, 0), lam_scene_mesh(more, 0));
        lam_scene_free(more);
    }
    lam_scene_free(one);
}

// A file truncated anywhere either loads or is refused with an error message.
static inline void check_prefixes(const void *bytes, size_t size, const char *name)
{
    for (size_t length = 0; length <= size; length++) {
        lam_error error = {0};
        lam_scene *scene = lam_scene_load_memory(bytes, length, name, &(lam_load_params){.threads = 1}, NULL, &error);
        assert_true(scene || (error.code && error.text[0]));
        assert_true(scene || length < size);
        lam_scene_free(scene);
    }
}

// Each allocation fails once: loading is refused because of memory, or did not need it; nothing leaks.
static inline void check_allocations(const void *bytes, size_t size, const char *name)
{
    int refused = 0, in_a_row = 0;
    for (long countdown = 0; in_a_row < 10; countdown++) {
        assert_true(countdown < 1000);
        lam_error error = {0};
        arena_fail_after(countdown);
        lam_scene *scene = lam_scene_load_memory(bytes, size, name, &(lam_load_params){.threads = 1}, NULL, &error);
        arena_fail_after(-1);
        if (!scene)
            assert_int_equal(error.code, LAM_MACHINE);
        refused += !scene;
        in_a_row = scene ? in_a_row + 1 : 0;
        lam_scene_free(scene);
    }
    assert_true(refused >= 3);
}

// One row of the shared models' table.
struct model {
    const char *path;
    uint32_t triangles;
};

// Every model of the list has the number of triangles in its table. The test is skipped if the models are missing.
static inline void check_models(const struct model *models, size_t count)
{
    const char *folder = getenv("LAMBENT_MODELS");
    char path[1024];
    if (!folder)
        folder = "../shared/models";
    snprintf(path, sizeof path, "%s/%s", folder, models[0].path);
    FILE *there = fopen(path, "rb");
    if (!there) {
        print_message("%s is not there: the shared models are not tested\n", path);
        skip();
        return;
    }
    fclose(there);
    for (size_t i = 0; i < count; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, models[i].path);
        lam_error error = {0};
        lam_scene *scene = lam_scene_load(path, NULL, NULL, &error);
        if (!scene && models[i].triangles > 0)
            print_error("%s\n", error.text);
        assert_int_equal(scene != NULL, models[i].triangles > 0); // a model without triangles is refused
        if (scene)
            assert_int_equal(lam_scene_triangle_count(scene), models[i].triangles);
        else
            assert_non_null(strstr(error.text, "no triangles"));
        lam_scene_free(scene);
    }
}

#endif
