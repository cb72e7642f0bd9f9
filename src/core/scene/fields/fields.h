// fields.h: the tables of lambent/fields.h, with columns for internal use.
#ifndef FIELDS_H
#define FIELDS_H

#include "layer_kinds.h"

#include <lambent/fields.h>
#include <lambent/light.h>
#include <lambent/material.h>

// The condition under which shaders read a field of a material.
enum field_reader {
    FIELD_ALWAYS,
    FIELD_LIT,         // read for every lit surface
    FIELD_HIGHLIGHT,   // read by reflection models with a highlight
    FIELD_LOBE,        // read by reflection models that list it as a parameter
    FIELD_LAYER,       // read for physical materials with the layer
    FIELD_ENVIRONMENT, // read for the mirrored environment
    FIELD_CHOICE,      // selects the reflection model and is therefore not read
    FIELD_NEVER,       // is part of another field and is therefore not read
};

struct material_field {
    lam_field field; // must be the first member
    // The field's name and comment in shaders whose uniforms are products of materials and lights. NULL means that both
    // are the same as in other shaders; "" means that the field occurs only in the products.
    const char *product, *product_summary;
    enum field_reader reader;
    bool optional; // a scene file omits the field if its value is the default
    bool physical; // only physical materials have the field, so writing it makes a material physical
    int layer;     // for FIELD_LAYER, the layer (LAYER_…) that reads the field; such a field is optional too
};
const struct material_field *material_field(int index); // returns NULL past the end

// Returns the layers of a material as bits LAYER_… of layer_kinds.h; 0 for a classic material.
int material_layers(const lam_material *material);
// Returns the layer that reads a map; 0 means every material can read it.
int map_layer(lam_map map);

struct light_field {
    lam_field field; // must be the first member
    bool optional;   // a scene file omits the field if the value is 0
    // the kind of cone for which a spotlight uses the field; a cone is soft if outer_rad > 0
    enum { ANY_CONE, HARD_CONE, SOFT_CONE } cone;
};
const struct light_field *light_field(int index);
static inline bool field_is_of(const lam_field *field, lam_light_type type)
{
    return (unsigned)type < LAM_LIGHT_TYPE_COUNT && field->light_types >> type & 1;
}

// A number outside the range of its field, with the field's name and range as text for an error message.
struct field_fault {
    char name[48], expected[48];
    double found;
};
bool field_fits(const lam_field *field, const void *object, struct field_fault *fault);

bool field_equal(const lam_field *field, const void *a, const void *b);
// Returns whether all bytes of the field are 0, as for a flag with its default value.
bool field_is_zero(const lam_field *field, const void *object);
// Returns whether the field has its default value. Numbers are compared as floats.
bool field_is_standard(const lam_field *field, const void *object);
// Set a field to its default, or to the given numbers (angles in degrees).
void field_set_standard(const lam_field *field, void *object);
void field_set_written(const lam_field *field, void *object, const double numbers[4]);

// Call this for each field that a user or a file has set. If only physical materials have the field, the material
// becomes physical.
void material_note_written(lam_material *material, int field);

#endif
