// test_out_of_memory.c: loads and draws small files of every format while single memory requests fail, and while reads
// return too little.
//
// Whenever memory runs out, a call gives the same picture as usual, or LAM_MACHINE and a message about memory; nothing
// stays allocated. `test-out-of-memory FILE N`, for a debugger: one request of one row.
#include "failing_memory.h"

#include <lambent/lambent.h>

#include <dlfcn.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>

#ifndef TESTS // for a call by hand, from the root of the sources
#define TESTS "tests"
#endif

enum { SIDE = 12, PIXELS = SIDE * SIDE, LIBRARIES = 4 };
enum {
    SHADOWS = 1,
    OCCLUSION = 2,
    ENVIRONMENT = 4,
    TANGENTS = 8,
    NORMALS_LATE = 16,
    SAVE = 32, // also encodes the picture
    ANIMATED = 64,
    // All requests from one on fail, never one alone: picture libraries report a damaged file if memory is
    // insufficient, and are called again with a request that must also fail.
    ONWARDS = 128,
    TWO_THREADS = 256,
};

static const struct row {
    const char *file; // in TESTS
    int ways;
} rows[] = {
    {"fuzz/corpus/obj/far.obj", NORMALS_LATE},
    {"fuzz/corpus/obj/concave.obj", SHADOWS},
    {"fuzz/corpus/obj/lines.obj", 0},
    {"fuzz/corpus/ply/ascii_all.ply", 0},
    {"fuzz/corpus/ply/little.ply", OCCLUSION | NORMALS_LATE | TWO_THREADS},
    {"fuzz/corpus/ply/big.ply", TANGENTS},
    {"fuzz/corpus/ply/strips.ply", 0},
    {"fuzz/corpus/ply/edges.ply", 0},
    {"fuzz/corpus/stl/ascii.stl", NORMALS_LATE},
    {"fuzz/corpus/stl/binary.stl", SAVE},
    {"fuzz/corpus/stl/magics.stl", 0},
    {"fuzz/corpus/gltf/all.gltf", 0},
    {"fuzz/corpus/gltf/draco.gltf", 0},
    {"fuzz/corpus/gltf/meshopt.gltf", 0},
    {"fuzz/corpus/gltf/lines.gltf", 0},
    {"fuzz/corpus/glb/all.glb", SHADOWS | OCCLUSION | TWO_THREADS},
    {"fuzz/corpus/glb/pose.glb", ANIMATED},
    {"fuzz/corpus/gltf/triangle.gltf", ENVIRONMENT},
    {"models/scene.json", 0},
    {"models/cube.obj", SHADOWS | OCCLUSION | SAVE},
    {"textured.obj", ONWARDS},
    {"exr.obj", ONWARDS},
};

// Models in a separate folder: one with a picture of every format as a map, and one with EXR's.
static const char *const pictures[] = {
    "pictures/png/palette8.png",      "pictures/png/bits16-interlaced.png",
    "pictures/jpeg/color420.jpg",     "pictures/jpeg/cmyk-progressive.jpg",
    "pictures/webp/lossy-alpha.webp", "pictures/webp/lossless.webp",
    "pictures/tga/palette-runs.tga",  "pictures/bmp/runs8.bmp",
    "fuzz/corpus/hdr/runs.hdr",
};

static const char *only_file; // NULL: all
static long only_request;

static char folder[64];

static const char *path_of(const char *file, char path[512])
{
    snprintf(path, 512, "%s/%s", strchr(file, '/') ? TESTS : folder, file);
    return path;
}

static void write_file(const char *name, const void *bytes, size_t size)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static size_t read_all(const char *path, uint8_t *bytes, size_t capacity)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s cannot be opened", path);
    size_t size = fread(bytes, 1, capacity, file);
    assert_true(size < capacity);
    fclose(file);
    return size;
}

static int make_files(void **state)
{
    (void)state;
    static const char *const statements[] = {"map_Ka", "map_Kd", "map_Ks", "map_Ke", "map_Ns",
                                             "map_d",  "bump",   "norm",   "map_Pr"};
    static uint8_t bytes[1 << 16];
    char materials[4096] = "newmtl a\nKd 1 1 1\nKs 1 1 1\nKe 1 1 1\n", path[512];
    strcpy(folder, "/tmp/lambent-memory-XXXXXX");
    assert_non_null(mkdtemp(folder));
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        const char *name = strrchr(pictures[i], '/') + 1;
        write_file(name, bytes, read_all(path_of(pictures[i], path), bytes, sizeof bytes));
        snprintf(materials + strlen(materials), sizeof materials - strlen(materials), "%s %s\n", statements[i], name);
    }
    static const char model[] =
        "mtllib %s.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    write_file("t.mtl", materials, strlen(materials));
    write_file("e.mtl", "newmtl a\nmap_Kd triangle.exr\n", 30);
    write_file("triangle.exr", bytes, read_all(path_of("fuzz/corpus/exr/triangle.exr", path), bytes, sizeof bytes));
    for (int i = 0; i < 2; i++) {
        char text[256];
        snprintf(text, sizeof text, model, i ? "e" : "t");
        write_file(i ? "exr.obj" : "textured.obj", text, strlen(text));
    }
    // Libraries stay open, because this test does not cover the loader's own requests for opening them again and again.
    static const char *const libraries[LIBRARIES] = {"libwebp.so.7", "libOpenEXRCore-3_1.so.30",
                                                     "libmeshoptimizer.so.2d", "libfreetype.so.6"};
    for (int i = 0; i < LIBRARIES; i++)
        dlopen(libraries[i], RTLD_NOW | RTLD_NODELETE);
    // libwebp 1.2 dereferences a null pointer in some places if memory is insufficient (src/formats/image/formats/webp.c).
    memory_spare("libwebp");
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

// The results of a run.
struct outcome {
    bool ok;
    _Alignas(16) uint8_t pixels[4 * PIXELS];
    int warnings;
    lam_error error;
    char last_warning[256];
};

static lam_environment *make_environment(lam_error *error)
{
    static float texels[6][4] = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 0, 1}, {0, 1, 1, 1}, {1, 0, 1, 1}};
    lam_image faces[6];
    const lam_image *list[6];
    for (int f = 0; f < 6; f++) {
        faces[f] = (lam_image){.width = 1, .height = 1, .format = LAM_RGBA32F, .pixels = texels[f]};
        list[f] = &faces[f];
    }
    return lam_environment_make(list, LAM_COLOR_SRGB, error);
}

static bool draw(lam_scene *scene, int ways, struct outcome *out)
{
    const lam_draw_params params = {.samples = 2,
                                    .rig = ways & ENVIRONMENT ? LAM_RIG_AUTO : LAM_RIG_STUDIO,
                                    .shadows = ways & SHADOWS,
                                    .reflection = ways & TANGENTS ? LAM_REFLECTION_KAJIYA_KAY : LAM_REFLECTION_AUTO,
                                    .occlusion = ways & OCCLUSION ? LAM_OCCLUSION_SCREEN : LAM_OCCLUSION_OFF};
    lam_environment *environment = NULL;
    if (ways & ENVIRONMENT) {
        environment = make_environment(&out->error);
        if (!environment || !lam_scene_set_environment(scene, environment, 0, &out->error)) {
            lam_environment_free(environment);
            return false;
        }
        lam_environment_free(environment);
    }
    if (ways & TANGENTS && !lam_scene_make_tangents(scene, NULL, &out->error))
        return false;
    const lam_camera camera = lam_camera_fit(scene, SIDE, SIDE, NULL);
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = ways & TWO_THREADS ? 2 : 1}, &out->error);
    lam_image image = {.width = SIDE, .height = SIDE, .pixels = out->pixels};
    bool ok = device && lam_draw(device, scene, &camera, &params, &image, NULL, &out->error);
    lam_device_free(device);
    static const char *const formats[] = {"png", "jpg", "webp", "exr"};
    static float floats[4 * PIXELS];
    const lam_image light = {.width = SIDE, .height = SIDE, .format = LAM_RGBA32F, .pixels = floats};
    for (int i = 0; ok && ways & SAVE && i < 4; i++) {
        lam_bytes bytes;
        ok = lam_image_encode(i == 3 ? &light : &image, formats[i], NULL, &bytes, &out->error);
        if (ok)
            lam_bytes_free(&bytes);
    }
    return ok;
}

static void render(const struct row *row, struct outcome *out)
{
    char path[512];
    const lam_load_params params = {.threads = row->ways & TWO_THREADS ? 2 : 1,
                                    .normals_when_drawn = row->ways & NORMALS_LATE,
                                    .animation = row->ways & ANIMATED ? "0" : NULL,
                                    .time_s = 0.25};
    memset(out, 0, sizeof *out);
    lam_scene *scene = lam_scene_load(path_of(row->file, path), &params, NULL, &out->error);
    out->ok = scene && draw(scene, row->ways, out);
    for (const char *text; scene && (text = lam_scene_warning(scene, out->warnings)); out->warnings++)
        snprintf(out->last_warning, sizeof out->last_warning, "%s", text);
    lam_scene_free(scene);
}

// Returns the number of mistakes.
static int fail_each_request(const struct row *row)
{
    int mistakes = 0;
    struct outcome whole, now;
    // Runs twice: the first run may leave something in the process, such as the C library's own buffers.
    render(row, &whole);
    memory_fail_at(-1, false);
    render(row, &whole);
    const long count = memory_requests();
    if (!whole.ok && whole.error.code == LAM_UNSUPPORTED) {
        print_message("%s: %s\n", row->file, whole.error.text);
        return 0;
    }
    if (!whole.ok)
        fail_msg("%s: %s", row->file, whole.error.text);
    for (long n = 0; n < count; n++) {
        if (only_file && n != only_request)
            continue;
        for (int onwards = 0; onwards < 2; onwards++) {
            if (row->ways & ONWARDS && !onwards)
                continue;
            const struct memory_held before = memory_held();
            memory_fail_at(n, onwards);
            render(row, &now);
            const bool failed = memory_failed();
            memory_fail_at(-1, false);
            const struct memory_held after = memory_held();
            // A warning may be omitted if memory is insufficient; nothing else may.
            const bool good =
                now.ok ? memcmp(now.pixels, whole.pixels, sizeof now.pixels) == 0 && now.warnings <= whole.warnings
                       : failed && now.error.code == LAM_MACHINE && strstr(now.error.text, "memory");
            if (good && after.blocks == before.blocks && after.mapped == before.mapped)
                continue;
            mistakes++;
            print_error("%s, request %ld of %ld%s: %s (code %d), %ld blocks and %ld mapped bytes left\n", row->file, n,
                        count, onwards ? " and all later ones" : "",
                        now.ok ? (good ? "the picture" : now.last_warning) : now.error.text, now.error.code,
                        after.blocks - before.blocks, after.mapped - before.mapped);
        }
    }
    print_message("%s: %ld requests\n", row->file, count);
    return mistakes;
}

static void test_requests_fail(void **state)
{
    (void)state;
    int mistakes = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!only_file || strcmp(only_file, rows[i].file) == 0)
            mistakes += fail_each_request(&rows[i]);
    }
    assert_int_equal(mistakes, 0);
}

// Reads of one or three bytes at a time give the same picture. A file that ends too early, or a disk error at any
// offset, is LAM_CANNOT_READ.
static void test_reads_fall_short(void **state)
{
    (void)state;
    static uint8_t bytes[1 << 16];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct row *row = &rows[i];
        struct outcome whole, now;
        char path[512];
        if (row->ways & ENVIRONMENT)
            continue; // slow, and reads nothing else
        render(row, &whole);
        if (!whole.ok && whole.error.code == LAM_UNSUPPORTED)
            continue; // the other test gives the reason
        assert_true(whole.ok);
        for (size_t most = 1; most <= 7; most += 2) {
            reads_return_at_most(most);
            render(row, &now);
            reads_return_at_most(0);
            if (!now.ok || memcmp(now.pixels, whole.pixels, sizeof now.pixels) != 0)
                fail_msg("%s, %zu bytes a read: %s", row->file, most, now.ok ? "another picture" : now.error.text);
        }
        long size = (long)read_all(path_of(row->file, path), bytes, sizeof bytes), step = size / 200 + 1;
        for (long at = 0; at < size; at += step) {
            for (int error = 0; error < 2; error++) {
                const struct memory_held before = memory_held();
                reads_end_at(at, error);
                render(row, &now);
                const bool ended = reads_ended();
                reads_end_at(-1, false);
                const struct memory_held after = memory_held();
                // An unreadable map causes a warning and another picture.
                if (now.ok ? now.warnings == whole.warnings
                           : now.error.code != (error ? LAM_MACHINE : LAM_CANNOT_READ) || !now.error.text[0])
                    fail_msg("%s, %s at byte %ld: %s (code %d)", row->file, error ? "an error" : "the end", at,
                             now.ok ? "a picture" : now.error.text, now.error.code);
                assert_true(ended);
                if (after.blocks != before.blocks || after.mapped != before.mapped)
                    fail_msg("%s, byte %ld: %ld blocks and %ld mapped bytes are left", row->file, at,
                             after.blocks - before.blocks, after.mapped - before.mapped);
            }
        }
    }
}

// The first bytes of each file, from standard input, three at a time, give the same result as in memory.
static void test_pipes(void **state)
{
    (void)state;
    static uint8_t bytes[1 << 16];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct row *row = &rows[i];
        char path[512];
        if (strstr(row->file, "models/") || !strchr(row->file, '/'))
            continue; // they name other files
        size_t size = read_all(path_of(row->file, path), bytes, sizeof bytes);
        const size_t step = size / 60 + 1;
        for (size_t cut = 0; cut < size + step; cut += step) {
            const size_t length = cut < size ? cut : size;
            const lam_load_params params = {.threads = 1}; // a thread keeps some blocks of the C library
            int ends[2];
            lam_error errors[2] = {0};
            const struct memory_held before = memory_held();
            assert_int_equal(pipe(ends), 0);
            assert_int_equal(write(ends[1], bytes, length), (ssize_t)length); // a pipe holds 64 KB
            close(ends[1]);
            dup2(ends[0], STDIN_FILENO);
            close(ends[0]);
            reads_return_at_most(3);
            lam_scene *piped = lam_scene_load("-", &params, NULL, &errors[0]);
            reads_return_at_most(0);
            lam_scene *scene = lam_scene_load_memory(bytes, length, NULL, &params, NULL, &errors[1]);
            if (!piped != !scene || errors[0].code != errors[1].code || !errors[0].text[0] != !errors[1].text[0] ||
                (scene && lam_scene_triangle_count(piped) != lam_scene_triangle_count(scene)))
                fail_msg("%s, %zu bytes: '%s' from a pipe, '%s' from memory", row->file, length, errors[0].text,
                         errors[1].text);
            lam_scene_free(piped);
            lam_scene_free(scene);
            const struct memory_held after = memory_held();
            assert_int_equal(after.blocks, before.blocks);
            assert_int_equal(after.mapped, before.mapped);
        }
    }
}

int main(int count, char **words)
{
    only_file = count == 3 ? words[1] : NULL;
    only_request = count == 3 ? atol(words[2]) : 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_requests_fail),
        cmocka_unit_test(test_reads_fall_short),
        cmocka_unit_test(test_pipes),
    };
    return cmocka_run_group_tests_name("out-of-memory", tests, make_files, remove_files);
}
