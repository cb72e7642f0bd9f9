// info.h: prints a model for the command `info`, as text or JSON.
#ifndef INFO_H
#define INFO_H

#include <stdio.h>

#include <lambent/fields.h>

#include "job.h"

// A texture that a material uses, or an unused picture in the file.
struct info_texture {
    const lam_texture *texture;  // NULL if no material uses the picture or the picture cannot be read
    const lam_file_image *image; // NULL if the file does not list its pictures
    unsigned slots;              // bit m is set if a material uses the texture as map m (lam_map)
};
struct info_textures {
    struct info_texture *items; // allocated with malloc
    int count;
};
bool info_textures_list(const lam_scene *scene, struct info_textures *textures, lam_error *error);
int info_texture_find(const struct info_textures *textures, const lam_texture *texture); // returns the index, or −1
// Returns the path of the texture's file, either as written in the model or relative to the model's folder. Returns
// NULL if the texture is inside the model file.
const char *info_texture_file(const struct info_texture *texture, const char *model);
const char *info_texture_format(const struct info_texture *texture); // "png"; NULL if unknown
const char *info_color_space(const struct info_texture *texture);    // "srgb" or "linear"; NULL if unused

// A name, and how many objects and parts have this name.
struct info_name {
    const char *name;
    int objects, parts, groups;
    int order; // the position at which the name first occurs
};
struct info_names {
    struct info_name *items; // allocated with malloc
    int count;
};
bool info_names_list(const lam_scene *scene, struct info_names *names, lam_error *error);

// These functions get the place of a vertex in the scene, and the vertices of a triangle's corners.
lam_vec3 info_place(const lam_mesh *mesh, const lam_mat4 *transform, uint32_t vertex);
void info_vertices(const lam_mesh *mesh, uint32_t triangle, uint32_t out[3]);

// The findings of `--print`. Lengths are in the units of the model.
struct info_hole {
    lam_vec3 middle;
    double length; // of its edges
    uint32_t edges;
};
enum { INFO_HOLES = 5 };
struct info_print {
    bool triangles, printable;
    uint64_t open_edges, shared_edges, turned_edges; // of one face; of more than two; between faces of opposite sides
    int holes;                                       // groups of connected open edges
    struct info_hole longest[INFO_HOLES];
    double overhang_deg, overhang_area; // without the faces on the bed
    double volume;                      // negative if the surface is inside out
    lam_vec3 mass;                      // the centre of mass, if the surface is closed
};
bool info_print_check(const lam_scene *scene, double overhang_deg, struct info_print *print, lam_error *error);

// A loaded model, or the error if the model cannot be loaded.
struct info {
    const struct job *job;
    const lam_error *error; // LAM_OK if the model is loaded
    bool needs_lenient;     // the model can be drawn only with --lenient
    const struct info_textures *textures;
    const struct info_names *names;
    uint64_t
        // the memory needed to draw a picture of INFO_SIDE² pixels, including the picture; 0 if drawing failed
        drawing_bytes;
    int drawing_threads;
    lam_section sections[LAM_SECTIONS_MAX]; // of --section, or of a scene file
    double section_areas[LAM_SECTIONS_MAX]; // in the model's square units
    int section_count;
    const struct info_print *print; // NULL without --print
};
enum { INFO_SIDE = 1024 };

// The numbers of stored parts, triangles and vertices. A mesh is counted once, even if several objects use it.
struct info_counts {
    uint64_t parts, triangles, vertices;
};
struct info_counts info_count(const lam_scene *scene);

const char *info_format(const lam_scene *scene); // "shape" for a built-in shape

// The unit of length of a model.
struct info_unit {
    const char *name, *symbol; // "millimetre", "mm"; NULL if the format has no unit
    double millimetres;        // millimetres in one unit; 0 if unknown
};
struct info_unit info_unit(const lam_scene *scene);

// The surface of all objects, in the model's units.
struct info_measure {
    bool exact; // of the exact shape (STEP), not of the triangles
    double area;
    // True if the triangles traverse every edge equally often in each direction. The surface then encloses a volume.
    bool closed;
    double volume; // only valid if `closed`; volume shared by two objects is counted twice
};
struct info_measure info_measure(const lam_scene *scene);

const char *info_material_kind(const lam_material *material); // returns "metallic-roughness", "classic" or "unlit"
// Stores a field's values in `numbers`, in the format of scene files, and returns their number. Returns 0 if the field
// is printed for every material or equals its default.
int info_changed_field(const lam_field *field, const lam_material *material, double numbers[4]);
const char *info_alpha_mode(const lam_material *material); // returns "opaque", "mask" or "blend"
const char *info_support(lam_extension_support support);   // returns a description

// Returns a light's colour, scaled so that the largest channel is 1. Stores the largest channel before the scaling in
// `intensity`.
lam_rgb info_light_color(const lam_light *light, double *intensity);

void info_text(const struct info *info);
void info_json(const struct info *info);

#endif
