// fields.h: the tables of lambent/fields.h with the columns that only the library reads.
#ifndef FIELDS_H
#define FIELDS_H

#include "layer_kinds.h"

#include <lambent/fields.h>
#include <lambent/light.h>
#include <lambent/material.h>

// The part of a shader that reads a field of the material.
enum field_reader {
    FIELD_ALWAYS,
    FIELD_LIT,         // every lit surface
    FIELD_HIGHLIGHT,   // reflection models with a highlight
    FIELD_LOBE,        // reflection models that name it as a parameter
    FIELD_LAYER,       // physical materials that have the layer
    FIELD_ENVIRONMENT, // the mirrored environment
    FIELD_CHOICE,      // none: it decides about the reflection model
    FIELD_NEVER,       // it is part of another field
};

struct material_field {
    lam_field field; // first
    // Name and comment in shaders whose uniforms are products of materials and lights. NULL: as elsewhere; "": the
    // field appears only within those products.
    const char *product, *product_summary;
    enum field_reader reader;
    bool optional; // a scene file omits it if it is 0, the default
    bool physical; // only physical materials have it: writing it makes a material physical
    int layer;     // of FIELD_LAYER: LAYER_… that reads it; a scene file omits it if it is the default
};
const struct material_field *material_field(int index); // NULL past the end

// Returns the layers that a material has: LAYER_… of layer_kinds.h, 0 for a classic one.
int material_layers(const lam_material *material);
// Returns the layer that reads a map; 0: none, it belongs to every material.
int map_layer(lam_map map);

struct light_field {
    lam_field field;                              // first
    bool optional;                                // a scene file omits it if it is 0
    enum { ANY_CONE, HARD_CONE, SOFT_CONE } cone; // a spot has the fields of one law: soft where outer_rad > 0
};
const struct light_field *light_field(int index);
static inline bool field_is_of(const lam_field *field, lam_light_type type) { return field->light_types >> type & 1; }

// A number outside the range of its field; name and range are words for an error sentence.
struct field_fault {
    char name[48], expected[48];
    double found;
};
bool field_fits(const lam_field *field, const void *object, struct field_fault *fault);

bool field_equal(const lam_field *field, const void *a, const void *b);
// Returns whether its bytes are 0: a flag then has its default.
bool field_is_zero(const lam_field *field, const void *object);
bool field_is_standard(const lam_field *field, const void *object); // compared as floats
// Sets the default, and any numbers whose angles are in degrees.
void field_set_standard(const lam_field *field, void *object);
void field_set_written(const lam_field *field, void *object, const double numbers[4]);

// Call it for each field that a user or a file has set: see material_field.physical.
void material_note_written(lam_material *material, int field);

#endif
