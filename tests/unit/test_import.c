// test_import.c: recognising formats, related files, and the models of the corpus.

#include "test.h"

#include <sys/stat.h>

#include "temporary_folder.h"

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

#define READS "; lambent reads FORMATS"

// An error message with the list of formats instead of the word FORMATS.
static const char *with_formats(const char *sentence)
{
    static char text[1000];
    const char *at = strstr(sentence, "FORMATS");
    int used = snprintf(text, sizeof text, "%.*s", at ? (int)(at - sentence) : 0, sentence);
    for (int i = 0; at && lam_model_format_name(i) && !lam_model_format_package(i, NULL); i++)
        for (const char *ending = lam_model_format_extensions(i); *ending; ending += strspn(ending, " ")) {
            bool scene = strcmp(lam_model_format_name(i), "scene") == 0;
            int length = (int)strcspn(ending, " ");
            used += snprintf(text + used, sizeof text - (size_t)used, "%s.%.*s%s",
                             scene                            ? " and scene files ("
                             : *text && text[used - 1] != ' ' ? ", "
                                                              : "",
                             length, ending, scene ? ")" : "");
            ending += length;
        }
    snprintf(text + used, sizeof text - (size_t)used, "%s", at ? at + strlen("FORMATS") : sentence);
    return text;
}

// Whether the extension of a name is exactly the only one of a format, and not of a format that these tests know.
static bool is_read(const char *name)
{
    const char *ending = name ? strrchr(name, '.') : NULL;
    static const char *const known[] = {"obj", "stl", "ply", "json"};
    bool read = false;
    for (int i = 0; ending && lam_model_format_name(i); i++)
        read |= strcmp(ending + 1, lam_model_format_extensions(i)) == 0;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        read &= strcmp(ending + 1, known[i]) != 0;
    return read;
}

static void expect_error(const char *bytes, size_t size, const char *name, lam_code code, const char *sentence)
{
    lam_error error = {0};
    assert_null(lam_scene_load_memory(bytes, size, name, NULL, NULL, &error));
    assert_string_equal(error.text, with_formats(sentence));
    assert_int_equal(error.code, code);
    assert_null(lam_scene_load_memory(bytes, size, name, NULL, NULL, NULL)); // the caller requests no error
}

TEST(test_formats)
{
    static const char *const known[][2] = {
        {"obj", "obj"}, {"stl", "stl"}, {"ply", "ply"}, {"gltf", "gltf glb"}, {"scene", "json"}};
    int count = 0, found = 0;
    const char *name;
    for (; (name = lam_model_format_name(count)); count++) {
        assert_true(lam_model_format_extensions(count) && *lam_model_format_extensions(count));
        for (int i = 0; i < count; i++)
            assert_string_not_equal(name, lam_model_format_name(i));
        for (size_t i = 0; i < sizeof known / sizeof *known; i++)
            if (strcmp(name, known[i][0]) == 0) {
                assert_string_equal(lam_model_format_extensions(count), known[i][1]);
                found++;
            }
        // Its own extension requests the format, so the error comes from its reader.
        lam_error error = {0};
        assert_null(lam_scene_load_memory("?", 1, "a", &(lam_load_params){.format = name}, NULL, &error));
        assert_non_null(error.text[0] ? error.text : NULL);
        assert_null(strstr(error.text, "cannot be read"));
    }
    assert_int_equal(found, sizeof known / sizeof *known);
    assert_null(lam_model_format_name(-1));
    assert_null(lam_model_format_extensions(-1));
    assert_null(lam_model_format_extensions(count));
}

// The content determines the format; the extension only resolves ambiguity.
TEST(test_choice)
{
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
        AUTO_SCENE scene = lam_scene_load_memory(rows[i].text, strlen(rows[i].text), rows[i].name, NULL, NULL, &error);
        SUCCEEDS(scene);
        assert_string_equal(lam_scene_format(scene), rows[i].format);
        assert_int_equal(lam_scene_triangle_count(scene), 1);
        assert_int_equal(lam_scene_object_count(scene), 1);
        assert_int_equal(lam_scene_up(scene), strcmp(rows[i].format, "stl") == 0 ? LAM_UP_Z : LAM_UP_Y);
    }
    lam_error error;
    lam_load_params params = {.up = LAM_UP_X, .format = "OBJ"};
    AUTO_SCENE scene = lam_scene_load_memory(TRIANGLE, strlen(TRIANGLE), "x", &params, NULL, &error);
    assert_non_null(scene);
    assert_int_equal(lam_scene_up(scene), LAM_UP_X);
    double read_ms = -1, prepare_ms = -1;
    lam_scene_times(scene, &read_ms, &prepare_ms);
    assert_true(read_ms > 0 && prepare_ms > 0);
}

TEST(test_foreign)
{
    static const struct {
        const char *bytes;
        size_t size;
        const char *name, *sentence;
        lam_code code;
    } rows[] = {
#define ROW(text, name, sentence, code) {text, sizeof text - 1, name, sentence, code}
#define EXPORT(ending)                  READS ": export the model as " ending
#define NOT                             ", not a 3D model" READS
        ROW("{\"name\": 1}", "a.json",
            "a.json: this is a JSON file with neither the key \"asset\" of glTF nor \"lambent\" of scene files" NOT,
            LAM_CANNOT_READ),
        ROW("BLENDER-v279", "a.blend", "a.blend: this is a Blender file" EXPORT(".glb"), LAM_UNSUPPORTED),
        ROW("#VRML V2.0", "a.wrl", "a.wrl: this is a VRML file" EXPORT(".glb"), LAM_UNSUPPORTED),
        ROW("PK\3\4....3D/3dmodel.model", "a.3mf", "a.3mf: this is a 3MF file" EXPORT(".stl"), LAM_UNSUPPORTED),
        ROW("PK\3\4....word/document.xml", "a.obj", "a.obj: this is a ZIP archive" NOT, LAM_CANNOT_READ),
        ROW("<?xml version=\"1.0\"?>\n<X3D>", "a.x3d", "a.x3d: this is an X3D file" EXPORT(".glb"), LAM_UNSUPPORTED),
        ROW("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a.obj", "a.obj: this is a PNG picture" NOT, LAM_CANNOT_READ),
        ROW("# x\nnewmtl a\nKd 1 1 1\n", "a.mtl",
            "a.mtl: this is an MTL file (materials only; give the .obj that names it)" NOT, LAM_CANNOT_READ),
        ROW("hello there\n", "a.txt", "a.txt: unknown model format" READS, LAM_CANNOT_READ),
        ROW("hello there\n", "a.WRL", "a.WRL: this is a VRML file" EXPORT(".glb"), LAM_UNSUPPORTED),
        ROW("hello there\n", "a.usdz", "a.usdz: this is a USD file" EXPORT(".glb"), LAM_UNSUPPORTED),
        ROW("", "a.obj", "a.obj: the file is empty", LAM_CANNOT_READ),
        ROW("hello there\n", "a.obj",
            "a.obj:1: found 'hello', expected a statement of OBJ (v, f, …); the file contains nothing to draw",
            LAM_CANNOT_READ),
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!is_read(rows[i].name)) // a format that was added later
            expect_error(rows[i].bytes, rows[i].size, rows[i].name, rows[i].code, rows[i].sentence);
}

TEST(test_arguments)
{
    static const struct {
        lam_load_params params;
        lam_code code;
        const char *sentence;
    } rows[] = {
        {{.format = "xyz"}, LAM_UNSUPPORTED, "a: the format 'xyz' cannot be read" READS},
        {{.crease_angle_rad = -1}, LAM_BAD_ARGUMENT, "a: crease_angle_rad is -1, expected 0 to pi"},
        {{.threads = -1}, LAM_BAD_ARGUMENT, "a: threads is -1, expected 0 to 1024"},
        {{.up = (lam_up)9}, LAM_BAD_ARGUMENT, "a: up, color or normals is not one of its constants"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error;
        assert_null(lam_scene_load_memory(TRIANGLE, strlen(TRIANGLE), "a", &rows[i].params, NULL, &error));
        assert_string_equal(error.text, with_formats(rows[i].sentence));
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

// Files on disk: material files are opened only in the model's folder.
TEST(test_files)
{
    char outer[] = "/tmp/lambent-import-XXXXXX", path[64], inner[64];
    assert_non_null(mkdtemp(outer));
    lam_error error;
    assert_null(lam_scene_load(outer, NULL, NULL, &error));
    assert_int_equal(error.code, LAM_CANNOT_READ);
    assert_non_null(strstr(error.text, outer));
    snprintf(path, sizeof path, "%s/none.obj", outer);
    assert_null(lam_scene_load(path, NULL, NULL, &error));
    assert_int_equal(error.code, LAM_CANNOT_READ);

    snprintf(inner, sizeof inner, "%s/inner", outer);
    assert_int_equal(mkdir(inner, 0700), 0);
    static const char *const libraries[] = {"a.mtl",      "./a.mtl",      "../outside.mtl",
                                            "/etc/a.mtl", "C:\\x\\a.mtl", "sub/../../outside.mtl"};
    static const bool found[] = {true, true, false, true, true, false};
    snprintf(path, sizeof path, "%s/inner/a.mtl", outer);
    write_text(path, "newmtl inside\nKd 1 0 0\n");
    snprintf(path, sizeof path, "%s/outside.mtl", outer);
    write_text(path, "newmtl outside\nKd 1 0 0\n");
    for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
        char text[256];
        snprintf(text, sizeof text, "mtllib %s\n" TRIANGLE, libraries[i]);
        snprintf(path, sizeof path, "%s/inner/m.obj", outer);
        write_text(path, text);
        AUTO_SCENE scene = lam_scene_load(path, NULL, NULL, &error);
        assert_non_null(scene);
        assert_int_equal(lam_scene_material_count(scene), found[i]);
        assert_true((lam_scene_warning(scene, 0) == NULL) == found[i]);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/inner/a.mtl", outer);
    unlink(path);
    snprintf(path, sizeof path, "%s/outside.mtl", outer);
    unlink(path);
    rmdir(inner);
    rmdir(outer);
}

// --- files that a model refers to, on disk

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/lambent-import-XXXXXX");
    return mkdtemp(folder) && mkdir(in_folder("inner"), 0700) == 0 && mkdir(in_folder("inner/sub"), 0700) == 0 ? 0 : -1;
}

// The model inner/m.obj with this text before its triangle.
static lam_scene *load_inner(const char *text)
{
    char whole[4096];
    lam_error error;
    snprintf(whole, sizeof whole, "%s" TRIANGLE, text);
    write_text(in_folder("inner/m.obj"), whole);
    lam_scene *scene = lam_scene_load(in_folder("inner/m.obj"), NULL, NULL, &error);
    SUCCEEDS(scene);
    return scene;
}

// Links are followed if they stay in the model's folder or below; a pipe is never opened.
TEST(test_links, .setup_func = make_folder, .teardown_func = remove_folder)
{
    write_text(in_folder("outside.mtl"), "newmtl outside\nKd 1 0 0\n");
    write_text(in_folder("inner/sub/a.mtl"), "newmtl inside\nKd 1 0 0\n");
    assert_int_equal(symlink("sub/a.mtl", in_folder("inner/link.mtl")), 0);
    assert_int_equal(symlink(in_folder("inner/sub/a.mtl"), in_folder("inner/absolute.mtl")), 0);
    assert_int_equal(symlink("../outside.mtl", in_folder("inner/out.mtl")), 0);
    assert_int_equal(symlink("out.mtl", in_folder("inner/twice.mtl")), 0);
    assert_int_equal(symlink("..", in_folder("inner/up")), 0);
    assert_int_equal(symlink("nowhere.mtl", in_folder("inner/nowhere-link.mtl")), 0);
    assert_int_equal(symlink("inner", in_folder("also-inner")), 0);
    assert_int_equal(mkfifo(in_folder("inner/pipe.mtl"), 0600), 0);
    static const struct {
        const char *library, *warning; // NULL if it is read
    } rows[] = {
        {"link.mtl", NULL},
        {"absolute.mtl", NULL},
        {"sub/a.mtl", NULL},
        {"out.mtl", "/inner/out.mtl: leads out of the folder "},
        {"twice.mtl", "/inner/twice.mtl: leads out of the folder "},
        {"up/outside.mtl", "/inner/up/outside.mtl: leads out of the folder "},
        {"up/inner/sub/a.mtl", NULL}, // out of the folder and back
        {"nowhere-link.mtl", "/inner/nowhere-link.mtl: cannot open: No such file"},
        {"pipe.mtl", "/inner/pipe.mtl: is a pipe, expected a regular file; its materials"},
        {"sub", "/inner/sub: is a directory, expected a file; its materials"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[100];
        snprintf(text, sizeof text, "mtllib %s\n", rows[i].library);
        AUTO_SCENE scene = load_inner(text);
        assert_int_equal(lam_scene_material_count(scene), rows[i].warning == NULL);
        const char *warning = lam_scene_warning(scene, 0);
        if (rows[i].warning ? !warning || !strstr(warning, rows[i].warning) : warning != NULL)
            fail_msg("%s: %s", rows[i].library, warning ? warning : "no warning");
    }
    // The model's own folder may be named through a link, and from inside.
    lam_scene_free(load_inner("mtllib sub/a.mtl\n"));
    lam_error error;
    AUTO_SCENE scene = lam_scene_load(in_folder("also-inner/m.obj"), NULL, NULL, &error);
    assert_int_equal(lam_scene_material_count(scene), 1);
}

// Warnings about a material file contain its path; they show at most 32 characters of a name in a file, without control
// characters.
TEST(test_shown_names, .setup_func = make_folder, .teardown_func = remove_folder)
{
    write_text(in_folder("inner/b.mtl"), "newmtl b\nKd 0 1\nKd x\nfoo\n");
    lam_scene *scene = load_inner("mtllib b.mtl\n");
    char wanted[200];
    snprintf(wanted, sizeof wanted, "%s/inner/b.mtl:3: found 'x', expected", folder);
    assert_null(strstr(lam_scene_warning(scene, 0), ":2:"));
    assert_non_null(strstr(lam_scene_warning(scene, 0), wanted));
    snprintf(wanted, sizeof wanted, "%s/inner/b.mtl:4: unknown statement 'foo'", folder);
    assert_string_equal(lam_scene_warning(scene, 1), wanted);
    lam_scene_free(scene);
#define LONG  "0123456789abcdef0123456789abcdef"
#define TO_32 "'" LONG "…'"
    scene = load_inner("usemtl " LONG "xyz\nf 1 1 1\n");
    assert_non_null(strstr(lam_scene_warning(scene, 0), TO_32));
    lam_scene_free(scene);
    scene = load_inner("mtllib " LONG "xyz.mtl\n");
    assert_non_null(strstr(lam_scene_warning(scene, 0), "/inner/0123456789ab…3456789abcdefxyz.mtl: cannot open"));
    lam_scene_free(scene);
    scene = load_inner("mtllib b.mtl\nusemtl a\x1b[31m\xc2\x9b"
                       "31m\xff\nf 1 1 1\n");
    bool found = false;
    for (int i = 0; lam_scene_warning(scene, i); i++) {
        const char *text = lam_scene_warning(scene, i);
        found |= strstr(text, "'a?[31m?31m\xef\xbf\xbd'") != NULL;
        assert_true(!strchr(text, 0x1b) && !strstr(text, "\xc2\x9b"));
    }
    assert_true(found);
    lam_scene_free(scene);
}

// A zero byte in a material file causes a warning, like every mistake in it.
TEST(test_zero_in_materials, .setup_func = make_folder, .teardown_func = remove_folder)
{
    static const char bytes[] = "newmtl z\nKd 1 0 0\n# a\0b\nNs 7\n";
    FILE *file = fopen(in_folder("inner/z.mtl"), "wb");
    assert_non_null(file);
    fwrite(bytes, 1, sizeof bytes - 1, file);
    fclose(file);
    AUTO_SCENE scene = load_inner("mtllib z.mtl\n");
    assert_non_null(strstr(lam_scene_warning(scene, 0), "/inner/z.mtl:3: found a zero byte, expected text"));
    assert_null(lam_scene_warning(scene, 1));
    assert_true(lam_scene_material(scene, 0)->shininess == 7);
}

// --- how often material files are read

struct counts {
    int opened, of_a;
};

static bool count_and_open(void *user, const char *name, lam_bytes *bytes, lam_error *error)
{
    struct counts *counts = user;
    counts->opened++;
    counts->of_a += strcmp(name, "a.mtl") == 0;
    if (strcmp(name, "a.mtl") != 0 && name[0] != 'n') {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    char text[100];
    snprintf(text, sizeof text, "newmtl of %s\nKd 1 0 0\n", name);
    bytes->data = strdup(text);
    bytes->size = strlen(text);
    return true;
}

TEST(test_libraries)
{
    enum { TIMES = 2000 };
    static const char *const spellings[] = {"a.mtl",  "./a.mtl",      ".//./a.mtl",    "../x/a.mtl",
                                            "/a.mtl", "C:\\x\\a.mtl", "x.mtl a.mtl x", "a.mtl a.mtl"};
    enum { SPELLINGS = sizeof spellings / sizeof *spellings };
    char *text = malloc(TIMES * 40 + 100), *at = text;
    for (int i = 0; i < TIMES; i++)
        at += sprintf(at, "mtllib %s\n", spellings[i % SPELLINGS]);
    strcpy(at, TRIANGLE);
    struct counts counts = {0};
    lam_error error;
    lam_load_params params = {.open = count_and_open, .user = &counts};
    lam_scene *scene = lam_scene_load_memory(text, strlen(text), "m.obj", &params, NULL, &error);
    assert_int_equal(counts.of_a, 1);
    assert_int_equal(counts.opened, 1 + 4); // and "x.mtl a.mtl x", x.mtl, x, "a.mtl a.mtl", once each
    assert_int_equal(lam_scene_material_count(scene), 1);
    assert_non_null(lam_scene_warning(scene, 1)); // for x.mtl and x, once each
    assert_null(lam_scene_warning(scene, 2));
    lam_scene_free(scene);

    // Of different files, 256 are read, with a warning that names the line.
    at = text;
    for (int i = 0; i < TIMES; i++)
        at += sprintf(at, "mtllib n%d.mtl\n", i);
    strcpy(at, TRIANGLE);
    counts = (struct counts){0};
    scene = lam_scene_load_memory(text, strlen(text), "m.obj", &params, NULL, &error);
    assert_int_equal(counts.opened, 256);
    assert_int_equal(lam_scene_material_count(scene), 256);
    assert_string_equal(lam_scene_warning(scene, 0),
                        "m.obj:257: names more than 256 material files; the others are ignored, "
                        "and their materials are drawn in neutral grey");
    assert_null(lam_scene_warning(scene, 1));
    lam_scene_free(scene);
    free(text);
}

// Every OBJ model of the corpus, with the number of triangles in its table, with one thread and with three.
TEST(test_corpus)
{
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
            AUTO_SCENE scene = lam_scene_load(path, &params, NULL, &error);
            SUCCEEDS(scene);
            if (lam_scene_triangle_count(scene) != triangles)
                fail_msg("%s: %llu triangles, expected %llu", name, (unsigned long long)lam_scene_triangle_count(scene),
                         triangles);
            lam_vec3 low, high;
            assert_true(lam_scene_bounds(scene, &low, &high));
        }
        loaded++;
    }
    fclose(table);
    assert_true(loaded > 40);
}
