// target_library.c: fuzz target for a scene in a program that uses the library: draws it, asks what is at a pixel, has
// the pixel explained, prints the shaders, and exports it to every format. The exported files are loaded again.
#include "picture_options.h"

#include <stdio.h>

static const lam_control control = {.memory_limit_bytes = 256 << 20, .time_limit_s = 20};

// Invariant of every call: a result, or an error with a message.
static void check(bool ok, const lam_error *error)
{
    note_sentence(ok ? "" : error->text);
    if (!ok && (error->code == LAM_OK || !error->text[0]))
        abort();
}

// The explained pixel has the bytes of the drawn pixel. The picked object exists.
static void ask(lam_device *device, const lam_scene *scene, const lam_camera *camera, const struct options *options)
{
    static float pixels[SIDE_MAX * SIDE_MAX * 4];
    lam_image image = options->image;
    image.pixels = pixels;
    lam_error error = {0};
    bool drawn = lam_draw(device, scene, camera, &options->draw, &image, &control, &error);
    check(drawn, &error);
    int x = image.width / 2, y = image.height / 3;
    lam_explanation *explanation = lam_explain(device, scene, camera, &options->draw, image.width, image.height,
                                               image.format, x, y, &control, &error);
    check(explanation, &error);
    const uint8_t *bytes = (const uint8_t *)pixels + 4 * (y * image.width + x);
    if (drawn && explanation && image.format == LAM_RGBA8 && options->draw.output == LAM_OUTPUT_PICTURE &&
        memcmp(explanation->bytes, bytes, 4) != 0)
        abort();
    lam_explanation_free(explanation);
    lam_picked picked;
    const lam_pick_pixel pixel = {.width = image.width, .height = image.height, .x = x, .y = y};
    bool ok = lam_pick(scene, camera, &options->draw, &pixel, &control, &picked, &error);
    check(ok, &error);
    if (ok && (picked.object < -1 || picked.object >= lam_scene_object_count(scene) ||
               (picked.object >= 0 && (picked.mesh < 0 || picked.mesh >= lam_scene_mesh_count(scene)))))
        abort();
}

static void print_shaders(const lam_scene *scene, const lam_camera *camera, const struct options *options, int choice)
{
    lam_error error = {0};
    lam_shader_mistake mistake = {0};
    lam_shader_params params = {.glsl = (lam_glsl)(choice % LAM_GLSL_COUNT),
                                .lights = (lam_shader_lights)(choice / 3 % LAM_SHADER_LIGHTS_COUNT),
                                .style = (lam_shader_style)(choice / 12 % LAM_SHADER_STYLE_COUNT),
                                .products = choice / 24 & 1};
    if (params.style == LAM_SHADER_STYLE_LECTURE && choice & 64 && lam_shader_mistake_row(choice % 32, &mistake))
        params.mistake = mistake.id;
    lam_shader *shader = lam_shader_make(scene, camera, &options->draw, options->image.width, options->image.height, -1,
                                         &params, &error);
    check(shader, &error);
    if (shader && (!strstr(shader->vertex, "main") || !strstr(shader->fragment, "main")))
        abort();
    lam_shader_free(shader);
}

struct files {
    const lam_export *export;
};

static bool open_exported(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    const struct files *files = user;
    const char *found;
    for (int i = 0; (found = lam_export_file_name(files->export, i)); i++)
        if (strcmp(found, name) == 0)
            return give_bytes(lam_export_file(files->export, i).data, lam_export_file(files->export, i).size, bytes);
    *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
    return false;
}

static void export_all(const lam_scene *scene, const lam_camera *camera, const struct options *options)
{
    const char *format;
    for (int f = 0; (format = lam_export_format(f)); f++) {
        lam_error error = {0};
        const lam_export_params params = {.camera = options->way & 1 ? camera : NULL, .control = &control};
        lam_export *result = lam_scene_export(scene, format, &params, &error);
        check(result, &error);
        for (int i = 0; result && lam_export_loss(result, i); i++)
            note_sentence(lam_export_loss(result, i));
        if (result && options->way & 2) {
            struct files files = {result};
            const lam_load_params load = {.threads = 1, .open = open_exported, .user = &files};
            lam_bytes bytes = lam_export_file(result, 0);
            lam_scene *again =
                lam_scene_load_memory(bytes.data, bytes.size, lam_export_file_name(result, 0), &load, &control, &error);
            if (!again && error.code != LAM_LIMIT && error.code != LAM_MACHINE) {
                fprintf(stderr, "%s cannot be read again: %s\n", format, error.text);
                abort();
            }
            lam_scene_free(again);
        }
        lam_export_free(result);
    }
    lam_bytes bytes = {0};
    lam_error error = {0};
    bool ok = lam_lights_encode(scene, options->draw.rig, options->way & 4, &bytes, &error);
    check(ok, &error);
    lam_bytes_free(&bytes);
}

// Cuts the scene by a plane, and removes the cut if the bytes ask for that.
static void cut(lam_scene *scene, const uint8_t *bytes)
{
    lam_error error;
    const lam_section section = {.normal = {bytes[0] - 127.5, bytes[1] - 127.5, bytes[2] - 127.5},
                                 .distance = bytes[3] / 255.0,
                                 .relative = true,
                                 .color = {1, 0, 0, bytes[3] & 1}};
    check(lam_scene_set_sections(scene, &section, 1, &control, &error), &error);
    if (bytes[3] & 2)
        check(lam_scene_set_sections(scene, NULL, 0, &control, &error), &error);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static lam_device *devices[LAM_ISA_COUNT];
    struct options options;
    lam_scene *scene = scene_of_input(data, size, &options);
    if (!scene)
        return 0;
    options.image.width = 1 + options.image.width % 16;
    options.image.height = 1 + options.image.height % 16;
    lam_device **device = &devices[options.isa[0]];
    if (!*device && !(*device = lam_device_cpu(&(lam_cpu_params){.threads = 1, .isa = options.isa[0]}, NULL)))
        abort();
    if (data[23] & 64)
        cut(scene, data + 16);
    const lam_camera camera = camera_of(scene, &options);
    ask(*device, scene, &camera, &options);
    print_shaders(scene, &camera, &options, data[23]);
    export_all(scene, &camera, &options);
    lam_scene_free(scene);
    return 0;
}
