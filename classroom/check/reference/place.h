// place.h: where a painter draws the reference meshes, with the meshes that were drawn so far.
#ifndef PLACE_H
#define PLACE_H

#include "reference_scene.h"

enum { MAX_TEXTURE_COORDINATES = 2, MAX_FACTORS = 2 };

struct place {
    lam_check_painter painter; // a copy: the caller's may be gone while a cache keeps the place
    void *place;               // the painter's; NULL: not open
    int size;
    char renderer[128];
    struct reference_points points[MESH_COUNT];
    lam_check_mesh meshes[MESH_COUNT]; // index_count 0: not made yet
    float *normals[MESH_COUNT];        // four floats each
    float *factors[MESH_COUNT];        // likewise, made when one is first drawn
};

bool place_open(struct place *place, const lam_check_painter *painter, lam_check_language language, int size,
                lam_error *error);
void place_close(struct place *place); // a zeroed one is fine

// The inputs of a program for data of maps; -1: none.
struct map_inputs {
    int texture_coordinates[MAX_TEXTURE_COORDINATES], tangent, bitangent; // tangent: of four floats
    int factors[MAX_FACTORS];                                             // colours that are the same at every vertex
};
extern const struct map_inputs no_map_inputs;

// Draws `mesh`, whatever drawing->mesh is. The streams are the ones of `inputs`.
bool place_draw(struct place *place, enum reference_mesh mesh, const lam_check_drawing *drawing,
                const struct map_inputs *inputs, float *pixels, lam_error *error);

// The components of a type: matrices have several columns, vectors one of several rows.
struct type_shape {
    const char *name;
    int columns, rows;
};
struct type_shape type_shape(lam_check_type type);

// The input with a name, as the painter reports it; -1: the program has none.
int place_input(const lam_check_program *program, const char *name, bool attribute);

#endif
