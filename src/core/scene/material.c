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

#define RGB(...) {__VA_ARGS__}
// The published shininess is a fraction of OpenGL's maximum exponent, 128.
#define MATERIAL(id, name, ambient, diffuse, specular, shininess)                                                      \
    [LAM_MATERIAL_##id] = {name, ambient, diffuse, specular, (float)((shininess) * 128.0)}

// The numbers of SGI's demo teapots.c, unchanged. The demo's colours were chosen on displays of its time (sRGB).
static const struct named_material named[LAM_MATERIAL_COUNT] = {
    MATERIAL(EMERALD, "emerald", RGB(0.0215f, 0.1745f, 0.0215f), RGB(0.07568f, 0.61424f, 0.07568f),
             RGB(0.633f, 0.727811f, 0.633f), 0.6),
    MATERIAL(JADE, "jade", RGB(0.135f, 0.2225f, 0.1575f), RGB(0.54f, 0.89f, 0.63f),
             RGB(0.316228f, 0.316228f, 0.316228f), 0.1),
    MATERIAL(OBSIDIAN, "obsidian", RGB(0.05375f, 0.05f, 0.06625f), RGB(0.18275f, 0.17f, 0.22525f),
             RGB(0.332741f, 0.328634f, 0.346435f), 0.3),
    MATERIAL(PEARL, "pearl", RGB(0.25f, 0.20725f, 0.20725f), RGB(1.0f, 0.829f, 0.829f),
             RGB(0.296648f, 0.296648f, 0.296648f), 0.088),
    MATERIAL(RUBY, "ruby", RGB(0.1745f, 0.01175f, 0.01175f), RGB(0.61424f, 0.04136f, 0.04136f),
             RGB(0.727811f, 0.626959f, 0.626959f), 0.6),
    MATERIAL(TURQUOISE, "turquoise", RGB(0.1f, 0.18725f, 0.1745f), RGB(0.396f, 0.74151f, 0.69102f),
             RGB(0.297254f, 0.30829f, 0.306678f), 0.1),
    MATERIAL(BRASS, "brass", RGB(0.329412f, 0.223529f, 0.027451f), RGB(0.780392f, 0.568627f, 0.113725f),
             RGB(0.992157f, 0.941176f, 0.807843f), 0.21794872),
    MATERIAL(BRONZE, "bronze", RGB(0.2125f, 0.1275f, 0.054f), RGB(0.714f, 0.4284f, 0.18144f),
             RGB(0.393548f, 0.271906f, 0.166721f), 0.2),
    MATERIAL(CHROME, "chrome", RGB(0.25f, 0.25f, 0.25f), RGB(0.4f, 0.4f, 0.4f), RGB(0.774597f, 0.774597f, 0.774597f),
             0.6),
    MATERIAL(COPPER, "copper", RGB(0.19125f, 0.0735f, 0.0225f), RGB(0.7038f, 0.27048f, 0.0828f),
             RGB(0.256777f, 0.137622f, 0.086014f), 0.1),
    MATERIAL(GOLD, "gold", RGB(0.24725f, 0.1995f, 0.0745f), RGB(0.75164f, 0.60648f, 0.22648f),
             RGB(0.628281f, 0.555802f, 0.366065f), 0.4),
    MATERIAL(SILVER, "silver", RGB(0.19225f, 0.19225f, 0.19225f), RGB(0.50754f, 0.50754f, 0.50754f),
             RGB(0.508273f, 0.508273f, 0.508273f), 0.4),
    MATERIAL(BLACK_PLASTIC, "black-plastic", RGB(0.0f, 0.0f, 0.0f), RGB(0.01f, 0.01f, 0.01f), RGB(0.5f, 0.5f, 0.5f),
             0.25),
    MATERIAL(CYAN_PLASTIC, "cyan-plastic", RGB(0.0f, 0.1f, 0.06f), RGB(0.0f, 0.50980392f, 0.50980392f),
             RGB(0.50196078f, 0.50196078f, 0.50196078f), 0.25),
    MATERIAL(GREEN_PLASTIC, "green-plastic", RGB(0.0f, 0.0f, 0.0f), RGB(0.1f, 0.35f, 0.1f), RGB(0.45f, 0.55f, 0.45f),
             0.25),
    MATERIAL(RED_PLASTIC, "red-plastic", RGB(0.0f, 0.0f, 0.0f), RGB(0.5f, 0.0f, 0.0f), RGB(0.7f, 0.6f, 0.6f), 0.25),
    MATERIAL(WHITE_PLASTIC, "white-plastic", RGB(0.0f, 0.0f, 0.0f), RGB(0.55f, 0.55f, 0.55f), RGB(0.7f, 0.7f, 0.7f),
             0.25),
    MATERIAL(YELLOW_PLASTIC, "yellow-plastic", RGB(0.0f, 0.0f, 0.0f), RGB(0.5f, 0.5f, 0.0f), RGB(0.6f, 0.6f, 0.5f),
             0.25),
    MATERIAL(BLACK_RUBBER, "black-rubber", RGB(0.02f, 0.02f, 0.02f), RGB(0.01f, 0.01f, 0.01f), RGB(0.4f, 0.4f, 0.4f),
             0.078125),
    MATERIAL(CYAN_RUBBER, "cyan-rubber", RGB(0.0f, 0.05f, 0.05f), RGB(0.4f, 0.5f, 0.5f), RGB(0.04f, 0.7f, 0.7f),
             0.078125),
    MATERIAL(GREEN_RUBBER, "green-rubber", RGB(0.0f, 0.05f, 0.0f), RGB(0.4f, 0.5f, 0.4f), RGB(0.04f, 0.7f, 0.04f),
             0.078125),
    MATERIAL(RED_RUBBER, "red-rubber", RGB(0.05f, 0.0f, 0.0f), RGB(0.5f, 0.4f, 0.4f), RGB(0.7f, 0.04f, 0.04f),
             0.078125),
    MATERIAL(WHITE_RUBBER, "white-rubber", RGB(0.05f, 0.05f, 0.05f), RGB(0.5f, 0.5f, 0.5f), RGB(0.7f, 0.7f, 0.7f),
             0.078125),
    MATERIAL(YELLOW_RUBBER, "yellow-rubber", RGB(0.05f, 0.05f, 0.0f), RGB(0.5f, 0.5f, 0.4f), RGB(0.7f, 0.7f, 0.04f),
             0.078125),
};

// Returns a grey material, whose pixels range from sRGB 60 to 230 under the studio rig. This leaves headroom for a
// highlight that shows the shape but does not look like metal or wet clay.
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
