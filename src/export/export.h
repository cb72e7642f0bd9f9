// export.h: what a writer of a model format is given, and what it fills.
//
// A format is a file with a `struct exporter` and its name in EXPORTERS.
#ifndef EXPORT_H
#define EXPORT_H

#include "scene_internal.h"
#include "text_builder.h"

#include <lambent/export.h>

#define EXPORTERS(row) row(glb) row(obj) row(stl) row(ply) row(3mf)

// The kinds of items in a scene. Each kind has separate meshes.
enum export_kind { EXPORT_TRIANGLES, EXPORT_LINES, EXPORT_POINTS, EXPORT_KINDS };

struct export_file {
    char *name; // in the arena
    lam_bytes bytes;
};

struct lam_export {
    struct arena arena;
    struct scene_list files;  // struct export_file
    struct scene_list losses; // const char *
};

// The state of an export.
struct exporting {
    const struct lam_scene *scene; // NULL: a mesh alone
    const lam_export_params *params;
    const char *name;    // of the model's file
    struct arena *arena; // of the export
    struct lam_export *out;
    lam_up from, to; // the axis that is up in the scene, and in the format
    // Of flat formats: everything of a kind as one mesh in world space, whose parts name their materials. No items: none.
    lam_mesh flat[EXPORT_KINDS];
    struct text text; // the model's file
    lam_error *error;
};

struct exporter {
    const char *ending;
    lam_up up; // the axis that is up in the format
    bool flat; // it has no objects: it gets `flat`
    // Writes the model to `text`, and files beside it by export_add_file. False: `error` says why.
    bool (*write)(struct exporting *e);
};

#define EXPORTER_DECLARED(name) extern const struct exporter exporter_##name;
EXPORTERS(EXPORTER_DECLARED)

// Returns the exporter of an ending; NULL, with the error that names `path`: there is none.
const struct exporter *exporter_find(const char *ending, const char *path, lam_error *error);

// Records a loss: something in the scene that the file does not contain. Each sentence is recorded once.
void export_lose(struct exporting *e, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Records the losses that all flat formats share: lights, cameras, an environment, animations. `cameras`: the format
// supports lights and cameras.
void export_lose_surroundings(struct exporting *e, bool has_lights_and_cameras);

// Adds a file beside the model, whose bytes come from malloc and are given away. Its name is the model's without its
// ending, and `ending`: "-0.png". `beside`: other files name it, so letters that OBJ and MTL cannot name become _. Fails with LAM_LIMIT.
const char *export_add_file(struct exporting *e, const char *ending, bool beside, lam_bytes bytes);

// Reports that memory has run out, and returns false.
bool export_no_memory(struct exporting *e, size_t bytes);

// flatten.c: builds e->flat from the scene.
bool export_flatten(struct exporting *e);

// export_numbers.c: numbers in text and bytes, vectors rotated to the format's up axis.
void export_number(struct text *text,
                   double x); // with all digits of a float, or of a double if it is not exactly a float
void export_word(struct text *text, uint32_t value); // little endian
void export_float(struct text *text, double x);      // likewise
void export_floats(struct text *text, lam_vec3 p);
void export_line(struct text *text, const char *word, const double *numbers, int count);
lam_vec3 export_turned(const struct exporting *e, lam_vec3 p);
lam_vec3 export_position(const struct exporting *e, const lam_mesh *mesh, uint32_t vertex);
lam_vec3 export_normal(const struct exporting *e, const lam_mesh *mesh, uint32_t index);

// Returns the element of an attribute at a corner; `own`: its index array, which may be NULL.
static inline uint32_t export_element(const uint32_t *own, const lam_mesh *mesh, size_t corner)
{
    return own ? own[corner] : mesh->indices ? mesh->indices[corner] : (uint32_t)corner;
}

// export_vertices.c: corners that share all of their attributes become one vertex.
struct export_vertices {
    uint32_t count;          // vertices
    const uint32_t *corners; // of each vertex, a corner that has its attributes
    const uint32_t *numbers; // of each corner, its vertex
};
bool export_share_vertices(struct exporting *e, const lam_mesh *mesh, struct export_vertices *out);

// Returns the element of a corner's colour. A colour, linear; and as 8 bits, sRGB-encoded. The mesh has colours.
uint32_t export_color_element(const lam_mesh *mesh, size_t corner);
void export_color(const lam_mesh *mesh, size_t element, float color[4]);
void export_color_bytes(const lam_mesh *mesh, size_t element, uint8_t bytes[4]);

// Returns a channel of light as a number of OBJ and MTL.
double export_encoded(float light);

// A texture's picture as PNG, from malloc. Returns false if it cannot be had exactly (floats), or out of memory, which
// the error says.
bool export_texture(struct exporting *e, const lam_texture *texture, lam_bytes *png);

// Returns the material of a part, or the scene's default one.
const lam_material *export_material(const struct exporting *e, int index);

#endif
