// test_parts.c: large files read part by part give the same result as files read as a whole.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/lambent.h>

enum { SIDE = 260, VERTICES = SIDE * SIDE, FACES = 2 * (SIDE - 1) * (SIDE - 1) };

static char path[] = "/tmp/lambent-parts-XXXXXX";
static uint8_t *bytes;
static size_t size, body, faces_begin;

static void append(const void *data, size_t count)
{
    memcpy(bytes + size, data, count);
    size += count;
}

static void point(int i, float p[3])
{
    p[0] = (float)(i % SIDE) * 0.1f;
    p[1] = (float)(i / SIDE) * 0.1f;
    p[2] = (float)(i * 37 % 101) * 0.003f;
}

static void face(int f, uint32_t out[3])
{
    uint32_t a = (uint32_t)(f / 2 / (SIDE - 1) * SIDE + f / 2 % (SIDE - 1));
    const uint32_t corners[2][3] = {{a, a + 1, a + SIDE}, {a + 1, a + SIDE + 1, a + SIDE}};
    memcpy(out, corners[f % 2], 12);
}

static void make_ply(const char *more_properties, size_t more_bytes, const char *list)
{
    char header[600];
    size = 0;
    int length =
        snprintf(header, sizeof header,
                 "ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                 "property float z\n%selement face %d\nproperty %s\nend_header\n",
                 VERTICES, more_properties, FACES, list);
    append(header, (size_t)length);
    body = size;
    for (int i = 0; i < VERTICES; i++) {
        float p[3];
        point(i, p);
        append(p, 12);
        for (size_t k = 0; k < more_bytes; k++)
            bytes[size++] = (uint8_t)(i * 7 + (int)k * 50);
    }
    faces_begin = size;
    for (int f = 0; f < FACES; f++) {
        uint32_t corners[3];
        face(f, corners);
        bytes[size++] = 3;
        append(corners, 12);
    }
}

static void make_stl(uint16_t word)
{
    char header[80] = "test";
    uint32_t count = FACES;
    size = 0;
    append(header, 80);
    append(&count, 4);
    body = size;
    for (int f = 0; f < FACES; f++) {
        float p[4][3] = {{0}};
        uint32_t corners[3];
        face(f, corners);
        for (int k = 0; k < 3; k++)
            point((int)corners[k], p[k + 1]);
        append(p, 48);
        append(&word, 2);
    }
}

static void write_file(void)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

// Loads the file, and its bytes under the same name; both scenes, or both errors, are equal. Returns whether it loaded.
static bool load_both(void)
{
    write_file();
    bool loaded = false;
    for (int threads = 1; threads <= 3; threads += 2) {
        lam_error errors[2] = {0};
        lam_load_params params = {.threads = threads};
        lam_scene *scenes[2] = {lam_scene_load(path, &params, NULL, &errors[0]),
                                lam_scene_load_memory(bytes, size, path, &params, NULL, &errors[1])};
        assert_int_equal(scenes[0] != NULL, scenes[1] != NULL);
        loaded = scenes[0] != NULL;
        if (!loaded) {
            assert_int_equal(errors[0].code, errors[1].code);
            assert_string_equal(errors[0].text, errors[1].text);
            continue;
        }
        const lam_mesh *a = lam_scene_mesh(scenes[0], 0), *b = lam_scene_mesh(scenes[1], 0);
        assert_int_equal(a->vertex_count, b->vertex_count);
        assert_int_equal(a->triangle_count, b->triangle_count);
        assert_memory_equal(a->positions, b->positions, 12 * (size_t)a->vertex_count);
        assert_memory_equal(a->origin, b->origin, sizeof a->origin);
        assert_int_equal(a->indices != NULL, b->indices != NULL);
        if (a->indices)
            assert_memory_equal(a->indices, b->indices, 12 * (size_t)a->triangle_count);
        assert_int_equal(a->colors_format, b->colors_format);
        assert_int_equal(a->colors_rate, b->colors_rate);
        assert_int_equal(a->color_count, b->color_count);
        if (a->colors)
            assert_memory_equal(a->colors, b->colors, 4 * (size_t)a->color_count);
        assert_int_equal(a->normal_count, b->normal_count);
        assert_memory_equal(a->normals, b->normals, 12 * (size_t)a->normal_count);
        assert_string_equal(lam_scene_format(scenes[0]), lam_scene_format(scenes[1]));
        assert_int_equal(lam_scene_up(scenes[0]), lam_scene_up(scenes[1]));
        assert_int_equal(lam_scene_object_count(scenes[0]), 1);
        for (int k = 0; k < 2; k++)
            lam_scene_free(scenes[k]);
    }
    return loaded;
}

// Whether the file can be loaded within a memory limit that has no room for both the whole file and the result.
static bool fits(size_t kept)
{
    lam_error error;
    lam_scene *scene = lam_scene_load(path, &(lam_load_params){.normals_when_drawn = true, .threads = 2},
                                      &(lam_control){.memory_limit_bytes = kept + size / 4 * 3}, &error);
    lam_scene_free(scene);
    return scene != NULL;
}

static const char *const usual_list = "list uchar int vertex_indices";

static void plain_files(void **state)
{
    (void)state;
    make_ply("", 0, usual_list);
    assert_true(size > 1 << 20);
    assert_true(load_both());
    assert_true(fits(12 * (VERTICES + FACES)));
    make_ply("", 0, "list uchar uint vertex_index");
    assert_true(load_both());
    assert_true(fits(12 * (VERTICES + FACES)));
    make_stl(0);
    assert_true(load_both());
    assert_true(fits(36 * FACES));
}

static void files_with_more_in_them(void **state)
{
    (void)state;
    make_ply("property uchar red\nproperty uchar green\nproperty uchar blue\n", 3, usual_list);
    assert_true(load_both());
    make_ply("property float nx\nproperty float ny\nproperty float nz\n", 12, usual_list);
    assert_true(load_both());
    make_ply("property uchar quality\nproperty list uchar uchar tags\n", 0, usual_list); // too short then
    assert_false(load_both());
    make_stl(0x8123); // colours
    assert_true(load_both());
    make_stl(0);
    memcpy(bytes + 20, "COLOR=abc", 10);
    assert_true(load_both());
}

static void errors_are_those_of_whole_files(void **state)
{
    (void)state;
    static const float nan_bits = __builtin_nanf("");
    make_ply("", 0, usual_list);
    memcpy(bytes + body + (size_t)12 * 50000 + 4, &nan_bits, 4);
    assert_false(load_both());
    make_ply("", 0, usual_list);
    uint32_t beyond = VERTICES;
    memcpy(bytes + faces_begin + (size_t)13 * 100000 + 5, &beyond, 4);
    assert_false(load_both());
    make_ply("", 0, usual_list);
    bytes[faces_begin + (size_t)13 * 100000] = 4;
    load_both();
    make_ply("", 0, usual_list);
    size -= 5;
    assert_false(load_both());
    make_ply("", 0, usual_list);
    size += 5; // more data after the end
    assert_true(load_both());
    make_stl(0);
    float infinite = __builtin_inff();
    memcpy(bytes + body + (size_t)50 * 70000 + 20, &infinite, 4);
    assert_false(load_both());
    make_stl(0);
    size -= 20;
    assert_false(load_both());
}

static void can_be_stopped(void **state)
{
    (void)state;
    make_ply("", 0, usual_list);
    write_file();
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    lam_error error;
    assert_null(lam_scene_load(path, NULL, &(lam_control){.cancel = &cancel}, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_null(lam_scene_load(path, NULL, &(lam_control){.memory_limit_bytes = 1 << 20}, &error));
    assert_int_equal(error.code, LAM_LIMIT);
}

static int start(void **state)
{
    (void)state;
    bytes = calloc(1, 16 << 20);
    int file = mkstemp(path);
    return bytes && file >= 0 && close(file) == 0 ? 0 : -1;
}

static int stop(void **state)
{
    (void)state;
    free(bytes);
    return unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_files),
        cmocka_unit_test(files_with_more_in_them),
        cmocka_unit_test(errors_are_those_of_whole_files),
        cmocka_unit_test(can_be_stopped),
    };
    return cmocka_run_group_tests_name("parts", tests, start, stop);
}
