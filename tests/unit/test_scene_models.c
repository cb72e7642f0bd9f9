// test_scene_models.c: the files that scene files name: data shared by objects, and the allowed folders.
#include "test.h"
#include "loading.h"
#include "temporary_folder.h"

#include <sys/stat.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

// --- files next to a scene in memory

struct counts {
    int models, materials, pictures;
};

static bool open_beside(void *user, const char *name, lam_bytes *bytes, lam_error *error)
{
    struct counts *counts = user;
    const char *text = NULL;
    if (strcmp(name, "a.obj") == 0 || strcmp(name, "in/a.obj") == 0)
        text = "mtllib a.mtl\n" TRIANGLE "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 2\n";
    if (strcmp(name, "a.mtl") == 0 || strcmp(name, "in/a.mtl") == 0)
        text = "newmtl red\nKd 1 0 0\nKs x\nnewmtl blue\nKd 0 0 1\n";
    if (strcmp(name, "sky.ppm") == 0)
        text = "P6\n2 1\n255\nabcdef";
    if (!text) {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    counts->models += strstr(name, ".obj") != NULL;
    counts->materials += strstr(name, ".mtl") != NULL;
    counts->pictures += strstr(name, ".ppm") != NULL;
    bytes->data = strdup(text);
    bytes->size = strlen(text);
    return true;
}

static lam_scene *load_objects(const char *objects, struct counts *counts)
{
    char *text;
    lam_error error;
    assert_true(asprintf(&text, "{\"lambent\": 1, \"objects\": [%s]}", objects) > 0);
    *counts = (struct counts){0};
    lam_load_params params = {.threads = 1, .open = open_beside, .user = counts};
    lam_scene *scene = lam_scene_load_memory(text, strlen(text), "s.json", &params, NULL, &error);
    if (!scene)
        fail_msg("%s: %s", objects, error.text);
    free(text);
    return scene;
}

static const char *material_of(const lam_scene *scene, int object, int part, lam_rgba *diffuse)
{
    const lam_mesh *mesh = lam_scene_mesh(scene, lam_scene_object(scene, object)->mesh);
    const lam_material *material = lam_scene_material(scene, mesh->parts[part].material);
    *diffuse = material->diffuse;
    return material->name;
}

#define A "{\"file\": \"a.obj\"}"

// The same model is read once, and objects that do not change it share one mesh.
TEST(test_shared)
{
    static const struct {
        const char *objects;
        int meshes, materials, models;
    } rows[] = {
        {A ", " A ", " A, 1, 2, 1},
        {A ", {\"file\": \"./a.obj\"}, {\"file\": \"in/../a.obj\"}, {\"file\": \"a.obj\"}, {\"file\": \"./a.obj\"}", 1,
         2, 3},
        {A ", {\"file\": \"in/a.obj\"}", 2, 4, 2},
        {"{\"shape\": \"cube\"}, {\"shape\": \"cube\", \"name\": \"x\", \"transform\": [[\"scale\", 2]], \"material\": "
         "\"gold\", \"cull\": \"back\"}, {\"shape\": \"cube\", \"two_sided\": false}",
         1, 1, 0},
        {"{\"shape\": \"cube\"}, {\"shape\": \"cube\", \"radius\": 2}, {\"shape\": \"cube\", \"slices\": 3}, "
         "{\"shape\": \"cube\", \"stacks\": 3}, {\"shape\": \"cone\"}",
         5, 0, 0},
        {"{\"shape\": \"cube\"}, {\"shape\": \"cube\", \"normals\": \"facet\"}, {\"shape\": \"cube\", \"normals\": "
         "\"smooth\"}, {\"shape\": \"cube\", \"normals\": \"smooth\", \"crease_angle\": 20}, {\"shape\": \"cube\", "
         "\"normals\": \"smooth\", \"crease_angle\": 20}",
         4, 0, 0},
        {"{\"shape\": \"cone\"}, {\"shape\": \"cone\", \"tangents\": \"field\"}, {\"shape\": \"cone\"}, {\"shape\": "
         "\"cone\", \"tangents\": \"field\"}",
         2, 0, 0},
#define CHANGED(n) "{\"file\": \"a.obj\", \"materials\": {\"red\": {\"shininess\": " #n "}}}"
        {A ", " CHANGED(3) ", " A ", " CHANGED(4) ", " CHANGED(3) ", " A, 3, 6, 1},
#define PARTS "{\"file\": \"a.obj\", \"parts\": [null, {\"diffuse\": [0, 1, 0]}]}"
        {PARTS ", " A ", " PARTS ", " A, 2, 5, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct counts counts;
        AUTO_SCENE scene = load_objects(rows[i].objects, &counts);
        if (lam_scene_mesh_count(scene) != rows[i].meshes || lam_scene_material_count(scene) != rows[i].materials ||
            counts.models != rows[i].models)
            fail_msg("row %zu: %d meshes, %d materials, %d models opened", i, lam_scene_mesh_count(scene),
                     lam_scene_material_count(scene), counts.models);
        // The warning about the material file appears once for each model that is read.
        int warnings = 0;
        while (lam_scene_warning(scene, warnings))
            warnings++;
        assert_int_equal(warnings, rows[i].models == 0 ? 0 : rows[i].models == 2 ? 2 : 1);
        // Meshes that are not shared share their vertices if possible.
        for (int k = 0; k < lam_scene_object_count(scene); k++)
            assert_non_null(lam_scene_mesh(scene, lam_scene_object(scene, k)->mesh)->normals);
    }
}

// An object's changes do not affect the others.
TEST(test_changes)
{
    struct counts counts;
    lam_scene *scene =
        load_objects(CHANGED(3) ", " PARTS ", " A ", {\"file\": \"a.obj\", \"tangents\": \"field\"}", &counts);
    lam_rgba diffuse;
    for (int i = 0; i < 4; i++) {
        assert_string_equal(material_of(scene, i, 0, &diffuse), "red");
        assert_true(diffuse.r == 1 && diffuse.b == 0);
        const lam_mesh *mesh = lam_scene_mesh(scene, lam_scene_object(scene, i)->mesh),
                       *first = lam_scene_mesh(scene, lam_scene_object(scene, 0)->mesh);
        assert_ptr_equal(mesh->positions, first->positions);
        assert_ptr_equal(mesh->normals, first->normals);
        float shininess = lam_scene_material(scene, mesh->parts[0].material)->shininess;
        assert_true(shininess == (i == 0 ? 3 : 32));
        const char *name = material_of(scene, i, 1, &diffuse);
        assert_true(i == 1 ? !name && diffuse.g == 1 : strcmp(name, "blue") == 0);
    }
    lam_vec3 low, high;
    assert_true(lam_scene_bounds(scene, &low, &high) && low.x == 0 && high.x == 1);
    lam_scene_free(scene);
}

// A scene file describes its own transparency: unlike a model file, a scene may be fully transparent.
TEST(test_clear)
{
    static const char *const rows[] = {
        "{\"file\": \"a.obj\", \"materials\": {\"red\": {\"opacity\": 0}, \"blue\": {\"opacity\": 0}}}",
        "{\"shape\": \"cube\", \"material\": {\"diffuse\": [1, 1, 1, 0]}}",
        "{\"shape\": \"cube\", \"material\": \"opacity=0\"}",
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct counts counts;
        AUTO_SCENE scene = load_objects(rows[i], &counts);
        for (int k = 0; lam_scene_warning(scene, k); k++)
            assert_null(strstr(lam_scene_warning(scene, k), "opaque"));
        assert_true(lam_scene_material(scene, 0)->diffuse.a == 0);
    }
}

// Objects that share a mesh are written separately, and are restored.
TEST(test_written)
{
    char shared[] = "/tmp/lambent-shared-XXXXXX", path[2][64], model[64];
    assert_non_null(mkdtemp(shared));
    snprintf(model, sizeof model, "%s/m.obj", shared);
    FILE *file = fopen(model, "w");
    fputs(TRIANGLE "f 1 2 3\n", file);
    fclose(file);
    for (int i = 0; i < 2; i++)
        snprintf(path[i], sizeof path[i], "%s/%d.json", shared, i);
    file = fopen(path[0], "w");
    fputs("{\"lambent\": 1, \"objects\": [{\"file\": \"m.obj\", \"name\": \"a\"}, {\"file\": \"m.obj\", \"transform\": "
          "[[\"translate\", 3, 0, 0]], \"material\": {\"diffuse\": [1, 0, 0]}}, {\"shape\": \"cube\"}, {\"file\": "
          "\"m.obj\", \"cull\": \"back\"}, {\"shape\": \"cube\", \"transform\": [[\"scale\", 4]]}]}",
          file);
    fclose(file);
    lam_error error;
    lam_scene *scene = lam_scene_load(path[0], NULL, NULL, &error), *back;
    SUCCEEDS(scene);
    assert_true(lam_scene_save(scene, NULL, path[1], &error));
    back = lam_scene_load(path[1], NULL, NULL, &error);
    SUCCEEDS(back);
    assert_int_equal(lam_scene_object_count(back), 5);
    assert_int_equal(lam_scene_mesh_count(back), 2);
    for (int i = 0; i < 5; i++) {
        const lam_object *a = lam_scene_object(scene, i), *b = lam_scene_object(back, i);
        assert_memory_equal(&a->transform, &b->transform, sizeof a->transform);
        assert_int_equal(a->mesh, b->mesh);
        assert_int_equal(a->cull, b->cull);
        assert_int_equal(a->material >= 0, b->material >= 0);
    }
    lam_scene_free(scene);
    lam_scene_free(back);
    unlink(path[0]);
    unlink(path[1]);
    unlink(model);
    rmdir(shared);
}

// A thousand objects of one model need little more memory than one, even with changes of their own.
TEST(test_memory)
{
    enum { OBJECTS = 1000 };
    for (int kind = 0; kind < 2; kind++) {
        char *text = malloc(OBJECTS * 100 + 100), *at = text + sprintf(text, "{\"lambent\": 1, \"objects\": [");
        for (int i = 0; i < OBJECTS; i++)
            at += kind ? sprintf(at, "%s{\"file\": \"a.obj\", \"materials\": {\"red\": {\"shininess\": %d}}}",
                                 i ? ", " : "", i)
                       : sprintf(at, "%s{\"shape\": \"sphere\", \"material\": \"gold\"}", i ? ", " : "");
        strcpy(at, "]}");
        struct counts counts = {0};
        lam_load_params params = {.threads = 1, .open = open_beside, .user = &counts};
        lam_control control = {.memory_limit_bytes = 24 << 20};
        lam_error error;
        AUTO_SCENE scene = lam_scene_load_memory(text, strlen(text), "s.json", &params, &control, &error);
        SUCCEEDS(scene);
        assert_int_equal(lam_scene_object_count(scene), OBJECTS);
        assert_int_equal(counts.models, kind);
        free(text);
    }
}

// --- folders

static void write_bytes(const char *name, const char *bytes)
{
    FILE *file = fopen(in_folder(name), "wb");
    assert_non_null(file);
    fputs(bytes, file);
    fclose(file);
}

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/lambent-scene-XXXXXX");
    if (!mkdtemp(folder) || mkdir(in_folder("in"), 0700) || mkdir(in_folder("in/sub"), 0700))
        return -1;
    static const char *const places[] = {"", "in/", "in/sub/"};
    for (int i = 0; i < 3; i++) {
        char name[32];
        snprintf(name, sizeof name, "%sm.obj", places[i]);
        write_bytes(name, TRIANGLE "f 1 2 3\n");
        snprintf(name, sizeof name, "%ssky.ppm", places[i]);
        write_bytes(name, "P6\n2 1\n255\nabcdef");
    }
    return symlink("../m.obj", in_folder("in/out.obj")) || symlink("sub/m.obj", in_folder("in/link.obj")) ||
                   symlink("../sky.ppm", in_folder("in/out.ppm")) || mkfifo(in_folder("in/pipe"), 0600)
               ? -1
               : 0;
}

// The files that a load looks for: the model, files that it names, and files of a scene file's models; also missing
// ones.
TEST(test_files, .setup_func = make_folder, .teardown_func = remove_folder)
{
    write_bytes("in/m.obj", "mtllib sub/m.mtl\nmtllib none.mtl\n" TRIANGLE "usemtl a\nf 1 2 3\n");
    write_bytes("in/sub/m.mtl", "newmtl a\nmap_Kd ./sub/../m.ppm\nmap_Kd sky.ppm\n");
    write_bytes("in/s.json", "{\"lambent\": 1, \"objects\": [{\"file\": \"m.obj\"}, {\"file\": \"m.obj\"}], "
                             "\"environment\": {\"equirectangular\": \"sub/sky.ppm\"}}");
    static const char *const models[] = {"in/m.obj", "in/s.json"};
    static const char *const expected[2][6] = {
        {"in/m.obj", "in/none.mtl", "in/sky.ppm", "in/sub/m.mtl", NULL},
        {"in/s.json", "in/m.obj", "in/none.mtl", "in/sky.ppm", "in/sub/m.mtl", "in/sub/sky.ppm"}};
    for (int i = 0; i < 2; i++) {
        lam_error error;
        AUTO_SCENE scene = lam_scene_load(in_folder(models[i]), NULL, NULL, &error);
        if (!scene)
            fail_msg("%s: %s", models[i], error.text);
        for (int k = 0; k < 6; k++) {
            const char *found = lam_scene_file(scene, k);
            if (!expected[i][k])
                assert_null(found);
            else
                assert_string_equal(found, in_folder(expected[i][k]));
        }
        assert_null(lam_scene_file(scene, 6));
        assert_null(lam_scene_file(scene, -1));
    }
    assert_null(lam_scene_file(NULL, 0));
    struct counts counts;
    AUTO_SCENE scene = load_objects(A, &counts);
    assert_string_equal(lam_scene_file(scene, 0), "a.mtl"); // the names passed to the function
    assert_string_equal(lam_scene_file(scene, 1), "a.obj");
}

// A scene file's own folder is the root for its models and pictures; models_anywhere lifts this.
TEST(test_root, .setup_func = make_folder, .teardown_func = remove_folder)
{
    char absolute_in[100], absolute_out[100];
    snprintf(absolute_in, sizeof absolute_in, "%s", in_folder("in/sub/m.obj"));
    snprintf(absolute_out, sizeof absolute_out, "%s", in_folder("m.obj"));
    const struct {
        const char *model, *picture;
        const char *sentence; // NULL if it is read
        bool anywhere;        // then it is read with models_anywhere
    } rows[] = {
        {"m.obj", "sky.ppm", NULL, true},
        {"sub/m.obj", "sub/sky.ppm", NULL, true},
        {"sub/../m.obj", "sub/.././sky.ppm", NULL, true},
        {"../in/m.obj", "../in/sky.ppm", NULL, true},
        {"link.obj", NULL, NULL, true},
        {absolute_in, NULL, NULL, true},
        {"../m.obj", "../sky.ppm", "leads out of the folder", true},
        {"sub/../../m.obj", NULL, "leads out of the folder", true},
        {"out.obj", "out.ppm", "leads out of the folder", true},
        {absolute_out, NULL, "leads out of the folder", true},
        {"pipe", "pipe", "is a pipe, expected a regular file", false},
        {"sub", "sub", "is a directory, expected a file", false},
        {"none.obj", "none.ppm", "No such file", false},
        {"-", "-", "No such file", false}, // not standard input
    };
    for (size_t i = 0; i < 2 * (sizeof rows / sizeof *rows); i++) {
        const char *name = i % 2 ? rows[i / 2].picture : rows[i / 2].model, *sentence = rows[i / 2].sentence;
        if (!name)
            continue;
        char text[400], place[64];
        snprintf(text, sizeof text,
                 i % 2 ? "{\"lambent\": 1, \"environment\": {\"equirectangular\": \"%s\"}, \"objects\": [{\"shape\": "
                         "\"cube\", \"slices\": 4}]}"
                       : "{\"lambent\": 1, \"objects\": [{\"file\": \"%s\"}]}",
                 name);
        write_bytes("in/s.json", text);
        for (int anywhere = 0; anywhere < 2; anywhere++) {
            lam_error error = {0};
            lam_scene *scene =
                lam_scene_load(in_folder("in/s.json"), &(lam_load_params){.models_anywhere = anywhere}, NULL, &error);
            bool good = !sentence || (anywhere && rows[i / 2].anywhere);
            snprintf(place, sizeof place, "in/s.json: %s: ", i % 2 ? "environment.equirectangular" : "objects[0].file");
            if (good != (scene != NULL) || (!good && (!strstr(error.text, sentence) || !strstr(error.text, place) ||
                                                      error.code != LAM_CANNOT_READ)))
                fail_msg("%s: %s", name, scene ? "was read" : error.text);
            lam_scene_free(scene);
        }
    }
    // The same for six faces.
    write_bytes("in/s.json", "{\"lambent\": 1, \"environment\": {\"faces\": [\"sky.ppm\", \"sky.ppm\", \"../sky.ppm\", "
                             "\"sky.ppm\", \"sky.ppm\", \"sky.ppm\"]}, \"objects\": [{\"shape\": \"cube\"}]}");
    lam_error error;
    assert_null(lam_scene_load(in_folder("in/s.json"), NULL, NULL, &error));
    assert_non_null(strstr(error.text, "environment.faces: "));
    assert_non_null(strstr(error.text, "/in/../sky.ppm: leads out of the folder"));
}

// The caller's function gets names within the folder, for models, their files, and pictures; others are refused.
TEST(test_function)
{
    struct counts counts = {0};
    lam_load_params params = {.threads = 1, .open = open_beside, .user = &counts, .models_anywhere = true};
    static const char good[] =
        "{\"lambent\": 1, \"environment\": {\"equirectangular\": \"in/../sky.ppm\"}, \"objects\": [{\"file\": "
        "\".//in/./a.obj\"}]}";
    lam_error error;
    lam_scene *scene = lam_scene_load_memory(good, sizeof good - 1, "s.json", &params, NULL, &error);
    SUCCEEDS(scene);
    assert_true(counts.models == 1 && counts.materials == 1 && counts.pictures == 1);
    assert_non_null(lam_scene_environment(scene));
    assert_string_equal(lam_scene_warning(scene, 0),
                        "in/a.mtl:3: found 'x', expected a number; the statement is ignored");
    lam_scene_free(scene);
    static const char *const names[] = {"../a.obj", "/a.obj", "in/../../a.obj", "in/..", ".", "//a.obj"};
    for (size_t i = 0; i < 2 * (sizeof names / sizeof *names); i++) {
        char text[200];
        snprintf(text, sizeof text,
                 i % 2 ? "{\"lambent\": 1, \"environment\": {\"equirectangular\": \"%s\"}, \"objects\": [{\"shape\": "
                         "\"cube\"}]}"
                       : "{\"lambent\": 1, \"objects\": [{\"file\": \"%s\"}]}",
                 names[i / 2]);
        assert_null(lam_scene_load_memory(text, strlen(text), "s.json", &params, NULL, &error));
        assert_int_equal(error.code, LAM_CANNOT_READ);
        if (!strstr(error.text, "which is outside the scene file's folder"))
            fail_msg("%s: %s", names[i / 2], error.text);
    }
    // Without a function and without a folder, nothing can be opened.
    assert_null(lam_scene_load_memory(good, sizeof good - 1, "s.json", NULL, NULL, &error));
    assert_non_null(strstr(error.text, "cannot be opened: the model has no folder"));
}
