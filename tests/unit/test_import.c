// test_import.c: recognising formats, companion files, and the models of the corpus.
#include <lambent/lambent.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

static void expect_error(const char *bytes, size_t size, const char *name, lam_code code, const char *sentence)
{
    lam_error error = {0};
    assert_null(lam_scene_load_memory(bytes, size, name, NULL, NULL, &error));
    assert_string_equal(error.text, sentence);
    assert_int_equal(error.code, code);
    assert_null(lam_scene_load_memory(bytes, size, name, NULL, NULL, NULL)); // no error wanted
}

static void test_formats(void **unused)
{
    (void)unused;
    assert_string_equal(lam_model_format_name(0), "obj");
    assert_string_equal(lam_model_format_name(1), "stl");
    assert_string_equal(lam_model_format_name(2), "ply");
    assert_string_equal(lam_model_format_name(3), "scene");
    assert_null(lam_model_format_name(4));
    assert_null(lam_model_format_name(-1));
    assert_string_equal(lam_model_format_extensions(0), "obj");
    assert_null(lam_model_format_extensions(4));
}

// The content decides the format; the extension only resolves ambiguity.
static void test_choice(void **unused)
{
    (void)unused;
    static const struct {
        const char *text, *name, *format;
    } rows[] = {
        {TRIANGLE, "a.obj", "obj"},
        {TRIANGLE, "a.stl", "obj"},
        {TRIANGLE, NULL, "obj"},
        {"# made by hand\n\no thing\n" TRIANGLE, "-", "obj"},
        {"strange 1\n" TRIANGLE, "a.OBJ", "obj"},
        {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\nendsolid x\n",
         "a.obj", "stl"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
         "z\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
         "a.obj", "ply"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error;
        lam_scene *scene = lam_scene_load_memory(rows[i].text, strlen(rows[i].text), rows[i].name, NULL, NULL, &error);
        if (!scene)
            fail_msg("%s", error.text);
        assert_string_equal(lam_scene_format(scene), rows[i].format);
        assert_int_equal(lam_scene_triangle_count(scene), 1);
        assert_int_equal(lam_scene_object_count(scene), 1);
        assert_int_equal(lam_scene_up(scene), strcmp(rows[i].format, "stl") == 0 ? LAM_UP_Z : LAM_UP_Y);
        lam_scene_free(scene);
    }
    lam_error error;
    lam_load_params params = {.up = LAM_UP_X, .format = "OBJ"};
    lam_scene *scene = lam_scene_load_memory(TRIANGLE, strlen(TRIANGLE), "x", &params, NULL, &error);
    assert_non_null(scene);
    assert_int_equal(lam_scene_up(scene), LAM_UP_X);
    double read_ms = -1, prepare_ms = -1;
    lam_scene_times(scene, &read_ms, &prepare_ms);
    assert_true(read_ms > 0 && prepare_ms > 0);
    lam_scene_free(scene);
}

static void test_foreign(void **unused)
{
    (void)unused;
    static const struct {
        const char *bytes;
        size_t size;
        const char *name, *sentence;
        lam_code code;
    } rows[] = {
#define ROW(text, name, sentence, code) {text, sizeof text - 1, name, sentence, code}
#define YET                             ", which this version cannot read yet; it reads obj, stl, ply and scene"
#define NOT                             ", not a 3D model; expected obj, stl, ply and scene"
        ROW("glTF\2\0\0\0\x40\0\0\0", "scene.glb", "scene.glb: this is a glTF binary file" YET, LAM_UNSUPPORTED),
        ROW("{\n \"asset\": {\"version\": \"2.0\"}}", "a.gltf", "a.gltf: this is a glTF file" YET, LAM_UNSUPPORTED),
        ROW("{\"name\": 1}", "a.json",
            "a.json: this is a JSON file without the key \"lambent\" of scene files (\"lambent\": 1)" NOT,
            LAM_CANNOT_READ),
        ROW("Kaydara FBX Binary  \0", "a.fbx", "a.fbx: this is an FBX file" YET, LAM_UNSUPPORTED),
        ROW("\x4d\x4d\x8\0\0\0xx", "a.3ds", "a.3ds: this is a 3DS file" YET, LAM_UNSUPPORTED),
        ROW("ISO-10303-21;\nHEADER;", "a.step", "a.step: this is a STEP file" YET, LAM_UNSUPPORTED),
        ROW("OFF\n8 6 12\n", "a.off", "a.off: this is an OFF file" YET, LAM_UNSUPPORTED),
        ROW("PK\3\4....3D/3dmodel.model", "a.3mf", "a.3mf: this is a 3MF file" YET, LAM_UNSUPPORTED),
        ROW("PK\3\4....word/document.xml", "a.obj", "a.obj: this is a ZIP archive" NOT, LAM_CANNOT_READ),
        ROW("<?xml version=\"1.0\"?>\n<COLLADA>", "a.dae", "a.dae: this is a COLLADA file" YET, LAM_UNSUPPORTED),
        ROW("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a.obj", "a.obj: this is a PNG picture" NOT, LAM_CANNOT_READ),
        ROW("# x\nnewmtl a\nKd 1 1 1\n", "a.mtl",
            "a.mtl: this is a MTL file (materials only; give the .obj that names it)" NOT, LAM_CANNOT_READ),
        ROW("hello there\n", "a.txt", "a.txt: this is no model format known here; expected obj, stl, ply and scene",
            LAM_CANNOT_READ),
        ROW("", "a.obj", "a.obj: the file is empty", LAM_CANNOT_READ),
        ROW("hello there\n", "a.obj",
            "a.obj:1: found 'hello', expected a statement of OBJ (v, f, …); the file holds no triangles",
            LAM_CANNOT_READ),
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        expect_error(rows[i].bytes, rows[i].size, rows[i].name, rows[i].code, rows[i].sentence);
}

static void test_arguments(void **unused)
{
    (void)unused;
    static const struct {
        lam_load_params params;
        lam_code code;
        const char *sentence;
    } rows[] = {
        {{.format = "xyz"},
         LAM_UNSUPPORTED,
         "a: the format 'xyz' cannot be read; this version reads obj, stl, ply and scene"},
        {{.crease_angle_rad = -1}, LAM_BAD_ARGUMENT, "a: crease_angle_rad is -1, expected 0 to pi"},
        {{.threads = -1}, LAM_BAD_ARGUMENT, "a: threads is -1, expected 0 to 1024"},
        {{.up = (lam_up)9}, LAM_BAD_ARGUMENT, "a: up, color or normals is not one of its constants"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error;
        assert_null(lam_scene_load_memory(TRIANGLE, strlen(TRIANGLE), "a", &rows[i].params, NULL, &error));
        assert_string_equal(error.text, rows[i].sentence);
        assert_int_equal(error.code, rows[i].code);
    }
    lam_error error;
    assert_null(lam_scene_load(NULL, NULL, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_null(lam_scene_load_memory(NULL, 5, "a", NULL, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

// Files on disk: material files are opened in the model's folder only.
static void test_files(void **unused)
{
    (void)unused;
    char folder[] = "/tmp/lambent-import-XXXXXX", path[64], inner[64];
    assert_non_null(mkdtemp(folder));
    lam_error error;
    assert_null(lam_scene_load(folder, NULL, NULL, &error));
    assert_int_equal(error.code, LAM_CANNOT_READ);
    assert_non_null(strstr(error.text, folder));
    snprintf(path, sizeof path, "%s/none.obj", folder);
    assert_null(lam_scene_load(path, NULL, NULL, &error));
    assert_int_equal(error.code, LAM_CANNOT_READ);

    snprintf(inner, sizeof inner, "%s/inner", folder);
    assert_int_equal(mkdir(inner, 0700), 0);
    static const char *const libraries[] = {"a.mtl",      "./a.mtl",      "../outside.mtl",
                                            "/etc/a.mtl", "C:\\x\\a.mtl", "sub/../../outside.mtl"};
    static const bool found[] = {true, true, false, true, true, false};
    snprintf(path, sizeof path, "%s/inner/a.mtl", folder);
    write_text(path, "newmtl inside\nKd 1 0 0\n");
    snprintf(path, sizeof path, "%s/outside.mtl", folder);
    write_text(path, "newmtl outside\nKd 1 0 0\n");
    for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
        char text[256];
        snprintf(text, sizeof text, "mtllib %s\n" TRIANGLE, libraries[i]);
        snprintf(path, sizeof path, "%s/inner/m.obj", folder);
        write_text(path, text);
        lam_scene *scene = lam_scene_load(path, NULL, NULL, &error);
        assert_non_null(scene);
        assert_int_equal(lam_scene_material_count(scene), found[i]);
        assert_true((lam_scene_warning(scene, 0) == NULL) == found[i]);
        lam_scene_free(scene);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/inner/a.mtl", folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/outside.mtl", folder);
    unlink(path);
    rmdir(inner);
    rmdir(folder);
}

// Every OBJ model of the corpus, with the number of triangles that its table gives, on one thread and on three.
static void test_corpus(void **unused)
{
    (void)unused;
    const char *models = getenv("LAMBENT_MODELS");
    models = models ? models : "../shared/models";
    char path[1024], line[1024];
    snprintf(path, sizeof path, "%s/README.md", models);
    FILE *table = fopen(path, "r");
    if (!table) {
        print_message("no models at %s (LAMBENT_MODELS): skipped\n", models);
        skip();
    }
    int loaded = 0;
    while (fgets(line, sizeof line, table)) {
        char name[256];
        unsigned long long triangles;
        if (sscanf(line, "| %255s | %*[^|]| %*[^|]| %*[^|]| %llu |", name, &triangles) != 2 ||
            strncmp(name, "obj/", 4) != 0)
            continue;
        snprintf(path, sizeof path, "%s/%s", models, name);
        for (int threads = 1; threads <= 3; threads += 2) {
            lam_error error;
            lam_load_params params = {.threads = threads};
            lam_scene *scene = lam_scene_load(path, &params, NULL, &error);
            if (!scene)
                fail_msg("%s", error.text);
            if (lam_scene_triangle_count(scene) != triangles)
                fail_msg("%s: %llu triangles, expected %llu", name, (unsigned long long)lam_scene_triangle_count(scene),
                         triangles);
            lam_vec3 low, high;
            assert_true(lam_scene_bounds(scene, &low, &high));
            lam_scene_free(scene);
        }
        loaded++;
    }
    fclose(table);
    assert_true(loaded > 40);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_formats),   cmocka_unit_test(test_choice), cmocka_unit_test(test_foreign),
        cmocka_unit_test(test_arguments), cmocka_unit_test(test_files),  cmocka_unit_test(test_corpus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
