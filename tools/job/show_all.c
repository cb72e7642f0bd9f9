// show_all.c: implements --show all: writes the picture and all terms of its light as layers of one EXR picture.
#include "show_all.h"

#include <lambent/light.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "output.h"

bool show_is_all(const struct options *options)
{
    return options->picture.show && strcmp(options->picture.show, "all") == 0;
}

bool show_all_check(const struct job *job, lam_error *error)
{
    return strcmp(job->format, "exr") == 0 ||
           complain(error, LAM_BAD_ARGUMENT, "option '--show all' needs a picture format with layers; use -o FILE.exr");
}

static const lam_output terms[] = {LAM_OUTPUT_AMBIENT, LAM_OUTPUT_DIFFUSE, LAM_OUTPUT_SPECULAR, LAM_OUTPUT_EMISSION,
                                   LAM_OUTPUT_REFLECTION};
enum { TERMS = sizeof terms / sizeof terms[0], NAME_ROOM = 96 };

struct layers {
    int count;
    lam_layer *list;
    lam_image *images;
    char (*names)[NAME_ROOM];
};

// Draws one more layer with the picture's parameters, but with the output `show`.
static bool add(struct layers *layers, struct job *job, lam_output show, int light, const lam_control *control,
                lam_error *error)
{
    int i = layers->count;
    lam_draw_params params = job->draw;
    params.output = show;
    params.output_light = light;
    if (!lam_image_make(&layers->images[i], job->image.width, job->image.height, LAM_RGBA32F, error))
        return false;
    layers->list[i] = (lam_layer){.name = layers->names[i], .image = &layers->images[i]};
    layers->count++;
    return lam_draw(job->device, job->scene, &job->camera, &params, &layers->images[i], control, error);
}

static bool draw_all(struct layers *layers, struct job *job, const lam_light *lights, int light_count,
                     const lam_control *control, lam_error *error)
{
    layers->list[layers->count++] = (lam_layer){.image = &job->image};
    bool ok = true;
    for (int i = 0; ok && i < TERMS; i++) {
        snprintf(layers->names[layers->count], NAME_ROOM, "%s", lam_output_name(terms[i]));
        ok = add(layers, job, terms[i], 0, control, error);
    }
    for (int i = 0; ok && i < light_count; i++) {
        // A dot in a layer's name would start a nested layer; numbers distinguish lights with the same name.
        char *name = layers->names[layers->count];
        snprintf(name, NAME_ROOM, "light.%d%s%.60s", i + 1, lights[i].name ? "-" : "",
                 lights[i].name ? lights[i].name : "");
        for (char *c = name + strlen("light."); *c; c++)
            *c = *c == '.' ? '_' : *c;
        ok = add(layers, job, LAM_OUTPUT_LIGHT, i, control, error);
    }
    return ok;
}

static bool save_layers(const struct layers *layers, const struct job *job, lam_error *error)
{
    lam_bytes bytes = {0};
    uint64_t size;
    if (job->picture_bytes)
        return lam_image_encode_layers(layers->list, layers->count, job->picture_bytes, error);
    bool ok = lam_image_encode_layers(layers->list, layers->count, &bytes, error) &&
              output_save_bytes(&bytes, job->output, job->options->picture.durable, &size, error);
    lam_bytes_free(&bytes);
    return ok;
}

bool show_all_write(struct job *job, const lam_control *control, lam_error *error)
{
    int light_count = lam_draw_lights(job->scene, job->draw.rig, job->draw.ground, NULL, 0);
    size_t room = 1 + TERMS + (size_t)light_count;
    lam_light *lights = calloc((size_t)light_count + 1, sizeof *lights);
    struct layers layers = {.list = calloc(room, sizeof *layers.list),
                            .images = calloc(room, sizeof *layers.images),
                            .names = calloc(room, sizeof *layers.names)};
    bool ok = lights && layers.list && layers.images && layers.names;
    if (!ok)
        complain(error, LAM_MACHINE, "out of memory");
    if (ok) {
        lam_draw_lights(job->scene, job->draw.rig, job->draw.ground, lights, light_count);
        ok = draw_all(&layers, job, lights, light_count, control, error) && save_layers(&layers, job, error);
    }
    for (size_t i = 0; layers.images && i < room; i++)
        lam_image_free(&layers.images[i]);
    free(lights);
    free(layers.list);
    free(layers.images);
    free(layers.names);
    return ok;
}
