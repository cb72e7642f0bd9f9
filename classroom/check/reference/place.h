// place.h: a painter's context, and the reference meshes drawn so far.
#ifndef PLACE_H
#define PLACE_H

#include "reference_scene.h"

enum { MAX_TEXTURE_COORDINATES = 2, MAX_FACTORS = 2 };

struct place {
    lam_check_painter painter; // a copy, because a cache may keep the context after the original is freed
    void *place;               // the painter's context; NULL if not open
    int size;
    char renderer[128];
    struct reference_points points[MESH_COUNT];
    lam_check_mesh meshes[MESH_COUNT]; // index_count is 0 until the mesh is made
    float *normals[MESH_COUNT];        // four floats per vertex
    float *factors[MESH_COUNT];        // four floats per vertex, made on first use
};

bool place_open(struct place *place, const lam_check_painter *painter, lam_check_language language, int size,
                lam_error *error);
void place_close(struct place *place); // a zeroed struct is allowed

// The indices of a program's inputs for map data, −1 if missing.
struct map_inputs {
    int texture_coordinates[MAX_TEXTURE_COORDINATES], tangent, bitangent; // tangent: four floats
    int factors[MAX_FACTORS];                                             // colours that are the same at every vertex
};
extern const struct map_inputs no_map_inputs;

// Draws `mesh` instead of drawing->mesh. `inputs` are the inputs that receive the streams.
bool place_draw(struct place *place, enum reference_mesh mesh, const lam_check_drawing *drawing,
                const struct map_inputs *inputs, float *pixels, lam_error *error);

// The components of a type. A matrix has several columns; a vector has one column with several rows.
struct type_shape {
    const char *name;
    int columns, rows;
};
struct type_shape type_shape(lam_check_type type);

// Returns the index of the input with this name (as the painter reports names), or -1 if there is none.
int place_input(const lam_check_program *program, const char *name, bool attribute);

#endif
