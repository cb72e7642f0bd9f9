// lambent/fields.h: the fields of lam_material and lam_light as tables: keys, ranges, defaults and meanings. Scene
// files, options, reports and shaders use these tables.
#ifndef LAMBENT_FIELDS_H
#define LAMBENT_FIELDS_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// The type of a field.
typedef enum lam_field_type {
    LAM_FIELD_NUMBER, // float
    LAM_FIELD_ANGLE,  // float, radians; degrees in scene files and options
    // 0 or 1. The member is a bool; false is the flag's default.
    LAM_FIELD_FLAG,
    LAM_FIELD_RGB,   // lam_rgb
    LAM_FIELD_RGBA,  // lam_rgba; the alpha lies in 0..1
    LAM_FIELD_POINT, // lam_vec3
    // lam_vec3 of any nonzero length; a default of 0 means that the scene determines the direction.
    LAM_FIELD_DIRECTION,
    LAM_FIELD_TRIPLE, // three floats
} lam_field_type;

// A field of lam_material or lam_light.
typedef struct lam_field {
    const char *name;    // name of the struct's member: "cutoff_rad"
    const char *key;     // in scene files and options: "cutoff"
    const char *symbol;  // in formulas: "kr"; NULL if there is none
    const char *source;  // the MTL statement that sets it: "Ks"; NULL if there is none
    const char *unit;    // NULL if there is none
    const char *summary; // one line
    lam_field_type type; // determines the number of components
    // The range of each number, INFINITY if unbounded, and the default. Angles are in degrees.
    double min, max, standard[4];
    size_t offset; // in lam_material or lam_light
    // Bits 1 << lam_light_type: the light types with this field. 0: a field of materials.
    unsigned light_types;
    LAM_RESERVED(8);
} lam_field;

// The maximum number of rows of either table.
enum { LAM_FIELDS_MAX = 40 };

// Returns a row of a table, or NULL past the end. For lights, a key may occur in several rows, with different defaults
// for different types.
LAM_API const lam_field *lam_material_field(int index);
LAM_API const lam_field *lam_light_field(int index);

// Gets the numbers of a field (angles in radians, a flag as 0 or 1) and returns their count: 1, 3 or 4.
LAM_API int lam_field_get(const lam_field *field, const void *object, double numbers[4]);
// Gets the numbers in the form used by scene files, options and reports: like lam_field_get, but with angles in
// degrees, as the shortest decimal that gives the same angle.
LAM_API int lam_field_get_written(const lam_field *field, const void *object, double numbers[4]);

// Sets the numbers without checking their range.
LAM_API void lam_field_set(const lam_field *field, void *object, const double numbers[4]);

#ifdef __cplusplus
}
#endif
#endif
