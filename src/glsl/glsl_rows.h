// glsl_rows.h: the attributes, uniforms, blocks and structs of a text, as a table: what the text declares and
// what its contract tells.
#ifndef GLSL_ROWS_H
#define GLSL_ROWS_H

#include "glsl.h"
#include "shader_preprocess.h"

// Which value a row has.
enum glsl_what {
    GLSL_MODEL_VIEW_PROJECTION,
    GLSL_MODEL_VIEW,
    GLSL_NORMAL_MATRIX,
    GLSL_ENVIRONMENT_MATRIX,
    GLSL_ENVIRONMENT,
    GLSL_LIGHT_LIST,
    GLSL_PRODUCT_LIST,
    GLSL_FIRST_PRODUCT,
    GLSL_AMBIENT_LIGHT,
    GLSL_LIGHTS,      // of structs
    GLSL_HEMISPHERES, // of structs
    GLSL_MATERIAL,    // a struct
    GLSL_HEAD,        // a field of the material beside products
    GLSL_DIFFUSE_PRODUCT,
    GLSL_SPECULAR_PRODUCT,
    GLSL_LIGHT_AMBIENT_PRODUCT,
    GLSL_SKY_PRODUCT,
    GLSL_GROUND_PRODUCT,
    GLSL_OBJECT,
    GLSL_EXPOSURE,
};

struct glsl_row {
    enum glsl_what what;
    const char *type; // "vec4", "Light"
    char name[32];
    int count;         // of an array; 0: none
    const char *block; // NULL: a plain uniform
    const char *meaning;
    bool back; // of the back's material
    int at; // of a member or a head: where it stands in struct glsl_light, the material or up, sky, ground; in floats
};
enum { GLSL_ROWS_MAX = 24 + 2 * LAM_FIELDS_MAX };

// What follows from choices for the templates and the tables.
struct glsl_facts {
    const struct glsl_choices *choices;
    lam_shading shading; // PHONG where a place is shown
    bool application, per_vertex, per_fragment;
    bool shows_place, shows_vector, shows_one_light;
    bool paints;         // no light is asked: the colour as it is
    bool lit;            // there is a light_point
    bool sums;           // it adds up lights
    bool lights, skies;  // lists that are read
    bool falloff, cones; // any light has some
    bool positions;      // any light but a directional one
    bool directions;     // any light but a point
    bool highlights;     // the model has
    bool threads;        // tangents are read
    bool environment;    // read
    bool back;           // a material of its own, and two sides
};
struct glsl_facts glsl_facts_of(const struct glsl_choices *choices);

// Whether the lobe of the choices reads a number of the material, by the name in LOBE_PARAMETERS (src/lighting/lobes.h).
bool glsl_lobe_reads(const struct glsl_facts *facts, const char *parameter);
// Appends the lines that choose these numbers from two materials, where they stand as products.
void glsl_add_parameters(struct text *text, const struct glsl_facts *facts);
// Appends the lobe's answer to the light `t`: "reflected_of(phong_lobe(s, t.l), shininess)".
void glsl_add_lobe(struct text *text, const struct glsl_facts *facts);

// The uniforms of both texts, in the order of their declaration (that of each block is its layout). Returns
// their number.
int glsl_rows(const struct glsl_facts *facts, struct glsl_row rows[GLSL_ROWS_MAX]);
// The vertex attributes.
struct glsl_attribute {
    int location;
    const char *type, *name, *meaning;
};
enum { GLSL_ATTRIBUTES_MAX = 7 };
int glsl_attributes(const struct glsl_facts *facts, struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX]);

// Whether a row is read by the vertex or the fragment text.
bool glsl_row_is_in(const struct glsl_facts *facts, const struct glsl_row *row, bool fragment);
// The members of a struct type; 0: no struct.
int glsl_members(const struct glsl_facts *facts, const char *type, struct glsl_row rows[GLSL_ROWS_MAX]);
// Append their declarations.
void glsl_declare_attributes(struct text *text, const struct glsl_facts *facts);
void glsl_declare(struct text *text, const struct glsl_facts *facts, bool fragment);

#endif
