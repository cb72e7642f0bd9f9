// settings.c: the table of the settings of lam_draw_params. A new one is a member there, a row here and a row in the
// table of options.
#include <lambent/settings.h>

#include <string.h>

struct named_value {
    const char *word;
    int value;
};

#define COUNT_OF(list) (int)(sizeof(list) / sizeof *(list))

// A function that returns the words of a list, for lam_setting.word.
#define WORDS(name, ...)                                                                                               \
    static const char *name(int index, int *value)                                                                     \
    {                                                                                                                  \
        static const struct named_value list[] = {__VA_ARGS__};                                                        \
        if (index >= COUNT_OF(list))                                                                                   \
            return NULL;                                                                                               \
        *value = list[index].value;                                                                                    \
        return list[index].word;                                                                                       \
    }

WORDS(shading_word, {"flat", LAM_SHADING_FLAT}, {"gouraud", LAM_SHADING_GOURAUD}, {"phong", LAM_SHADING_PHONG},
      {"smooth", LAM_SHADING_GOURAUD}, {"normal", LAM_SHADING_PHONG})
WORDS(stage_word, {"auto", LAM_STAGE_AUTO}, {"application", LAM_STAGE_APPLICATION}, {"vertex", LAM_STAGE_VERTEX},
      {"fragment", LAM_STAGE_FRAGMENT})
WORDS(viewer_word, {"local", LAM_VIEWER_LOCAL}, {"infinite", LAM_VIEWER_INFINITE})
WORDS(flat_normal_word, {"face", LAM_FLAT_NORMAL_FACE}, {"vertex", LAM_FLAT_NORMAL_VERTEX})

static const char *reflection_word(int index, int *value)
{
    *value = index;
    return index < LAM_REFLECTION_COUNT ? lam_reflection_describe((lam_reflection)index)->word : NULL;
}

static const char *occlusion_word(int index, int *value)
{
    *value = index;
    return index < LAM_OCCLUSION_COUNT ? lam_occlusion_name((lam_occlusion)index) : NULL;
}

WORDS(cavity_word, {"auto", LAM_CAVITY_AUTO}, {"off", LAM_CAVITY_OFF}, {"on", LAM_CAVITY_ON})

static const char *ground_word(int index, int *value)
{
    *value = index;
    return lam_ground_name((lam_ground)index);
}

static const char *hidden_lines_word(int index, int *value)
{
    *value = index;
    return lam_hidden_lines_name((lam_hidden_lines)index);
}

WORDS(edges_word, {"crease", LAM_EDGES_CREASE}, {"boundary", LAM_EDGES_BOUNDARY}, {"silhouette", LAM_EDGES_SILHOUETTE})

#define MEMBER(kind, name) .type = LAM_SETTING_##kind, .offset = offsetof(lam_draw_params, name), .member = #name

static const lam_setting rows[] = {
    {"shading", MEMBER(WORD, shading), .word = shading_word, .expected = "color, rig, shading or reflection",
     .summary = "smooth is gouraud, normal is phong; with the stages application and vertex the default is gouraud."},
    {"reflection", MEMBER(WORD, reflection), .word = reflection_word, .expected = "color, rig, shading or reflection",
     .summary = "auto: blinn-phong."},
    {"viewer", MEMBER(WORD, viewer), .word = viewer_word, .expected = "stage, viewer or flat_normal",
     .summary = "Where the eye is for highlights."},
    {"stage", MEMBER(WORD, stage), .word = stage_word, .expected = "stage, viewer or flat_normal",
     .summary = "Where lighting is evaluated."},
    {"flat_normal", MEMBER(WORD, flat_normal), .word = flat_normal_word, .expected = "stage, viewer or flat_normal",
     .summary = "The normal of flat shading: the face's, or that of its last vertex."},
    {"match_highlights", MEMBER(FLAG, match_highlights),
     .summary = "Blinn-Phong's shininess is multiplied by 4, so that it looks like Phong."},
    {"single_scattering", MEMBER(FLAG, single_scattering),
     .summary = "GGX without the light that microfacets send to one another."},
    {"gl1", MEMBER(FLAG, gl1),
     .summary = "Lighting as in OpenGL 1: colours clamped, shininess to 128, ambient attenuated."},
    {"shadows", MEMBER(FLAG, shadows),
     .summary = "Things cast shadows in the light of every light whose own key shadows is not false."},
    {"shadow_terminator", MEMBER(NOT_FLAG, flat_terminator),
     .summary = "Shadows follow the curved surface that the vertices' normals stand for."},
    {"shadow_samples", MEMBER(WHOLE, shadow_samples), .min = 1, .max = 256, .standard = 128, .expected = "0 to 256",
     .summary = "Shadow rays to a light with a radius from each point in its penumbra."},
    {"ground", MEMBER(WORD, ground), .word = ground_word, .expected = "lam_ground",
     .summary =
         "A ground at the lowest point: shadow is clear but for shadows and occlusion; color is that of ground_color."},
    {"ground_color", MEMBER(RGB, ground_color),
     .summary = "Of the ground color, and of the bright squares of checker. Default: black, and of checker 0.6."},
    {"anisotropy", MEMBER(WHOLE, anisotropy), .min = 1, .max = 16, .standard = 1, .expected = "0 to 16",
     .summary = "Probes of a texture along the longer axis of a pixel's footprint."},
    {"reference", MEMBER(WHOLE, reference), .min = 16, .max = 1 << 20, .zero = true,
     .expected = "0 or 16 to 1048576 directions",
     .summary = "Directions by which an environment's light on physical materials is summed; 0: the split sum."},
    {"ao", MEMBER(WORD, occlusion), .word = occlusion_word, .expected = "lam_occlusion",
     .summary = "Ambient occlusion. auto: screen where a light has a share occluded or an environment lights."},
    {"cavity", MEMBER(WORD, cavity), .word = cavity_word, .expected = "lam_cavity",
     .summary = "Small valleys are darker, ridges lighter. auto: where ao is auto and screen."},
    {"ao_radius", MEMBER(NUMBER, occlusion_radius), .min = 0.001, .max = 10, .standard = 0.1,
     .expected = "more than 0, up to 10",
     .summary = "How far away surfaces occlude, as a share of half the diagonal of the scene's box."},
    {"ao_samples", MEMBER(WHOLE, occlusion_samples), .min = 1, .max = 1024, .standard = 64, .expected = "0 to 1024",
     .summary = "Rays from each lit point where ao is rays."},
    {"light_cutoff", MEMBER(NUMBER, light_cutoff), .max = 1, .standard = 0.00196, .zero_is_negative = true,
     .expected = "at most 1",
     .summary = "With more than 16 lights: the most that the lights left out of a part of the picture may add there; "
                "0: none is left out."},
    {"line_width", MEMBER(NUMBER, line_width), .min = 0.01, .max = 1000, .standard = 1.5,
     .expected = "pixels from 0 to 1000", .summary = "Width of a model's lines in pixels."},
    {"point_size", MEMBER(NUMBER, point_size), .min = 0.01, .max = 1000, .expected = "pixels from 0 to 1000",
     .summary = "Diameter of a model's points in pixels. Without it, larger the fewer there are."},
    {"wireframe", MEMBER(FLAG, wireframe), .summary = "The edges of all faces are drawn as lines over the picture."},
    {"wireframe_width", MEMBER(NUMBER, wireframe_width), .min = 0.01, .max = 1000, .standard = 1,
     .expected = "pixels from 0 to 1000", .summary = "Width of the wireframe's lines in pixels."},
    {"wireframe_color", MEMBER(RGBA, wireframe_color),
     .summary = "Of the wireframe. Default: black, and white without surfaces over a dark background."},
    {"edges", MEMBER(WORDS, edges), .word = edges_word, .expected = "edges or hidden_lines",
     .summary = "Feature edges that are drawn as lines over the picture."},
    {"edge_angle", MEMBER(ANGLE, edge_angle_rad), .min = 0.001, .max = 180, .standard = 40, .expected = "0° to 180°",
     .summary = "Creases are edges whose faces meet at more than this, degrees."},
    {"edge_width", MEMBER(NUMBER, edge_width), .min = 0.01, .max = 1000, .standard = 1.5,
     .expected = "pixels from 0 to 1000", .summary = "Width of feature edges in pixels."},
    {"edge_color", MEMBER(RGBA, edge_color),
     .summary = "Of feature edges. Default: black, and white without surfaces over a dark background."},
    {"hidden_lines", MEMBER(WORD, hidden_lines), .word = hidden_lines_word, .expected = "edges or hidden_lines",
     .summary = "What becomes of the parts of edges behind surfaces."},
    {"surfaces", MEMBER(NOT_FLAG, no_surfaces),
     .summary = "false: lines alone are drawn; surfaces hide them all the same."},
};
_Static_assert(COUNT_OF(rows) <= LAM_SETTINGS_MAX, "more rows than lam_picture_settings.draw_present has bits");

const lam_setting *lam_draw_setting(int index) { return index >= 0 && index < COUNT_OF(rows) ? &rows[index] : NULL; }

int lam_draw_setting_find(const char *key)
{
    for (int i = 0; key && i < COUNT_OF(rows); i++)
        if (strcmp(rows[i].key, key) == 0)
            return i;
    return -1;
}

static size_t member_size(const lam_setting *setting)
{
    switch (setting->type) {
    case LAM_SETTING_FLAG:
    case LAM_SETTING_NOT_FLAG:
        return sizeof(bool);
    case LAM_SETTING_NUMBER:
    case LAM_SETTING_ANGLE:
        return sizeof(float);
    case LAM_SETTING_RGBA:
        return sizeof(lam_rgba);
    case LAM_SETTING_RGB:
        return sizeof(lam_rgb);
    case LAM_SETTING_WORD:
    case LAM_SETTING_WORDS:
    case LAM_SETTING_WHOLE:
        break;
    }
    return sizeof(int);
}

bool lam_setting_is_default(const lam_setting *setting, const lam_draw_params *params)
{
    static const char zero[sizeof(lam_rgba)];
    return memcmp((const char *)params + setting->offset, zero, member_size(setting)) == 0;
}

void lam_setting_copy(const lam_setting *setting, const lam_draw_params *from, lam_draw_params *to)
{
    memcpy((char *)to + setting->offset, (const char *)from + setting->offset, member_size(setting));
}
