// info.h: the two forms in which the command `info` prints a model.
#ifndef INFO_H
#define INFO_H

#include <stdio.h>

#include "job.h"

// A texture as materials read it, or an unused picture of the file.
struct info_texture {
    const lam_texture *texture;  // NULL: no material reads the picture, or it could not be read
    const lam_file_image *image; // NULL: the file does not list its pictures
    unsigned slots;              // bit m: some material reads it as map m (lam_map)
};
struct info_textures {
    struct info_texture *items; // from malloc
    int count;
};
bool info_textures_list(const lam_scene *scene, struct info_textures *textures, lam_error *error);
int info_texture_find(const struct info_textures *textures, const lam_texture *texture); // its index; −1: none
// As the model names it, or relative to the model's folder. Returns NULL if it is in the model.
const char *info_texture_file(const struct info_texture *texture, const char *model);
const char *info_texture_format(const struct info_texture *texture); // "png"; NULL: unknown
const char *info_color_space(const struct info_texture *texture);    // "srgb", "linear"; NULL: it is not read

// A loaded model, or the error of one that could not be loaded.
struct info {
    const struct job *job;
    const lam_error *error; // code LAM_OK: none
    bool needs_lenient;     // drawing it needs --lenient
    const struct info_textures *textures;
    uint64_t
        drawing_bytes; // that drawing a picture of INFO_SIDE² pixels takes, the picture included; 0: it cannot be drawn
    int drawing_threads;
};
enum { INFO_SIDE = 1024 };

// The numbers of stored data; a mesh that several objects show counts once.
struct info_counts {
    uint64_t parts, triangles, vertices;
};
struct info_counts info_count(const lam_scene *scene);

const char *info_format(const lam_scene *scene); // "shape" for a built-in shape

// The unit of a model's lengths.
struct info_unit {
    const char *name, *symbol; // "millimetre", "mm"; NULL: the format does not say
    double millimetres;        // of one unit; 0: unknown
};
struct info_unit info_unit(const lam_scene *scene);

// The surface of all objects, in the model's units.
struct info_measure {
    double area;
    // Every edge belongs to as many triangles in one direction as in the other, so that the surface has an inside.
    bool closed;
    double volume; // of the space inside closed surfaces; overlapping objects count twice
};
struct info_measure info_measure(const lam_scene *scene);

const char *info_material_kind(const lam_material *material); // "metallic-roughness", "classic" or "unlit"
// The numbers of a field that is not printed for every material, if they differ from the default, as scene files write
// them. Returns how many there are; 0: it has its default.
int info_changed_field(const lam_field *field, const lam_material *material, double numbers[4]);
const char *info_alpha_mode(const lam_material *material); // "opaque", "mask" or "blend"
const char *info_support(lam_extension_support support);   // in words

// Returns a light's colour, its largest channel 1, and that channel: the intensity.
lam_rgb info_light_color(const lam_light *light, double *intensity);

void info_text(const struct info *info);
void info_json(const struct info *info);

#endif
