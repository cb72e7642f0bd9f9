// export.h: the interface between export.c and the writers of model formats.
//
// To add a format, define its `struct exporter` in a new file and list the format's name in EXPORTERS.
#ifndef EXPORT_H
#define EXPORT_H

#include "scene_internal.h"
#include "text_builder.h"

#include <lambent/export.h>

#define EXPORTERS(row) row(glb) row(obj) row(stl) row(ply) row(3mf)

// The kinds of items in a scene. Each kind has separate meshes.
enum export_kind { EXPORT_TRIANGLES, EXPORT_LINES, EXPORT_POINTS, EXPORT_KINDS };

struct export_file {
    char *name; // allocated from the arena
    lam_bytes bytes;
};

struct lam_export {
    struct arena arena;
    struct scene_list files;  // struct export_file
    struct scene_list losses; // const char *
};

// The state of an export.
struct exporting {
    const struct lam_scene *scene; // NULL if a single mesh is exported
    const lam_export_params *params;
    const char *name;    // the name of the model's file
    struct arena *arena; // memory of the export
    struct lam_export *out;
    lam_up from, to; // the up axis of the scene and of the format
    // For flat formats: one mesh for triangles, one for lines and one for points, all in world space. The parts of a
    // mesh refer to the materials. A mesh is empty if the scene contains no items of this kind.
    lam_mesh flat[EXPORT_KINDS];
    struct text text;          // the model's file
    struct call_control *call; // NULL if there is none
    bool stopped;              // the call was stopped, so the result is incomplete
    lam_error *error;
};

struct exporter {
    const char *ending;
    lam_up up; // the up axis of the format
    bool flat; // the format has no objects, so export.c builds exporting.flat
    // Writes the model to `text`, and adds any other files with export_add_file. Returns false and fills `error` on
    // failure.
    bool (*write)(struct exporting *e);
};

#define EXPORTER_DECLARED(name) extern const struct exporter exporter_##name;
EXPORTERS(EXPORTER_DECLARED)

// Records a loss: something in the scene that the file cannot store. Each message is recorded only once.
void export_lose(struct exporting *e, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Records the losses that all flat formats share: lights, cameras, an environment, animations. `has_lights_and_cameras`
// means that the format supports lights and cameras.
void export_lose_surroundings(struct exporting *e, bool has_lights_and_cameras);

// Records a loss if the scene contains several objects, or parts with different names, because a flat format merges
// objects and drops the names of parts. `reason` is appended to the message.
void export_lose_objects(struct exporting *e, const char *reason);

// Records a loss if the coordinates are far from zero, for formats that store them as floats.
void export_lose_digits(struct exporting *e, const lam_mesh *mesh);

// Returns whether the normals are the smooth ones that readers compute for files without normals: whether the model was
// read from such a file, with the default crease angle.
bool export_has_usual_normals(const struct exporting *e);

// Adds a file beside the model, and takes ownership of the file's bytes, which malloc allocated. The file's name is the
// model's name without its extension, followed by `ending`, such as "-0.png". If `beside` is set, other files refer to
// this file by name, so characters that OBJ and MTL do not allow in file names become _. Fails with LAM_LIMIT.
const char *export_add_file(struct exporting *e, const char *ending, bool beside, lam_bytes bytes);

// Reports that memory has run out. Returns false.
bool export_no_memory(struct exporting *e, size_t bytes);

// Allocates temporary memory, which counts towards the memory limit of the call.
void *export_memory(struct exporting *e, size_t bytes);
void export_memory_free(struct exporting *e, void *memory, size_t bytes);

// Long loops continue while export_continues returns true. Every 65,536 items, this function checks whether the call
// may continue.
bool export_asks(struct exporting *e);
static inline bool export_continues(struct exporting *e, size_t item) { return item % 65536 || export_asks(e); }

// The next two functions check that no loop ended early, and that the text is complete. If a check fails, the function
// returns false and fills the error.
bool export_is_whole(struct exporting *e);
bool export_text_is_whole(struct exporting *e, const struct text *text);

// flatten.c: builds e->flat from the scene.
bool export_flatten(struct exporting *e);

// export_vertices.c: writes numbers as text and as bytes, and rotates vectors to the format's up axis.
void export_number(struct text *text,
                   double x); // with all digits of a float, or of a double if it is not exactly a float
void export_word(struct text *text, uint32_t value); // little-endian
void export_float(struct text *text, double x);      // little-endian
void export_floats(struct text *text, lam_vec3 p);
void export_list(struct text *text, const char *word, const double *numbers, int count);
void export_line(struct text *text, const char *word, const double *numbers, int count); // writes a list and a line end
lam_vec3 export_turned(const struct exporting *e, lam_vec3 p);
lam_vec3 export_position(const struct exporting *e, const lam_mesh *mesh, uint32_t vertex);
lam_vec3 export_normal(const struct exporting *e, const lam_mesh *mesh, uint32_t index);

// export_vertices.c: merges corners with equal attributes into vertices.
struct export_vertices {
    uint32_t count;          // number of vertices
    const uint32_t *corners; // for each vertex, the index of a corner with the same attributes
    const uint32_t *numbers; // for each corner, the index of the corner's vertex
};
bool export_share_vertices(struct exporting *e, const lam_mesh *mesh, struct export_vertices *out);

// export_color_element returns the index of a corner's colour in the mesh. The other functions return the colour with
// this index: linear, or encoded as sRGB in 8 bits. The mesh must have colours.
uint32_t export_color_element(const lam_mesh *mesh, size_t corner);
void export_color(const lam_mesh *mesh, size_t element, float color[4]);
void export_color_bytes(const lam_mesh *mesh, size_t element, uint8_t bytes[4]);

// Converts a channel of linear light to the number that OBJ and MTL store.
double export_encoded(float light);

// Encodes a texture's picture as PNG, in memory that malloc allocates. Records a loss and returns false if PNG cannot
// store the picture exactly (floats). Fills the error and returns false if memory runs out.
bool export_texture(struct exporting *e, const lam_texture *texture, lam_bytes *png);

// Returns whether a material is the white one that loading adds for colours without a material (scene_colors.c).
bool export_is_white(const lam_material *material);
// Returns the number of the scene's other materials.
int export_material_count(const struct exporting *e);
// Returns the material of a part, or the scene's default material.
const lam_material *export_material(const struct exporting *e, int index);

#endif
