// glsl_layer_inputs.c: the table of the material values that layers use (src/core/lighting/layer_inputs.h), for GLSL.
#include "layer_inputs.h"

#include "glsl_rows.h"

#include <string.h>

#define NUMBER(member)                    {#member, #member, LAM_MAP_COUNT, false},
#define MAPPED_NUMBER(member, field, map) {#member, #field, LAM_MAP_##map, false},
#define MAPPED_COLOR(member, field, map)  {#member, #field, LAM_MAP_##map, true},
static const struct glsl_layer_input layer_inputs[] = {LAYER_NUMBERS(NUMBER) LAYER_MAPPED_NUMBERS(MAPPED_NUMBER)
                                                           LAYER_MAPPED_COLORS(MAPPED_COLOR)};
#undef NUMBER
#undef MAPPED_NUMBER
#undef MAPPED_COLOR

const struct glsl_layer_input *glsl_layer_input(int index)
{
    return (unsigned)index < sizeof layer_inputs / sizeof *layer_inputs ? &layer_inputs[index] : NULL;
}

const struct glsl_layer_input *glsl_layer_input_of(const struct material_field *row)
{
    for (int i = 0; glsl_layer_input(i); i++)
        if (row->reader == FIELD_LAYER && strcmp(layer_inputs[i].field, row->field.name) == 0)
            return &layer_inputs[i];
    return NULL;
}
