// info.h: the two forms in which the command `info` prints a model.
#ifndef INFO_H
#define INFO_H

#include <stdio.h>

#include "job.h"

// A loaded model, or the error of one that could not be loaded.
struct info {
    const struct job *job;
    const lam_error *error; // code LAM_OK: none
    bool needs_lenient;     // drawing it needs --lenient
};

// The numbers of what is stored; a mesh that several objects show counts once.
struct info_counts {
    uint64_t parts, triangles, vertices;
};
struct info_counts info_count(const lam_scene *scene);

const char *info_format(const lam_scene *scene);              // "shape" for a built-in shape
const char *info_unit(const lam_scene *scene);                // of lengths: "metre"; NULL: the format does not say
const char *info_material_kind(const lam_material *material); // "metallic-roughness", "classic" or "unlit"
const char *info_map_name(int map);                           // of lam_map, in words
const char *info_support(lam_extension_support support);      // in words

// A light's colour, its largest channel 1, and that channel: the intensity.
lam_rgb info_light_color(const lam_light *light, double *intensity);

void info_text(const struct info *info);
void info_json(const struct info *info);

#endif
