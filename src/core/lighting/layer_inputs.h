// layer_inputs.h: lists the members of struct layer_values (layers.h) that are fields of the material, or fields
// multiplied by a map. These lists generate the code that fills the struct, the members of batches of points, and the
// GLSL text. To add a number, add a line here and a member to the struct.
#ifndef LAYER_INPUTS_H
#define LAYER_INPUTS_H

// clang-format off
// Numbers without a map; the field of lam_material has the same name.
#define LAYER_NUMBERS(X) \
    X(ior) \
    X(specular_glossiness) \
    X(iridescence_ior)

// Numbers with a map: the member, the field of lam_material, LAM_MAP_… without the prefix.
#define LAYER_MAPPED_NUMBERS(X) \
    X(specular_weight, specular_weight, SPECULAR_WEIGHT) \
    X(clearcoat, clearcoat, CLEARCOAT) \
    X(clearcoat_roughness, clearcoat_roughness, CLEARCOAT_ROUGHNESS) \
    X(sheen_roughness, sheen_roughness, SHEEN_ROUGHNESS) \
    X(iridescence, iridescence, IRIDESCENCE) \
    X(film, iridescence_thickness_max, IRIDESCENCE_THICKNESS) \
    X(transmission, transmission, TRANSMISSION) \
    X(thickness, thickness, THICKNESS)

// Colours with a map.
#define LAYER_MAPPED_COLORS(X) \
    X(f0_color, f0_color, F0_COLOR) \
    X(sheen_color, sheen_color, SHEEN_COLOR)
// clang-format on

#endif
