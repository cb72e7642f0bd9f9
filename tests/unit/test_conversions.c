// test_conversions.c: converts models to every format that can be written. If no loss is reported, both files give equal
// pictures within 1/255 per channel.
#include "test.h"
#include "loading.h"
#include "share.h"
#include "temporary_folder.h"

#include <dirent.h>
#include <strings.h>
#include <sys/stat.h>

enum { SIZE = 64, SHARE = 24, FAST_BYTES = 2000000 };
static size_t seen, compared, differing;
static struct {
    size_t whole, losing;
} counts[8]; // per format

static bool ends_with(const char *text, const char *end)
{
    return strlen(text) > strlen(end) && strcasecmp(text + strlen(text) - strlen(end), end) == 0;
}

static bool draw(const char *path, lam_image *image)
{
    const lam_render_params params = {.threads = 1};
    lam_error error = {0};
    *image = (lam_image){.width = SIZE, .height = SIZE};
    return lam_render(path, &params, image, NULL, &error);
}

static void save(const lam_export *files)
{
    for (int i = 0; lam_export_file_name(files, i); i++) {
        lam_bytes bytes = lam_export_file(files, i);
        FILE *file = fopen(in_folder(lam_export_file_name(files, i)), "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes.data, 1, bytes.size, file), bytes.size);
        assert_int_equal(fclose(file), 0);
    }
}

// Compares the pictures of a model and of its conversion if there are no losses. glTF draws a model without materials in
// white plastic, under other lights; convert says nothing about this, because the model has lost nothing.
static void check_format(const char *path, const lam_scene *scene, const lam_image *before, int format)
{
    char name[32];
    lam_image after;
    lam_error error = {0};
    snprintf(name, sizeof name, "model.%s", lam_export_format(format));
    const lam_export_params params = {.name = name};
    lam_export *files = lam_scene_export(scene, lam_export_format(format), &params, &error);
    if (!files)
        return; // for example, lines as STL
    counts[format].losing += lam_export_loss(files, 0) != NULL;
    if (!lam_export_loss(files, 0)) {
        save(files);
        assert_true(draw(in_folder(name), &after));
        int largest = 0;
        for (size_t i = 0; i < (size_t)4 * SIZE * SIZE; i++) {
            int difference = abs(((const uint8_t *)before->pixels)[i] - ((const uint8_t *)after.pixels)[i]);
            largest = difference > largest ? difference : largest;
        }
        lam_image_free(&after);
        counts[format].whole++;
        compared++;
        bool classic = lam_scene_material_count(scene) == 0;
        for (int i = 0; i < lam_scene_material_count(scene); i++)
            classic |= !lam_scene_material(scene, i)->physical;
        const bool other = largest > 1 && !(classic && strcmp(name, "model.glb") == 0);
        differing += other;
        if (other)
            print_message("%s as %s: no loss is reported, and the pictures differ by %d/255\n", path,
                          lam_export_format(format), largest);
    }
    lam_export_free(files);
}

static void check_model(const char *path)
{
    lam_image before;
    lam_scene *scene = draw(path, &before) ? lam_scene_load(path, NULL, NULL, NULL) : NULL;
    for (int i = 0; scene && lam_export_format(i); i++)
        check_format(path, scene, &before, i);
    if (scene)
        lam_image_free(&before);
    lam_scene_free(scene);
}

// Checks one of `share` models of a folder, and all in the long test.
static void walk(const char *from, size_t share)
{
    static const char *const endings[] = {".gltf", ".glb", ".obj", ".ply", ".stl", ".3mf"};
    struct dirent **names;
    int count = scandir(from, &names, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        char path[1400];
        struct stat about;
        bool model = false;
        snprintf(path, sizeof path, "%s/%s", from, names[i]->d_name);
        bool hidden = names[i]->d_name[0] == '.';
        free(names[i]);
        if (hidden || stat(path, &about) != 0)
            continue;
        for (size_t k = 0; k < sizeof endings / sizeof *endings; k++)
            model |= ends_with(path, endings[k]);
        if (S_ISDIR(about.st_mode))
            walk(path, share);
        else if (model && is_taken(seen++, share) && (is_long() || about.st_size < FAST_BYTES))
            check_model(path);
    }
    if (count >= 0)
        free(names);
}

static void finish(void)
{
    for (int i = 0; lam_export_format(i); i++)
        print_message("%s: %zu conversions without losses, %zu with losses\n", lam_export_format(i), counts[i].whole,
                      counts[i].losing);
    assert_int_equal(differing, 0);
}

TEST(test_own_models)
{
    walk(MODELS, 1);
    walk(CORPUS, 1);
    finish();
    assert_true(compared > 20);
}

TEST(test_shared_models)
{
    const char *models = getenv("LAMBENT_MODELS");
    size_t before = seen;
    walk(models ? models : "../shared/models", SHARE);
    if (seen == before) {
        print_message("the shared models are not there\n");
        skip();
    }
    finish();
}

static int make_folder(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/lambent-conversions-XXXXXX");
    return mkdtemp(folder) ? 0 : 1;
}

FIXTURE(make_folder, remove_folder)
