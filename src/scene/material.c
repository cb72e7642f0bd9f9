// material.c: the neutral default and the classic named materials.
#include "fields.h"
#include "srgb.h"

#include <lambent/material.h>

struct named_material {
    const char *name;
    lam_rgb ambient;
    lam_rgb diffuse;
    lam_rgb specular;
    float shininess;
};

// The published shininess is a fraction of OpenGL's maximum exponent, 128.
#define SHININESS(share) ((float)((share) * 128.0))

// The numbers of SGI's demo teapots.c, unchanged. The demo's colours were chosen on displays of its time (sRGB).
static const struct named_material named[LAM_MATERIAL_COUNT] = {
    [LAM_MATERIAL_EMERALD] = {"emerald",
                              {0.0215f, 0.1745f, 0.0215f},
                              {0.07568f, 0.61424f, 0.07568f},
                              {0.633f, 0.727811f, 0.633f},
                              SHININESS(0.6)},
    [LAM_MATERIAL_JADE] =
        {"jade", {0.135f, 0.2225f, 0.1575f}, {0.54f, 0.89f, 0.63f}, {0.316228f, 0.316228f, 0.316228f}, SHININESS(0.1)},
    [LAM_MATERIAL_OBSIDIAN] = {"obsidian",
                               {0.05375f, 0.05f, 0.06625f},
                               {0.18275f, 0.17f, 0.22525f},
                               {0.332741f, 0.328634f, 0.346435f},
                               SHININESS(0.3)},
    [LAM_MATERIAL_PEARL] = {"pearl",
                            {0.25f, 0.20725f, 0.20725f},
                            {1.0f, 0.829f, 0.829f},
                            {0.296648f, 0.296648f, 0.296648f},
                            SHININESS(0.088)},
    [LAM_MATERIAL_RUBY] = {"ruby",
                           {0.1745f, 0.01175f, 0.01175f},
                           {0.61424f, 0.04136f, 0.04136f},
                           {0.727811f, 0.626959f, 0.626959f},
                           SHININESS(0.6)},
    [LAM_MATERIAL_TURQUOISE] = {"turquoise",
                                {0.1f, 0.18725f, 0.1745f},
                                {0.396f, 0.74151f, 0.69102f},
                                {0.297254f, 0.30829f, 0.306678f},
                                SHININESS(0.1)},
    [LAM_MATERIAL_BRASS] = {"brass",
                            {0.329412f, 0.223529f, 0.027451f},
                            {0.780392f, 0.568627f, 0.113725f},
                            {0.992157f, 0.941176f, 0.807843f},
                            SHININESS(0.21794872)},
    [LAM_MATERIAL_BRONZE] = {"bronze",
                             {0.2125f, 0.1275f, 0.054f},
                             {0.714f, 0.4284f, 0.18144f},
                             {0.393548f, 0.271906f, 0.166721f},
                             SHININESS(0.2)},
    [LAM_MATERIAL_CHROME] =
        {"chrome", {0.25f, 0.25f, 0.25f}, {0.4f, 0.4f, 0.4f}, {0.774597f, 0.774597f, 0.774597f}, SHININESS(0.6)},
    [LAM_MATERIAL_COPPER] = {"copper",
                             {0.19125f, 0.0735f, 0.0225f},
                             {0.7038f, 0.27048f, 0.0828f},
                             {0.256777f, 0.137622f, 0.086014f},
                             SHININESS(0.1)},
    [LAM_MATERIAL_GOLD] = {"gold",
                           {0.24725f, 0.1995f, 0.0745f},
                           {0.75164f, 0.60648f, 0.22648f},
                           {0.628281f, 0.555802f, 0.366065f},
                           SHININESS(0.4)},
    [LAM_MATERIAL_SILVER] = {"silver",
                             {0.19225f, 0.19225f, 0.19225f},
                             {0.50754f, 0.50754f, 0.50754f},
                             {0.508273f, 0.508273f, 0.508273f},
                             SHININESS(0.4)},
    [LAM_MATERIAL_BLACK_PLASTIC] =
        {"black-plastic", {0.0f, 0.0f, 0.0f}, {0.01f, 0.01f, 0.01f}, {0.5f, 0.5f, 0.5f}, SHININESS(0.25)},
    [LAM_MATERIAL_CYAN_PLASTIC] = {"cyan-plastic",
                                   {0.0f, 0.1f, 0.06f},
                                   {0.0f, 0.50980392f, 0.50980392f},
                                   {0.50196078f, 0.50196078f, 0.50196078f},
                                   SHININESS(0.25)},
    [LAM_MATERIAL_GREEN_PLASTIC] =
        {"green-plastic", {0.0f, 0.0f, 0.0f}, {0.1f, 0.35f, 0.1f}, {0.45f, 0.55f, 0.45f}, SHININESS(0.25)},
    [LAM_MATERIAL_RED_PLASTIC] =
        {"red-plastic", {0.0f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.7f, 0.6f, 0.6f}, SHININESS(0.25)},
    [LAM_MATERIAL_WHITE_PLASTIC] =
        {"white-plastic", {0.0f, 0.0f, 0.0f}, {0.55f, 0.55f, 0.55f}, {0.7f, 0.7f, 0.7f}, SHININESS(0.25)},
    [LAM_MATERIAL_YELLOW_PLASTIC] =
        {"yellow-plastic", {0.0f, 0.0f, 0.0f}, {0.5f, 0.5f, 0.0f}, {0.6f, 0.6f, 0.5f}, SHININESS(0.25)},
    [LAM_MATERIAL_BLACK_RUBBER] =
        {"black-rubber", {0.02f, 0.02f, 0.02f}, {0.01f, 0.01f, 0.01f}, {0.4f, 0.4f, 0.4f}, SHININESS(0.078125)},
    [LAM_MATERIAL_CYAN_RUBBER] =
        {"cyan-rubber", {0.0f, 0.05f, 0.05f}, {0.4f, 0.5f, 0.5f}, {0.04f, 0.7f, 0.7f}, SHININESS(0.078125)},
    [LAM_MATERIAL_GREEN_RUBBER] =
        {"green-rubber", {0.0f, 0.05f, 0.0f}, {0.4f, 0.5f, 0.4f}, {0.04f, 0.7f, 0.04f}, SHININESS(0.078125)},
    [LAM_MATERIAL_RED_RUBBER] =
        {"red-rubber", {0.05f, 0.0f, 0.0f}, {0.5f, 0.4f, 0.4f}, {0.7f, 0.04f, 0.04f}, SHININESS(0.078125)},
    [LAM_MATERIAL_WHITE_RUBBER] =
        {"white-rubber", {0.05f, 0.05f, 0.05f}, {0.5f, 0.5f, 0.5f}, {0.7f, 0.7f, 0.7f}, SHININESS(0.078125)},
    [LAM_MATERIAL_YELLOW_RUBBER] =
        {"yellow-rubber", {0.05f, 0.05f, 0.0f}, {0.5f, 0.5f, 0.4f}, {0.7f, 0.7f, 0.04f}, SHININESS(0.078125)},
};

// Returns a grey that ranges from sRGB 60 to 230 under the studio rig. This leaves headroom for a highlight that shows
// the shape but does not look like metal or wet clay.
lam_material lam_material_default(void)
{
    lam_material material = {.illum = -1};
    for (int i = 0; lam_material_field(i); i++)
        field_set_standard(lam_material_field(i), &material);
    return material;
}

static bool known(lam_material_id id) { return (unsigned)id < LAM_MATERIAL_COUNT; }

static lam_rgb decoded(lam_rgb color, lam_color_mode mode)
{
    if (mode == LAM_COLOR_RAW)
        return color;
    return (lam_rgb){(float)srgb_linear((double)color.r), (float)srgb_linear((double)color.g),
                     (float)srgb_linear((double)color.b)};
}

lam_material lam_material_named(lam_material_id id, lam_color_mode color)
{
    lam_material material = lam_material_default();
    if (!known(id))
        return material;
    const struct named_material *row = &named[id];
    lam_rgb diffuse = decoded(row->diffuse, color);
    material.ambient = decoded(row->ambient, color);
    material.diffuse = (lam_rgba){diffuse.r, diffuse.g, diffuse.b, 1.0f};
    material.specular = decoded(row->specular, color);
    material.shininess = row->shininess;
    material.name = row->name;
    return material;
}

const char *lam_material_name(lam_material_id id) { return known(id) ? named[id].name : NULL; }

// Converts a character to the spelling of the table: lower case, with '-' for a space or '_'. Only ASCII letters are
// converted, independently of the locale.
static char canonical_letter(char c)
{
    if (c >= 'A' && c <= 'Z')
        return (char)(c - 'A' + 'a');
    return c == ' ' || c == '_' ? '-' : c;
}

lam_material_id lam_material_find(const char *name)
{
    for (int id = 0; name && id < LAM_MATERIAL_COUNT; id++) {
        const char *a = name, *b = named[id].name;
        while (*a && canonical_letter(*a) == *b) {
            a++;
            b++;
        }
        if (!*a && !*b)
            return (lam_material_id)id;
    }
    return LAM_MATERIAL_COUNT;
}

const char *lam_map_name(lam_map map)
{
    static const char *const names[LAM_MAP_COUNT] = {[LAM_MAP_AMBIENT] = "ambient",
                                                     [LAM_MAP_DIFFUSE] = "diffuse",
                                                     [LAM_MAP_SPECULAR] = "specular",
                                                     [LAM_MAP_EMISSION] = "emission",
                                                     [LAM_MAP_SHININESS] = "shininess",
                                                     [LAM_MAP_OPACITY] = "opacity",
                                                     [LAM_MAP_BUMP] = "bump",
                                                     [LAM_MAP_NORMAL] = "normal",
                                                     [LAM_MAP_DISPLACEMENT] = "displacement",
                                                     [LAM_MAP_REFLECTION] = "reflection",
                                                     [LAM_MAP_METALLIC] = "metallic",
                                                     [LAM_MAP_ROUGHNESS] = "roughness",
                                                     [LAM_MAP_OCCLUSION] = "occlusion",
                                                     [LAM_MAP_SPECULAR_WEIGHT] = "specular_weight",
                                                     [LAM_MAP_F0_COLOR] = "f0_color",
                                                     [LAM_MAP_CLEARCOAT] = "clearcoat",
                                                     [LAM_MAP_CLEARCOAT_ROUGHNESS] = "clearcoat_roughness",
                                                     [LAM_MAP_CLEARCOAT_NORMAL] = "clearcoat_normal",
                                                     [LAM_MAP_SHEEN_COLOR] = "sheen_color",
                                                     [LAM_MAP_SHEEN_ROUGHNESS] = "sheen_roughness",
                                                     [LAM_MAP_ANISOTROPY] = "anisotropy",
                                                     [LAM_MAP_IRIDESCENCE] = "iridescence",
                                                     [LAM_MAP_IRIDESCENCE_THICKNESS] = "iridescence_thickness",
                                                     [LAM_MAP_TRANSMISSION] = "transmission",
                                                     [LAM_MAP_THICKNESS] = "thickness"};
    return (unsigned)map < LAM_MAP_COUNT ? names[map] : NULL;
}
