// test_modules.c: the library's side of lambent-import (src/formats/import/module). A program beside this test stands
// in for it (fake_import.c): it crashes, hangs, lies, and sends truncated and mutated scenes.
#include "test.h"

#include <pthread.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <time.h>

enum { HEAD = 16, LARGEST = 1 << 20 };

// A valid scene as the modules write it: a triangle of an exact shape, with a material and a light.
static const char json[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"buffers\":[{\"byteLength\":40}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5121,\"count\":1,\"type\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,"
    "\"byteOffset\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":1}],\"nodes\":[{\"mesh\":0,"
    "\"name\":\"part\","
    "\"children\":[1]},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],\"meshes\":[{\"primitives\":["
    "{\"attributes\":{\"POSITION\":0},\"mode\":4,\"extensions\":{\"LAMBENT_faces\":{\"inner\":1,\"area\":7,\"parts\":"
    "[{\"material\":0,\"triangles\":1}]}}}]}],\"materials\":[{\"name\":\"red\",\"extensions\":"
    "{\"LAMBENT_material\":{\"diffuse\":[1,0.5,0,1],\"specular\":[0,0,0],\"shininess\":20}}}],\"extensions\":"
    "{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\",\"extensions\":{\"LAMBENT_light\":"
    "{\"attenuation\":[1,0,0.5],\"ambient\":[0.1,0.1,0.1]}}}]}}}";
static const struct {
    float corners[9];
    uint8_t inner[4];
} binary = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {10, 0, 0, 0}};

static size_t make_scene(uint8_t *out)
{
    size_t length = (sizeof json - 1 + 3) & ~(size_t)3;
    uint32_t head[5] = {0x46546c67, 2, (uint32_t)(28 + length + sizeof binary), (uint32_t)length, 0x4e4f534a};
    uint32_t chunk[2] = {sizeof binary, 0x004e4942};
    memset(out, ' ', 20 + length);
    memcpy(out, head, sizeof head);
    memcpy(out + 20, json, sizeof json - 1);
    memcpy(out + 20 + length, chunk, sizeof chunk);
    memcpy(out + 28 + length, &binary, sizeof binary);
    return 28 + length + sizeof binary;
}

static lam_scene *load(const char *mode, const uint8_t *scene, size_t size, const lam_control *control,
                       lam_error *error)
{
    uint8_t *file = calloc(1, HEAD + size + 1);
    snprintf((char *)file, HEAD, "xof %s", mode);
    memcpy(file + HEAD, scene, size);
    lam_scene *loaded = lam_scene_load_memory(file, HEAD + size, "a.x", NULL, control, error);
    free(file);
    return loaded;
}

static uint8_t made[4096];
static size_t made_size;

static int make(void **state)
{
    made_size = make_scene(made);
    return *state != NULL;
}
FIXTURE(make, NULL)

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

TEST(test_scene)
{
    lam_error error = {0};
    lam_scene *scene = load("good", made, made_size, NULL, &error);
    SUCCEEDS(scene);
    assert_int_equal(lam_scene_mesh(scene, 0)->triangle_count, 1);
    assert_int_equal(lam_scene_mesh(scene, 0)->inner_edges[0], 10);
    assert_true(lam_scene_mesh(scene, 0)->exact_area == 7 && lam_scene_mesh(scene, 0)->exact_volume == 0);
    assert_int_equal(lam_scene_mesh(scene, 0)->parts[0].material, 0);
    assert_string_equal(lam_scene_object(scene, 0)->name, "part");
    const lam_material *material = lam_scene_material(scene, 0);
    assert_false(material->physical);
    assert_true(material->diffuse.r == 1 && material->diffuse.g > 0.213f && material->diffuse.g < 0.215f);
    assert_true(material->ambient.g == material->diffuse.g && material->shininess == 20);
    const lam_light *light = lam_scene_light(scene, 0);
    assert_true(light->attenuation.constant == 1 && light->attenuation.quadratic == 0.5f && light->ambient.r == 0.1f);
    assert_int_equal(lam_scene_warning(scene, 0) != NULL, 0);
    lam_scene_free(scene);
    scene = load("unit", made, made_size, NULL, &error);
    SUCCEEDS(scene);
    assert_true(lam_scene_file_info(scene)->unit_m == 0 && lam_scene_file_info(scene)->reader_memory == 0);
    lam_scene_free(scene);
    scene = load("note", made, made_size, NULL, &error);
    SUCCEEDS(scene);
    assert_non_null(strstr(lam_scene_warning(scene, 0), "a.x: ????"));
    lam_scene_free(scene);
}

TEST(test_failures)
{
    static const struct {
        const char *mode;
        lam_code code;
        const char *part;
    } rows[] = {
        {"crash", LAM_CANNOT_READ, "a.x: the reader of x files has failed (lambent-import ended)"},
        {"early", LAM_CANNOT_READ, "a.x: the reader of x files has failed"},
        {"short", LAM_CANNOT_READ, "a.x: the reader of x files has failed"},
        {"version", LAM_UNSUPPORTED, "another version"},
        {"huge", LAM_LIMIT, "memory"},
        {"empty", LAM_CANNOT_READ, "cannot read the x file"},
        {"result1", LAM_CANNOT_READ, "cannot read the x file"},
        {"result2", LAM_LIMIT, "more memory"},
        {"result3", LAM_UNSUPPORTED, "cannot read the x file"},
        {"result9", LAM_CANNOT_READ, "cannot read the x file"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error = {0};
        assert_null(load(rows[i].mode, made, made_size, NULL, &error));
        if (error.code != rows[i].code || !strstr(error.text, rows[i].part))
            fail_msg("%s: %d '%s'", rows[i].mode, error.code, error.text);
    }
    // A large file that the other process does not read: no SIGPIPE.
    uint8_t *large = calloc(1, LARGEST);
    lam_error error = {0};
    assert_null(load("early", large, LARGEST, NULL, &error));
    free(large);
}

TEST(test_wrong_faces)
{
    static const char *const rows[][3] = {
        {"\"triangles\":1}", "\"triangles\":0}", "1 triangles of no part"},
        {"\"triangles\":1}", "\"triangles\":2}", "parts[0].triangles"},
        {"\"material\":0,\"tri", "\"material\":7,\"tri", NULL}, // gets the default material
        {"\"parts\"", "\"pants\"", "1 triangles of no part"},
        {"\"inner\":1", "\"inner\":0", "expected SCALAR"},
        {"\"inner\":1", "\"inner\":9", "LAMBENT_faces.inner"},
        {"5121,\"count\":1", "5121,\"count\":2", "bufferView 1"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        uint8_t changed[sizeof made];
        lam_error error = {0};
        memcpy(changed, made, made_size);
        memcpy(memmem(changed, made_size, rows[i][0], strlen(rows[i][0])), rows[i][1], strlen(rows[i][1]));
        lam_scene *scene = load("good", changed, made_size, NULL, &error);
        if (!scene == !rows[i][2] || (rows[i][2] && !strstr(error.text, rows[i][2])))
            fail_msg("%s: '%s'", rows[i][1], error.text);
        lam_scene_free(scene);
    }
}

// Each truncation, and each byte changed, is read or refused with one sentence.
TEST(test_hostile_scenes)
{
    uint8_t changed[sizeof made];
    for (size_t i = 0; i < made_size; i++) {
        lam_error error = {0};
        memcpy(changed, made, made_size);
        changed[i] ^= (uint8_t)(i % 2 ? 0x80 : 0x15);
        lam_scene *scene = load("good", changed, made_size, NULL, &error);
        if (!scene && strncmp(error.text, "a.x:", 4) != 0)
            fail_msg("%zu: '%s'", i, error.text);
        lam_scene_free(scene);
        if (i % 3)
            continue;
        error = (lam_error){0};
        scene = load("good", made, i, NULL, &error);
        if (!scene && strncmp(error.text, "a.x:", 4) != 0)
            fail_msg("%zu: '%s'", i, error.text);
        lam_scene_free(scene);
    }
}

static void *raise_flag(void *cancel)
{
    nanosleep(&(struct timespec){0, 50000000}, NULL);
    lam_cancel_raise(cancel);
    return NULL;
}

TEST(test_stops)
{
    lam_cancel cancel = {0};
    pthread_t thread;
    lam_error error = {0};
    double start = now_s();
    pthread_create(&thread, NULL, raise_flag, &cancel);
    assert_null(load("hang", made, made_size, &(lam_control){.cancel = &cancel}, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_true(now_s() - start < 0.25);
    pthread_join(thread, NULL);
    start = now_s();
    assert_null(load("hang", made, made_size, &(lam_control){.time_limit_s = 0.1}, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_true(now_s() - start < 0.4);
}

static atomic_int drawn;

static void *load_some(void *unused)
{
    for (int i = 0; i < 20; i++) {
        lam_error error = {0};
        lam_scene *scene = load(i % 4 ? "good" : "crash", made, made_size, NULL, &error);
        drawn += scene != NULL;
        lam_scene_free(scene);
    }
    return unused;
}

TEST(test_threads)
{
    pthread_t threads[4];
    drawn = 0;
    for (int i = 0; i < 4; i++)
        pthread_create(&threads[i], NULL, load_some, NULL);
    for (int i = 0; i < 4; i++)
        pthread_join(threads[i], NULL);
    assert_int_equal(drawn, 60);
}

// The same through the starter. Afterwards no process is left: the starter's are its own children.
TEST(test_starter)
{
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); // the tests above left no process
    int handle = lam_import_start();
    assert_true(handle > 2);
    assert_int_equal(lam_import_start(), handle);
    test_scene();
    test_failures();
    test_stops();
    test_threads();
    assert_int_equal(waitpid(-1, NULL, WNOHANG), 0); // only the starter
}
