// settings.c: the table of the settings of lam_draw_params. To add a setting, add a member to lam_draw_params and a row
// to this table. The setting is then an option of the program and a key of scene files. A row in
// program/options/option_table.c describes the option and gives its position in the help.
#include <lambent/settings.h>

#include <string.h>

struct named_value {
    const char *word;
    int value;
    const char *summary;
};

#define COUNT_OF(list) (int)(sizeof(list) / sizeof *(list))

// Defines a list of keywords, and two functions that return the keywords (lam_setting.word) and their summaries
// (lam_setting.word_summary).
#define WORDS(name, ...)                                                                                               \
    static const struct named_value name##_list[] = {__VA_ARGS__};                                                     \
    static const char *name(int index, int *value)                                                                     \
    {                                                                                                                  \
        if (index >= COUNT_OF(name##_list))                                                                            \
            return NULL;                                                                                               \
        *value = name##_list[index].value;                                                                             \
        return name##_list[index].word;                                                                                \
    }                                                                                                                  \
    static const char *name##_summary(int index)                                                                       \
    {                                                                                                                  \
        return index < COUNT_OF(name##_list) ? name##_list[index].summary : NULL;                                      \
    }

WORDS(shading_words, {"flat", LAM_SHADING_FLAT, "one colour for each triangle"},
      {"gouraud", LAM_SHADING_GOURAUD, "one colour for each vertex, interpolated"},
      {"smooth", LAM_SHADING_GOURAUD, "an alias of gouraud"},
      {"phong", LAM_SHADING_PHONG, "interpolated normals, with lighting evaluated for each pixel"},
      {"normal", LAM_SHADING_PHONG, "an alias of phong"})
WORDS(stage_words, {"auto", LAM_STAGE_AUTO, "the stage that suits the shading"},
      {"application", LAM_STAGE_APPLICATION, "before drawing; for flat and Gouraud shading"},
      {"vertex", LAM_STAGE_VERTEX, "for each vertex; for flat and Gouraud shading"},
      {"fragment", LAM_STAGE_FRAGMENT, "for each fragment; for flat and Phong shading"})
WORDS(viewer_words, {"local", LAM_VIEWER_LOCAL, "the eye is at the camera"},
      {"infinite", LAM_VIEWER_INFINITE,
       "the eye is infinitely far away, so the direction to the eye is the same at every point"})
WORDS(flat_normal_words, {"face", LAM_FLAT_NORMAL_FACE, "the normal of the triangle"},
      {"vertex", LAM_FLAT_NORMAL_VERTEX, "the normal of the triangle's last vertex, as in OpenGL"})
WORDS(occlusion_words,
      {"auto", LAM_OCCLUSION_AUTO, "`screen` if the model is lit by the studio or by an environment, otherwise `off`"},
      {"off", LAM_OCCLUSION_OFF, "no occlusion"},
      {"screen", LAM_OCCLUSION_SCREEN, "computed from the depths of visible surfaces around each pixel"},
      {"rays", LAM_OCCLUSION_RAYS,
       "traced from each point, so surfaces that the camera does not see also occlude; slower, and only on the CPU"})
WORDS(cavity_words, {"auto", LAM_CAVITY_AUTO, "on if ambient occlusion is `auto` and computed in screen space"},
      {"off", LAM_CAVITY_OFF, "no cavity shading"}, {"on", LAM_CAVITY_ON, "valleys are darker"})
WORDS(specular_aa_words, {"auto", LAM_SPECULAR_AA_AUTO, "on if the model is lit by the studio or by an environment"},
      {"off", LAM_SPECULAR_AA_OFF, "the exact equations"},
      {"on", LAM_SPECULAR_AA_ON, "the variance of the normals within each pixel increases the roughness"})
WORDS(denoise_words, {"auto", LAM_DENOISE_AUTO, "on from two bounces on, below 1024 paths, without `noise`"},
      {"off", LAM_DENOISE_OFF, "the mean of the paths, which contains noise and is right on average"},
      {"on", LAM_DENOISE_ON, "filter the noise; edges, textures and highlights stay"})
WORDS(map_filter_words, {"file", LAM_MAP_FILTER_FILE, "the filters that the model file selects for each map"},
      {"nearest", LAM_MAP_FILTER_NEAREST, "the nearest texel: blocks near the eye, noise in the distance"},
      {"bilinear", LAM_MAP_FILTER_BILINEAR, "four texels, interpolated: smooth near the eye, noise in the distance"},
      {"trilinear", LAM_MAP_FILTER_TRILINEAR, "four texels in each of two smaller copies of the picture (mipmaps)"})
WORDS(brighten_words, {"auto", LAM_BRIGHTEN_AUTO, "on for model files lit by the built-in studio environment"},
      {"off", LAM_BRIGHTEN_OFF, "all models receive the same light"})
WORDS(glass_words, {"off", LAM_GLASS_OFF, "materials as the file describes them"},
      {"auto", LAM_GLASS_AUTO, "blended materials whose name contains glass or window become thin glass"})
WORDS(ground_words, {"off", LAM_GROUND_NONE, "no ground"},
      {"shadow", LAM_GROUND_SHADOW, "a transparent plane that shows only shadows and occlusion, in translucent black"},
      {"checker", LAM_GROUND_CHECKER,
       "a checkerboard; the side of a square is 1, 2 or 5 times a power of ten in the model's units"},
      {"color", LAM_GROUND_COLOR, "a plane in one colour, by default black"})
WORDS(edges_words, {"crease", LAM_EDGES_CREASE, "edges at which two faces meet at an angle"},
      {"boundary", LAM_EDGES_BOUNDARY, "edges that belong to only one face"},
      {"silhouette", LAM_EDGES_SILHOUETTE, "edges between front and back faces"})
WORDS(hidden_lines_words, {"remove", LAM_HIDDEN_LINES_REMOVE, "omit the edges"},
      {"dash", LAM_HIDDEN_LINES_DASH, "draw dashed lines"},
      {"show", LAM_HIDDEN_LINES_SHOW, "draw the edges as if no surface hid them"})
WORDS(surfaces_words, {"on", 0, "draw surfaces"}, {"off", 1, "draw only lines and points"})
WORDS(terminator_words, {"on", 0, "shadow rays start on the curved surface defined by the normals"},
      {"off", 1,
       "shadow rays start on the flat triangles, which makes the shadow terminator of coarse smooth meshes visible"})

static const char *reflection_words(int index, int *value)
{
    *value = index;
    return index < LAM_REFLECTION_COUNT ? lam_reflection_describe((lam_reflection)index)->word : NULL;
}

static const char *reflection_words_summary(int index)
{
    return lam_reflection_describe((lam_reflection)index)->summary;
}

#define MEMBER(kind, name) .type = LAM_SETTING_##kind, .offset = offsetof(lam_draw_params, name), .member = #name
#define WORDS_OF(name)     .word = name, .word_summary = name##_summary

static const lam_setting rows[] = {
    {"shading", MEMBER(WORD, shading), WORDS_OF(shading_words), .expected = "color, rig, shading or reflection",
     .summary = "The shading method: flat, gouraud (per vertex) or phong (per pixel)."},
    {"reflection", MEMBER(WORD, reflection), WORDS_OF(reflection_words),
     .expected = "color, rig, shading or reflection", .summary = "The reflection model."},
    {"viewer", MEMBER(WORD, viewer), WORDS_OF(viewer_words), .expected = "stage, viewer or flat_normal",
     .summary = "The eye's position for highlights: local or infinite."},
    {"stage", MEMBER(WORD, stage), WORDS_OF(stage_words), .expected = "stage, viewer or flat_normal",
     .summary = "The stage that evaluates the lighting: application, vertex or fragment."},
    {"flat_normal", MEMBER(WORD, flat_normal), WORDS_OF(flat_normal_words), .expected = "stage, viewer or flat_normal",
     .summary = "The normal for flat shading: the normal of the triangle, or of its last vertex."},
    {"match_highlights", MEMBER(FLAG, match_highlights),
     .summary = "Multiply Blinn-Phong's shininess by 4, so that highlights look like Phong's."},
    {"single_scattering", MEMBER(FLAG, single_scattering),
     .summary = "Omit multiple scattering between microfacets (GGX)."},
    {"gl1", MEMBER(FLAG, gl1),
     .summary = "Compute lighting as in OpenGL 1: clamp colours, limit shininess to 128, attenuate ambient light."},
    {"shadows", MEMBER(FLAG, shadows), .summary = "Cast shadows."},
    {"shadow_terminator", MEMBER(NOT_FLAG, flat_terminator), WORDS_OF(terminator_words),
     .summary = "The surface on which shadow rays start: the curved surface defined by the normals (on), or the flat "
                "triangles (off)."},
    {"shadow_samples", MEMBER(WHOLE, shadow_samples), .min = 1, .max = 256, .standard = 128, .expected = "0 to 256",
     .summary = "The number of shadow rays from each point in a penumbra to a light with a radius."},
    {"ground", MEMBER(WORD, ground), WORDS_OF(ground_words), .expected = "lam_ground",
     .summary = "A ground plane at the model's lowest point: shadow, checker, a colour or off."},
    {"ground_color", MEMBER(RGB, ground_color),
     .summary = "The colour of the ground, or of the bright squares of a checkerboard. Default: black, or 0.6 for a "
                "checkerboard."},
    {"anisotropy", MEMBER(WHOLE, anisotropy), .min = 1, .max = 16, .zero = true, .expected = "0 to 16",
     .summary = "The largest number of texture samples per pixel on slanted surfaces, 1 to 16; more samples make "
                "textures sharper. With 0, Lambent uses up to 8 for colours, normals and bumps."},
    {"map_filter", MEMBER(WORD, map_filter), WORDS_OF(map_filter_words), .expected = "lam_map_filter",
     .summary = "The filter of textures: file, nearest, bilinear or trilinear."},
    {"reference", MEMBER(WHOLE, reference), .min = 16, .max = 1 << 20, .zero = true,
     .expected = "0 or 16 to 1048576 directions",
     .summary = "The number of directions (16 to 1048576) for integrating the environment's light on physical "
                "materials. With 0, Lambent uses the split-sum approximation instead."},
    {"bounces", MEMBER(WHOLE, bounces), .min = 1, .max = 1000, .zero = true, .expected = "0 to 1000",
     .summary =
         "The number of times that light may be reflected on its way to the eye, by path tracing: 1 adds shadows "
         "of all light, 2 and more add light between surfaces. With 0, Lambent computes local lighting."},
    {"paths", MEMBER(WHOLE, paths), .min = 1, .max = 65536, .standard = 64, .expected = "0 to 65536",
     .summary = "The number of paths per pixel, if `bounces` is above 0; four times as many halve the noise."},
    {"denoise", MEMBER(WORD, denoise), WORDS_OF(denoise_words), .expected = "lam_denoise",
     .summary = "Filter the noise of `bounces`: auto, off or on."},
    {"noise", MEMBER(NUMBER, noise), .max = 255, .zero = true, .expected = "0 to 255",
     .summary = "Trace paths until the estimated noise is at most this, in values of 8-bit pictures (0 to 255)."},
    {"stop_after", MEMBER(NUMBER, stop_after_s), .max = 1e9, .zero = true, .expected = "0 to 1000000000",
     .summary = "Finish the picture after this many seconds, with the paths traced by then."},
    {"caustics", MEMBER(FLAG, caustics),
     .summary = "Refract light at glass on all paths of `bounces`, so that glass focuses light on rough surfaces."},
    {"ao", MEMBER(WORD, occlusion), WORDS_OF(occlusion_words), .expected = "lam_occlusion",
     .summary = "Ambient occlusion: auto, off, screen or rays."},
    {"cavity", MEMBER(WORD, cavity), WORDS_OF(cavity_words), .expected = "lam_cavity",
     .summary = "Darken small valleys: auto, off or on."},
    {"specular_aa", MEMBER(WORD, specular_aa), WORDS_OF(specular_aa_words), .expected = "lam_specular_aa",
     .summary = "Reduce glitter on bumpy physical materials: auto, off or on."},
    {"brighten", MEMBER(WORD, brighten), WORDS_OF(brighten_words), .expected = "lam_brighten",
     .summary = "Use a brighter studio for dark models and a dimmer studio for white models: auto or off."},
    {"glass", MEMBER(WORD, glass), WORDS_OF(glass_words), .expected = "lam_glass",
     .summary = "Draw blended materials named glass or window as thin glass with full reflections: off or auto."},
    {"background_environment", MEMBER(NUMBER, background_environment), .max = 1, .zero = true, .expected = "0 to 1",
     .summary =
         "Show the environment behind the model, blurred like in a surface of this roughness, up to 1; 0.045 and "
         "less is sharp, and 0 shows the background's colour."},
    {"ao_radius", MEMBER(NUMBER, occlusion_radius), .min = 0.001, .max = 10, .standard = 0.1,
     .expected = "more than 0, up to 10",
     .summary = "The largest distance at which surfaces occlude, as a fraction of half the diagonal of the scene's "
                "bounding box."},
    {"ao_samples", MEMBER(WHOLE, occlusion_samples), .min = 1, .max = 1024, .standard = 64, .expected = "0 to 1024",
     .summary = "The number of rays from each lit point for ambient occlusion (`rays`); more rays reduce noise."},
    {"light_cutoff", MEMBER(NUMBER, light_cutoff), .max = 1, .standard = 0.5 / 255, .zero_is_negative = true,
     .expected = "at most 1",
     .summary = "The maximum error caused by skipping weak lights; 0 skips only lights that contribute nothing."},
    {"line_width", MEMBER(NUMBER, line_width), .min = 0.01, .max = 1000, .standard = 1.5,
     .expected = "pixels from 0 to 1000", .summary = "The width of lines in the model file, in pixels."},
    {"point_size", MEMBER(NUMBER, point_size), .min = 0.01, .max = 1000, .expected = "pixels from 0 to 1000",
     .summary = "The diameter of points in the model file, in pixels; the default depends on the number of points."},
    {"wireframe", MEMBER(FLAG, wireframe), .summary = "Draw the edges of all faces as lines over the picture."},
    {"wireframe_width", MEMBER(NUMBER, wireframe_width), .min = 0.01, .max = 1000, .standard = 1,
     .expected = "pixels from 0 to 1000", .summary = "The width of the wireframe's lines, in pixels."},
    {"wireframe_color", MEMBER(RGBA, wireframe_color),
     .summary = "The colour of the wireframe: by default black, or white if surfaces are off and the background is "
                "dark."},
    {"edges", MEMBER(WORDS, edges), WORDS_OF(edges_words), .expected = "edges or hidden_lines",
     .summary = "Draw feature edges as lines: all, none, or some of crease,boundary,silhouette."},
    {"edge_angle", MEMBER(ANGLE, edge_angle_rad), .min = 0.001, .max = 180, .standard = 40, .expected = "0° to 180°",
     .summary = "An edge is a crease if its two faces meet at more than this angle."},
    {"edge_width", MEMBER(NUMBER, edge_width), .min = 0.01, .max = 1000, .standard = 1.5,
     .expected = "pixels from 0 to 1000", .summary = "The width of feature edges, in pixels."},
    {"edge_color", MEMBER(RGBA, edge_color),
     .summary = "The colour of feature edges: by default black, or white if surfaces are off and the background is "
                "dark."},
    {"hidden_lines", MEMBER(WORD, hidden_lines), WORDS_OF(hidden_lines_words), .expected = "edges or hidden_lines",
     .summary = "How to draw edges behind surfaces: remove, dash or show."},
    {"surfaces", MEMBER(NOT_FLAG, no_surfaces), WORDS_OF(surfaces_words),
     .summary = "Whether to draw surfaces: on, or off to draw only lines."},
    {"dimensions", MEMBER(FLAG, dimensions),
     .summary = "Draw the size of the model's bounding box, with arrows and numbers."},
    {"scale_bar", MEMBER(FLAG, scale_bar), .summary = "Draw a scale bar."},
    {"axes", MEMBER(FLAG, axes), .summary = "Draw the directions of the axes: x red, y green, z blue."},
    {"grid", MEMBER(FLAG, grid), .summary = "Draw a grid on the plane under the model."},
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
