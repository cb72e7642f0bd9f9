// lambent/material.h: how a surface reflects light, and the classic named materials.
#ifndef LAMBENT_MATERIAL_H
#define LAMBENT_MATERIAL_H

#include "reflection.h"
#include "texture.h"

#ifdef __cplusplus
extern "C" {
#endif

// The maps of a material: textures that vary a field over the surface (docs/textures.md). Each line lists the names of
// the map in MTL and glTF.
typedef enum lam_map {
    // Multiplies ka. If it is missing, the diffuse map is used.
    LAM_MAP_AMBIENT, // map_Ka
    // Multiplies kd, or the base colour; its alpha multiplies the opacity.
    LAM_MAP_DIFFUSE, // map_Kd, baseColorTexture
    // Multiplies ks.
    LAM_MAP_SPECULAR, // map_Ks
    // Multiplies the emission.
    LAM_MAP_EMISSION, // map_Ke, emissiveTexture
    // Multiplies α.
    LAM_MAP_SHININESS, // map_Ns
    // Multiplies the opacity.
    LAM_MAP_OPACITY, // map_d
    // Heights that tilt the normal.
    LAM_MAP_BUMP, // map_bump, bump
    // Replaces the normal; gives its components along tangent, bitangent and the mesh's normal.
    LAM_MAP_NORMAL, // norm, normalTexture
    // Not drawn; only the names of these maps are kept.
    LAM_MAP_DISPLACEMENT, // disp
    LAM_MAP_REFLECTION,   // refl
    // Multiply `metallic` and `roughness`.
    LAM_MAP_METALLIC,  // map_Pm, metallicRoughnessTexture's blue
    LAM_MAP_ROUGHNESS, // map_Pr, metallicRoughnessTexture's green
    // Multiplies ambient, hemisphere and environment light.
    LAM_MAP_OCCLUSION, // occlusionTexture's red
    // Maps of the layers of physical materials; each multiplies the field with its name.
    LAM_MAP_SPECULAR_WEIGHT,     // specularTexture's alpha
    LAM_MAP_F0_COLOR,            // specularColorTexture
    LAM_MAP_CLEARCOAT,           // clearcoatTexture's red
    LAM_MAP_CLEARCOAT_ROUGHNESS, // clearcoatRoughnessTexture's green
    // The normal of the coat, as LAM_MAP_NORMAL.
    LAM_MAP_CLEARCOAT_NORMAL, // clearcoatNormalTexture
    LAM_MAP_SHEEN_COLOR,      // sheenColorTexture
    LAM_MAP_SHEEN_ROUGHNESS,  // sheenRoughnessTexture's alpha
    // Red and green: the direction along tangent and bitangent, 0..1 for −1..1, rotated by `anisotropy_rotation_rad`;
    // blue multiplies `anisotropy`.
    LAM_MAP_ANISOTROPY,  // anisotropyTexture
    LAM_MAP_IRIDESCENCE, // iridescenceTexture's red
    // The thickness of the film between the minimum at 0 and the maximum at 1.
    LAM_MAP_IRIDESCENCE_THICKNESS, // iridescenceThicknessTexture's green
    LAM_MAP_TRANSMISSION,          // transmissionTexture's red
    LAM_MAP_THICKNESS,             // thicknessTexture's green
    LAM_MAP_COUNT
} lam_map;

// Returns the name of a map in reports and messages: "diffuse", "normal". Returns NULL if there is no such map.
LAM_API const char *lam_map_name(lam_map map);

// The treatment of points whose opacity (diffuse alpha × map × vertex colour) is below 1.
typedef enum lam_alpha_mode {
    LAM_ALPHA_BLEND = 0, // blended over the surfaces behind by the opacity
    // Omitted if the opacity is below lam_material.alpha_cutoff, otherwise opaque.
    LAM_ALPHA_MASK,
    LAM_ALPHA_OPAQUE, // always opaque
    LAM_ALPHA_COUNT
} lam_alpha_mode;

// A material of the classic models. Colours are linear reflectances, 0..1 for a surface that reflects no more light
// than it receives; larger values are allowed. The light that leaves a point is
//  emission + ambient ⊙ (ambient light) + Σ over lights of (diffuse ⊙ Ld · D + specular ⊙ Ls · S)
//           + reflectivity ⊙ environment
// with D and S of the reflection model (docs/lighting.md). lam_material_default() returns a neutral grey; a zeroed
// struct is black and fully transparent.
typedef struct lam_material {
    lam_rgb ambient; // ka: fraction of ambient and hemisphere light returned
    // kd: fraction of light reflected evenly in all directions. `a` is the opacity, 0..1; 1: opaque.
    lam_rgba diffuse;
    lam_rgb specular; // ks: strength of the highlight
    lam_rgb emission; // light that the surface itself emits
    // α: exponent of the highlight, finite and ≥ 0. Every model uses it as given, except with
    // lam_draw_params.match_highlights.
    float shininess;

    lam_rgb reflectivity; // kr: fraction of the environment that is mirrored
    // Kajiya–Kay without its gate [n·l > 0], for hair and thread, which are lit from all sides.
    bool fibre;

    const char *name;                       // UTF-8; NULL: unnamed
    int illum;                              // MTL's illumination model as written; −1: none
    const char *map_names[LAM_MAP_COUNT];   // file names as written; NULL if there is none
    const char *map_options[LAM_MAP_COUNT]; // their MTL options, "-s 1 1 1"; NULL if there is none
    // σ of Oren–Nayar: the standard deviation of the slope angle of the surface's facets, radians, 0..π/2. 0: a
    // Lambertian surface.
    float roughness_angle_rad;

    // true: a metallic–roughness material (glTF 2.0, appendix B): `diffuse` is the base colour, `metallic` and
    // `roughness` describe the rest, and `specular` and `shininess` are ignored. false: a classic material. Reflection
    // models of the other kind convert it by lam_material_as_classic or lam_material_as_physical.
    bool physical;
    // The diffuse colour is shown unchanged, unless a reflection model is requested.
    bool unlit;
    float metallic;  // 0: a dielectric, 1: a metal
    float roughness; // 0 (a mirror) to 1; below 0.045, 0.045 is used

    // The textures of the maps; NULL: the material has no such map. Adding a material to a scene copies these structs;
    // the scene shares the textures.
    const lam_texture_map *maps[LAM_MAP_COUNT];
    lam_alpha_mode alpha_mode; // the treatment of an opacity below 1
    float alpha_cutoff;        // of LAM_ALPHA_MASK, 0..1

    // The layers of a physical material (docs/lighting/layers.md). By default they are absent.
    //
    // The dielectric reflects f0 = min(((ior − 1)/(ior + 1))² ⊙ f0_color, 1) · specular_weight along the normal, and
    // specular_weight at grazing angles (KHR_materials_ior, KHR_materials_specular).
    float ior;             // index of refraction; default 1.5; 0: reflects all light
    float specular_weight; // 0..1; default 1
    lam_rgb f0_color;      // ≥ 0; default 1
    // A clear coat of index 1.5 over all other layers (KHR_materials_clearcoat).
    float clearcoat;           // fraction of the surface that is coated, 0..1; default 0
    float clearcoat_roughness; // as `roughness`; default 0
    // Fibres perpendicular to the surface (KHR_materials_sheen).
    lam_rgb sheen_color;   // 0..1; default 0: none
    float sheen_roughness; // the spread of their directions, 0..1; default 0
    // Stretches the highlight along the tangent, rotated towards the bitangent (KHR_materials_anisotropy).
    float anisotropy;              // 0..1; default 0
    float anisotropy_rotation_rad; // radians, −2π..2π; default 0
    // A thin film over the surface, whose interference colours the Fresnel factor (KHR_materials_iridescence).
    float iridescence;               // 0..1; default 0
    float iridescence_ior;           // of the film, ≥ 0; below 1, 1 is used; default 1.3
    float iridescence_thickness_min; // nanometres, at map value 0; default 100
    float iridescence_thickness_max; // at map value 1, and without a map; default 400
    // The fraction of the light entering the dielectric that passes through it, coloured by the base colour, instead of
    // being scattered back (KHR_materials_transmission). Roughness blurs the picture behind the surface, and thickness
    // refracts it.
    float transmission; // 0..1; default 0
    // The volume behind the surface (KHR_materials_volume): over attenuation_distance, white light is reduced to
    // attenuation_color.
    float thickness;            // units of the mesh, ≥ 0; default 0: thin
    float attenuation_distance; // units of the world; 0, the default: infinite
    lam_rgb attenuation_color;  // 0..1; default 1
    // Multiplies the matt part of the dielectric by 1 − specular_glossiness · (largest channel of f0). 1: a
    // specular–glossiness material (KHR_materials_pbrSpecularGlossiness), with ior = 0 and its specular colour as
    // f0_color.
    float specular_glossiness; // 0..1; default 0
    // The lam_material_id + 1 of a metal that lam_material_parse or a scene file read by its name alone; 0: none. Under
    // the built-in studio environment, the program replaces it by the physical metal (lam_material_metal).
    int metal;
    // Steps of light of LAM_REFLECTION_TOON, 0..256; default 3; below 1, 1 is used.
    float toon_steps;
    LAM_RESERVED(63);
} lam_material;

// Returns the material of parts that name no material: neutral light grey with a soft highlight.
LAM_API lam_material lam_material_default(void);

// Converts a metallic–roughness material for the classic models: kd = base (1 − metallic), ks = f0 (α + 8)/8 with f0 =
// mix(0.04, base, metallic), α = 2/roughness⁴ − 2 within 1…4096, ka = base. A classic material is returned unchanged.
LAM_API lam_material lam_material_as_classic(const lam_material *material);

// Converts in the opposite direction: base and metallic from kd and ks, roughness from α. A physical material is
// returned unchanged.
LAM_API lam_material lam_material_as_physical(const lam_material *material);

// The classic named materials of OpenGL's `teapots.c` demonstration (SGI, 1993/1997).
typedef enum lam_material_id {
    // Stones.
    LAM_MATERIAL_EMERALD,
    LAM_MATERIAL_JADE,
    LAM_MATERIAL_OBSIDIAN,
    LAM_MATERIAL_PEARL,
    LAM_MATERIAL_RUBY,
    LAM_MATERIAL_TURQUOISE,
    // Metals.
    LAM_MATERIAL_BRASS,
    LAM_MATERIAL_BRONZE,
    LAM_MATERIAL_CHROME,
    LAM_MATERIAL_COPPER,
    LAM_MATERIAL_GOLD,
    LAM_MATERIAL_SILVER,
    // Plastics.
    LAM_MATERIAL_BLACK_PLASTIC,
    LAM_MATERIAL_CYAN_PLASTIC,
    LAM_MATERIAL_GREEN_PLASTIC,
    LAM_MATERIAL_RED_PLASTIC,
    LAM_MATERIAL_WHITE_PLASTIC,
    LAM_MATERIAL_YELLOW_PLASTIC,
    // Rubbers.
    LAM_MATERIAL_BLACK_RUBBER,
    LAM_MATERIAL_CYAN_RUBBER,
    LAM_MATERIAL_GREEN_RUBBER,
    LAM_MATERIAL_RED_RUBBER,
    LAM_MATERIAL_WHITE_RUBBER,
    LAM_MATERIAL_YELLOW_RUBBER,
    LAM_MATERIAL_COUNT
} lam_material_id;

// Returns a named material, opaque. The published colours were chosen by eye on a display. Therefore, they are sRGB,
// and the call decodes them to linear light: chrome's diffuse 0.4 becomes 0.1329. LAM_COLOR_RAW leaves the colours as
// published. If the index is out of range, the result is the default material.
LAM_API lam_material lam_material_named(lam_material_id id, lam_color_mode color);

// Returns the name of a material in lower case with hyphens, "black-plastic". Returns a static string, or NULL if the
// index is out of range.
LAM_API const char *lam_material_name(lam_material_id id);

// Returns the material with this name, in upper or lower case and with ' ' or '_' for '-', or LAM_MATERIAL_COUNT if
// there is none.
LAM_API lam_material_id lam_material_find(const char *name);

#ifdef __cplusplus
}
#endif
#endif
