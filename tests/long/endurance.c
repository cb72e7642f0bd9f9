// endurance.c: tests that nothing drifts: endurance N cpu|gl draws N pictures in one process, one model after another.
// Each picture must have the same bytes as the first of its model, and memory, open files and threads must stay
// constant after the first tenth. Between the models there are damaged ones, whose errors must leave no resources
// behind. Models are loaded and pictures encoded again each time; the device is recreated every 500 pictures.
#include <lambent/lambent.h>

#include "../fnv.h"

#include <dirent.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SIDE = 48, SKIPPED = 77, NEW_DEVICE = 500, GROWTH_MAX_KB = 4096 };

static const char cube[] = "mtllib none.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n"
                           "v -1 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
static const char triangle[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
    "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],\"materials\":[{\"pbrMetallicRoughness\":{"
    "\"baseColorFactor\":[1,0.5,0.1,1],\"roughnessFactor\":0.4}}],\"accessors\":[{\"bufferView\":0,\"componentType\":"
    "5126,"
    "\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":"
    "36,"
    "\"uri\":\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
static const char scene[] = "{\"lambent\":1,\"objects\":[{\"shape\":\"torus\"},{\"shape\":\"sphere\",\"slices\":24,"
                            "\"stacks\":12}],\"lights\":[{\"type\":\"point\",\"position\":[3,4,5]}]}";
static const char cloud[] =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "end_header\n0 0 0\n1 0 0\n0 1 0\n";
static const char stl[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                          "endfacet\nendsolid a\n";
static const char bad_indices[] = "v 0 0 0\nf 1 2 3\n", bad_json[] = "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[[[[";

static const struct model {
    const char *name, *text;
    bool good;
} models[] = {{"cube.obj", cube, true},    {"triangle.gltf", triangle, true}, {"bad.obj", bad_indices, false},
              {"scene.json", scene, true}, {"cloud.ply", cloud, true},        {"bad.gltf", bad_json, false},
              {"triangle.stl", stl, true}};
enum { MODELS = sizeof models / sizeof *models };

static _Noreturn void give_up(const char *what, int picture, const lam_error *error)
{
    printf("not ok 1 - picture %d: %s%s%s\n", picture, what, error ? ": " : "", error ? error->text : "");
    exit(1);
}

static long resident_kb(void)
{
    long pages = 0, resident = 0;
    malloc_trim(0); // memory that free() keeps does not count
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%ld %ld", &pages, &resident) != 2)
        resident = -1;
    if (file)
        fclose(file);
    return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

static int entries(const char *path)
{
    int count = 0;
    DIR *folder = opendir(path);
    while (folder && readdir(folder))
        count++;
    if (folder)
        closedir(folder);
    return count;
}

static lam_device *make_device(bool gl, lam_error *error)
{
    return gl ? lam_device_gl(NULL, error) : lam_device_cpu(&(lam_cpu_params){.threads = 2}, error);
}

// Draws a model into a PNG and returns its hash; 0 if the model is refused.
static uint64_t draw(lam_device *device, const struct model *model, int picture)
{
    lam_error error = {0};
    lam_scene *loaded = lam_scene_load_memory(model->text, strlen(model->text), model->name,
                                              &(lam_load_params){.threads = 2}, NULL, &error);
    if (!loaded) {
        if (model->good)
            give_up(model->name, picture, &error);
        return 0;
    }
    lam_image image;
    lam_bytes png = {0};
    lam_camera camera = lam_camera_fit(loaded, SIDE, SIDE, NULL);
    if (!lam_image_make(&image, SIDE, SIDE, LAM_RGBA8, &error) ||
        !lam_draw(device, loaded, &camera, NULL, &image, NULL, &error) ||
        !lam_image_encode(&image, "png", NULL, &png, &error))
        give_up(model->name, picture, &error);
    uint64_t hash = hash_of(png.data, png.size);
    lam_bytes_free(&png);
    lam_image_free(&image);
    lam_scene_free(loaded);
    return hash;
}

struct state {
    long kb;
    int files, threads;
};

static struct state measure(void)
{
    return (struct state){resident_kb(), entries("/proc/self/fd"), entries("/proc/self/task")};
}

int main(int count, char **words)
{
    bool gl = count > 2 && strcmp(words[2], "gl") == 0;
    int pictures = count > 1 ? atoi(words[1]) : 300, warm = pictures / 10 + 2 * MODELS;
    uint64_t first[MODELS] = {0};
    struct state before = {0}, now = {0};
    lam_error error = {0};
    lam_device *device = make_device(gl, &error);
    if (!device && gl && error.code == LAM_UNSUPPORTED) {
        printf("ok 1 - endurance on OpenGL # SKIP %s\n", error.text);
        return SKIPPED;
    }
    for (int i = 0; i < pictures; i++) {
        if (i % NEW_DEVICE == NEW_DEVICE - 1) {
            lam_device_free(device);
            device = make_device(gl, &error);
        }
        if (!device)
            give_up("the device", i, &error);
        int m = i % MODELS;
        uint64_t hash = draw(device, &models[m], i);
        if (!first[m])
            first[m] = hash;
        if (hash != first[m])
            give_up("the picture has other bytes than the first of its model", i, NULL);
        if ((hash != 0) != models[m].good)
            give_up("a damaged model is drawn", i, NULL);
        if (i == warm)
            before = measure();
    }
    now = measure();
    lam_device_free(device);
    bool flat = now.kb - before.kb <= GROWTH_MAX_KB, same = now.files == before.files && now.threads == before.threads;
    printf("%sok 1 - %d pictures on %s: %ld kB at picture %d, %ld kB at the end; %d open files, %d threads\n",
           flat && same ? "" : "not ", pictures, gl ? "OpenGL" : "the CPU", before.kb, warm, now.kb, now.files - 2,
           now.threads - 2);
    return flat && same ? 0 : 1;
}
