// plot.c: the command `plot`: plots attenuation, spot cones, highlights and other functions as curves, and prints the
// values.
#include "plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/light_eval.h>
#include <lambent/words.h>

#include "options.h"
#include "commands.h"
#include "console.h"
#include "json.h"
#include "limit_options.h"
#include "output.h"
#include "failure.h"
#include "terminal.h"
#include "vectors.h"

enum { TABLE_STEPS = 100 };

#define PLOT_KINDS "attenuation, spot, highlight, lambert, fresnel, tone, depth or lobe"

// Colours that remain distinct for colour-blind readers (Okabe and Ito, 2008), without yellow, which is hard to see on
// white.
static const uint32_t palette[] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x222222};

static double attenuation_value(const struct curve *c, double x)
{
    return (double)lam_attenuation_at(&c->light, (float)x);
}

static double spot_value(const struct curve *c, double x) { return (double)lam_spot_at(&c->light, radians(x)); }

static double highlight_value(const struct curve *c, double x)
{
    return (double)lam_highlight_at(c->reflection, c->shininess, radians(x));
}

static double cosine_of(double degrees) { return cos(radians(degrees)); }

static double lambert_value(const struct curve *c, double x)
{
    return c->style ? 1 / cosine_of(x) : x < 90 ? cosine_of(x) : 0;
}

// Schlick (1994).
static double schlick_value(const struct curve *c, double x)
{
    return c->number[0] + (1 - c->number[0]) * pow(1 - (x < 90 ? cosine_of(x) : 0), 5);
}

// Fresnel's equations for a dielectric, the mean of both polarisations.
static double fresnel_value(const struct curve *c, double x)
{
    double in = x < 90 ? cosine_of(x) : 0, ior = c->number[0], out = sqrt(1 - (1 - in * in) / (ior * ior));
    double across = (in - ior * out) / (in + ior * out), along = (ior * in - out) / (ior * in + out);
    return (across * across + along * along) / 2;
}

static double tone_value(const struct curve *c, double x)
{
    return (double)lam_tone_apply(c->tone, (lam_rgb){(float)x, (float)x, (float)x}).g;
}

// The depth in the window, 0 to 1, of a point at the distance x along the axis of a perspective camera.
static double depth_value(const struct curve *c, double x)
{
    double near = c->number[0], far = c->number[1];
    return x <= near ? 0 : x >= far ? 1 : far / (far - near) * (1 - near / x);
}

// Returns the smallest x from which the curve stays below a level. All curves decrease monotonically. Bisects an
// interval until its ends are neighbouring floats.
static double find_below(const struct curve *curve, double level, double farthest)
{
    // An inverse square evaluates to 0 at the light itself, so the search starts next to the light.
    double low = curve->value(curve, 0) == 0 ? 1e-3 : 0, high = farthest < 1 ? farthest : 1;
    if (curve->value(curve, low) < level)
        return 0;
    while (high < farthest && curve->value(curve, high) >= level) {
        low = high;
        high = 2 * high < farthest ? 2 * high : farthest;
    }
    if (curve->value(curve, high) >= level)
        return (double)__builtin_inff();
    for (;;) {
        float middle = (float)((low + high) / 2);
        if ((double)middle <= low || (double)middle >= high)
            return high;
        if (curve->value(curve, (double)middle) < level)
            high = (double)middle;
        else
            low = (double)middle;
    }
}

// --- parsing the curves

// Adds the curve of a light. The label consists of `name` (may be NULL) and the light's numbers.
static bool add_faded(struct plot *plot, const lam_light *light, const char *name, lam_error *error)
{
    struct curve *curve = plot_add_curve(plot, attenuation_value, error);
    if (!curve)
        return false;
    curve->light = *light;
    curve->light.name = NULL; // the name's owner is freed before the plot
    curve->light.object = NULL;
    curve->marked = true;
    lam_attenuation a = light->attenuation;
    if (a.constant == 0 && a.linear == 0 && a.quadratic == 0)
        a.constant = 1;
    int used = snprintf(curve->label, sizeof curve->label, "%.40s%sa/b/c = %.5g/%.5g/%.5g", name ? name : "",
                        name ? ": " : "", (double)a.constant, (double)a.linear, (double)a.quadratic);
    if (light->range > 0)
        snprintf(curve->label + used, sizeof curve->label - (size_t)used, ", range %.5g", (double)light->range);
    return true;
}

static bool fades(const lam_light *light) { return light->type == LAM_LIGHT_POINT || light->type == LAM_LIGHT_SPOT; }

// Parses a light and adds its curve with `add`.
static bool add_words(struct plot *plot, const char *kind, const char *word, const char *light,
                      bool add(struct plot *plot, const lam_light *light, const char *word, lam_error *error),
                      lam_error *error)
{
    lam_error reason;
    // an empty scene: it contains no triangles, so lengths in r are rejected
    lam_scene *scene = lam_scene_make(&reason);
    bool read = scene && lam_scene_add_light_text(scene, light, NULL, &reason) == 0;
    bool ok = read ? add(plot, lam_scene_light(scene, 0), word, error)
                   : complain(error, reason.code, "plot %s: '%.60s': %.300s", kind, word, reason.text);
    lam_scene_free(scene);
    return ok;
}

// Adds a light in the syntax of --light, such as "point:attenuation=1/0.5/0.2,name=lamp".
static bool add_fading(struct plot *plot, const lam_light *light, const char *word, lam_error *error)
{
    if (!fades(light))
        return plot_wrong(error, "attenuation", word, "a point or spot light, since the others do not fade");
    return add_faded(plot, light, light->name, error);
}

// Adds the lights of a model or scene file.
static bool add_lights_of(struct plot *plot, const char *path, lam_error *error)
{
    lam_scene *scene =
        lam_scene_load(path, &(lam_load_params){.models_anywhere = !plot->files_inside}, &plot->control, error);
    if (!scene)
        return false;
    bool ok = true;
    int found = 0;
    for (int i = 0; ok && i < lam_scene_light_count(scene); i++) {
        const lam_light *light = lam_scene_light(scene, i);
        if (!fades(light))
            continue;
        char number[32];
        snprintf(number, sizeof number, "light %d", i + 1);
        ok = add_faded(plot, light, light->name ? light->name : number, error);
        found++;
    }
    lam_scene_free(scene);
    return ok &&
           (found || complain(error, LAM_BAD_ARGUMENT, "plot attenuation: '%.200s' has no point or spot light", path));
}

static bool is_light(const char *word)
{
    for (int i = 0; i < LAM_LIGHT_TYPE_COUNT; i++) {
        const char *type = lam_light_type_describe((lam_light_type)i)->word;
        size_t length = strlen(type);
        if (strncmp(word, type, length) == 0 && (word[length] == ':' || !word[length]))
            return true;
    }
    return false;
}

// Adds "a/b/c", "a/b/c/range", a light, or the lights of a file.
static bool add_attenuation(struct plot *plot, const char *word, lam_error *error)
{
    double part[4] = {0};
    int count = 0;
    const char *rest = word;
    if (is_light(word))
        return add_words(plot, "attenuation", word, word + (*word == '+'), add_fading, error);
    if (access(word, F_OK) == 0)
        return add_lights_of(plot, word, error);
    do {
        rest = count < 4 ? read_number(count ? rest + 1 : rest, &part[count]) : NULL;
        count++;
    } while (rest && *rest == '/');
    if (!rest || *rest || count < 3)
        return plot_wrong(
            error, "attenuation", word,
            "a/b/c or a/b/c/range, such as 1/0.54/0.2, a light such as point:attenuation=1/0.54/0.2, or a "
            "file with lights");
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    light.attenuation = (lam_attenuation){(float)part[0], (float)part[1], (float)part[2]};
    light.range = (float)part[3];
    lam_error reason;
    if (part[0] == 0 && part[1] == 0 && part[2] == 0)
        return plot_wrong(error, "attenuation", word, "at least one of a, b and c above 0");
    if (!lam_light_check(&light, &reason))
        return complain(error, LAM_BAD_ARGUMENT, "plot attenuation: '%.60s': %.300s", word, reason.text);
    return add_faded(plot, &light, NULL, error);
}

// Adds "cutoff=30,exponent=8" or "inner=20,outer=35", with the keys of a light.
static bool add_spot_light(struct plot *plot, const lam_light *light, const char *word, lam_error *error)
{
    if (light->outer_rad == 0 && !strstr(word, "cutoff") && !strstr(word, "exponent"))
        return plot_wrong(error, "spot", word, "cutoff=DEGREES,exponent=E or inner=DEGREES,outer=DEGREES");
    struct curve *curve = plot_add_curve(plot, spot_value, error);
    if (!curve)
        return false;
    curve->light = *light;
    curve->light.name = curve->light.object = NULL; // owned by the scene
    if (light->outer_rad > 0)
        snprintf(curve->label, sizeof curve->label, "inner %.5g°, outer %.5g°", in_degrees((double)light->inner_rad),
                 in_degrees((double)light->outer_rad));
    else if (light->cutoff_rad > 0)
        snprintf(curve->label, sizeof curve->label, "cutoff %.5g°, exponent %.5g",
                 in_degrees((double)light->cutoff_rad), (double)light->exponent);
    else
        snprintf(curve->label, sizeof curve->label, "exponent %.5g, no cutoff", (double)light->exponent);
    return true;
}

// Parses the cone of a spot light with the keys of --light.
static bool add_spot(struct plot *plot, const char *word, lam_error *error)
{
    char light[200];
    if (snprintf(light, sizeof light, "spot:%s", word) >= (int)sizeof light)
        return plot_wrong(error, "spot", word, "cutoff=DEGREES,exponent=E or inner=DEGREES,outer=DEGREES");
    return add_words(plot, "spot", word, light, add_spot_light, error);
}

static bool add_highlight(struct plot *plot, const char *word, lam_error *error)
{
    double alpha;
    const char *rest = read_number(word, &alpha);
    if (!rest || *rest || !(alpha >= 0 && alpha <= 1e9))
        return plot_wrong(error, "highlight", word, "a shininess of 0 or more, such as 50");
    for (int i = 0; i < 3; i++) {
        struct curve *curve = plot_add_curve(plot, highlight_value, error);
        if (!curve)
            return false;
        curve->reflection = i == 0 ? LAM_REFLECTION_PHONG : LAM_REFLECTION_BLINN_PHONG;
        curve->shininess = (float)(i == 2 ? 4 * alpha : alpha);
        curve->style = i == 0 ? 0 : 3 - i;
        snprintf(curve->label, sizeof curve->label, "%s, shininess %.6g", i == 0 ? "Phong" : "Blinn–Phong",
                 (double)curve->shininess);
    }
    return true;
}

static bool add_lambert(struct plot *plot, const char *word, lam_error *error)
{
    bool area = strcmp(word, "area") == 0;
    if (!area && strcmp(word, "share") != 0)
        return plot_wrong(error, "lambert", word, "share or area");
    struct curve *curve = plot_add_curve(plot, lambert_value, error);
    if (!curve)
        return false;
    curve->style = area;
    snprintf(curve->label, sizeof curve->label, "%s",
             area ? "1/cos θ: area of a beam of 1" : "cos θ: light on an area of 1");
    return true;
}

static bool add_fresnel(struct plot *plot, const char *word, lam_error *error)
{
    double number;
    bool exact = strncmp(word, "ior=", 4) == 0;
    const char *rest = read_number(word + (exact ? 4 : 0), &number);
    if (!rest || *rest || !(exact ? number > 1 && number <= 100 : number >= 0 && number <= 1))
        return plot_wrong(error, "fresnel", word,
                          "the reflectance f0 from 0 to 1, such as 0.04, or ior= and an index of refraction above 1");
    struct curve *curve = plot_add_curve(plot, exact ? fresnel_value : schlick_value, error);
    if (!curve)
        return false;
    curve->number[0] = number;
    curve->style = exact;
    snprintf(curve->label, sizeof curve->label, exact ? "Fresnel, index of refraction %.6g" : "Schlick, f0 = %.6g",
             number);
    return true;
}

static bool add_tone(struct plot *plot, const char *word, lam_error *error)
{
    int tone = LAM_TONE_NONE;
    while (tone < LAM_TONE_COUNT && strcmp(lam_tone_name((lam_tone)tone), word) != 0)
        tone++;
    if (tone == LAM_TONE_COUNT) {
        char known[200] = "";
        for (int i = LAM_TONE_NONE; i < LAM_TONE_COUNT; i++) {
            const char *before = i == LAM_TONE_NONE ? "" : i == LAM_TONE_COUNT - 1 ? " or " : ", ";
            size_t used = strlen(known);
            snprintf(known + used, sizeof known - used, "%s%s", before, lam_tone_name((lam_tone)i));
        }
        return plot_wrong(error, "tone", word, known);
    }
    struct curve *curve = plot_add_curve(plot, tone_value, error);
    if (!curve)
        return false;
    curve->tone = (lam_tone)tone;
    snprintf(curve->label, sizeof curve->label, "%s: %s", word,
             tone == LAM_TONE_NONE ? "min(x, 1)" : lam_tone_formula(curve->tone));
    return true;
}

static bool add_depth(struct plot *plot, const char *word, lam_error *error)
{
    double near, far;
    const char *rest = read_number(word, &near);
    rest = rest && *rest == '/' ? read_number(rest + 1, &far) : NULL;
    if (!rest || *rest || !(near > 0 && far > near))
        return plot_wrong(error, "depth", word, "NEAR/FAR, the distances of the clipping planes, such as 0.1/100");
    struct curve *curve = plot_add_curve(plot, depth_value, error);
    if (!curve)
        return false;
    curve->number[0] = near;
    curve->number[1] = far;
    // dz/dd is far near / ((far − near) d²), so that a step of the buffer at the far plane is:
    double step = far * (far - near) / near;
    snprintf(curve->label, sizeof curve->label, "near %.6g, far %.6g; 24-bit step at far %.2g", near, far,
             step / 16777215);
    return true;
}

// A kind of plot.
struct kind {
    const char *name, *title, *x_label, *y_label;
    bool (*add)(struct plot *plot, const char *word, lam_error *error);
    const char *standard[5]; // the default curves
    double x_max, farthest;  // 0 means that the axis is fitted to the curves
    int per_color;           // the number of curves with the same colour
    bool fades;              // the curves decrease to 0
};

static const struct kind kinds[] = {
    {"attenuation",
     "Attenuation 1/(a + b·d + c·d²)",
     "distance d",
     "share of the light that arrives",
     add_attenuation,
     {"1/0/0", "1/0.54/0.2", "1/0/1", NULL},
     0,
     1e9,
     1,
     true},
    {"spot",
     "Spot light",
     "angle from the axis in degrees",
     "share of the light",
     add_spot,
     {"cutoff=30,exponent=0", "cutoff=30,exponent=8", "exponent=32", "inner=20,outer=35", NULL},
     90,
     180,
     1,
     true},
    {"highlight",
     "Highlight: Phong cos(φ)^α, Blinn–Phong cos(φ/2)^α",
     "angle φ between reflected light and eye in degrees",
     "strength S",
     add_highlight,
     {"10", "50", "1000", NULL},
     90,
     180,
     3,
     true},
    {.name = "lambert",
     .title = "Lambert's law: an oblique beam covers more area",
     .x_label = "angle θ between the normal and the light in degrees",
     .y_label = "share, area",
     .add = add_lambert,
     .standard = {"share", "area"},
     .x_max = 90,
     .per_color = 1},
    {.name = "fresnel",
     .title = "Fresnel: f0 + (1 − f0) (1 − cos θ)⁵",
     .x_label = "angle θ between the normal and the light in degrees",
     .y_label = "reflected share",
     .add = add_fresnel,
     .standard = {"0.04", "ior=1.5", "0.3", "0.9"},
     .x_max = 90,
     .per_color = 1},
    {.name = "tone",
     .title = "Tone curves",
     .x_label = "light x",
     .y_label = "light of the display, before encoding",
     .add = add_tone,
     .standard = {"none", "reinhard", "contrast"},
     .x_max = 2,
     .per_color = 1},
    {.name = "depth",
     .title = "Depth z = far/(far − near) · (1 − near/d)",
     .x_label = "distance d along the view axis",
     .y_label = "depth z in the window",
     .add = add_depth,
     .standard = {"0.1/20", "1/20", "5/20"},
     .per_color = 1},
    {.name = "lobe",
     .title = "Lobes in the plane of n and l",
     .x_label = "angle of v from the normal in degrees, towards r",
     .y_label = "reflected share, relative to its peak",
     .add = plot_add_lobe,
     .standard = {"phong:50", "blinn-phong:200", "ggx:0.3"},
     .x_max = 90,
     .per_color = 1},
};

static const struct kind *find_kind(const char *name, lam_error *error)
{
    struct suggestion nearest = suggest_start(name);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (strcmp(kinds[i].name, name) == 0)
            return &kinds[i];
        suggest_try(&nearest, kinds[i].name);
    }
    complain(error, LAM_BAD_ARGUMENT, "plot: found '%.100s', expected " PLOT_KINDS "%s%s%s", name,
             nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
    return NULL;
}

// Returns the length of the axis. The axis ends where the last curve has fallen to a twentieth of its maximum, so that
// the curves fill the plot. The length is 10 if no curve falls that far. Curves fall below 1/255 beyond the end of the
// axis. The legend therefore states where they fall below 1/255.
static double length_of(const struct plot *plot, double farthest)
{
    double most = 0;
    for (int i = 0; i < plot->count; i++) {
        double end = find_below(&plot->curves[i], 1.0 / 20, farthest);
        most = end < 1e30 && end > most ? end : most;
    }
    return most > 0 ? most : 10;
}

static bool fill(struct plot *plot, const struct kind *kind, int count, char **words, const struct options *o,
                 lam_error *error)
{
    *plot = (struct plot){.kind = kind->name,
                          .title = o->captions.title ? o->captions.title : kind->title,
                          .x_label = kind->x_label,
                          .y_label = kind->y_label,
                          .y_max = 1,
                          .level = kind->add == add_attenuation ? 1.0 / 255.0 : 0,
                          .level_label = "1/255",
                          .files_inside = o->limits.files_inside,
                          .control = limits_control(o)};
    for (int i = 0; i < count; i++)
        if (!kind->add(plot, words[i], error))
            return false;
    for (int i = 0; count == 0 && kind->standard[i]; i++)
        if (!kind->add(plot, kind->standard[i], error))
            return false;
    double farthest = 0;
    for (int i = 0; i < plot->count; i++) {
        struct curve *curve = &plot->curves[i];
        curve->color = palette[(size_t)(i / kind->per_color) % (sizeof palette / sizeof *palette)];
        curve->below = kind->fades ? find_below(curve, 1.0 / 255, kind->farthest) : (double)NAN;
        farthest = curve->number[1] > farthest ? curve->number[1] : farthest;
    }
    plot->x_max = o->plot.to > 0    ? o->plot.to
                  : kind->x_max > 0 ? kind->x_max
                  : kind->fades     ? length_of(plot, kind->farthest)
                                    : farthest;
    // Attenuations may start above 1. The plot clips values above 2.
    for (int i = 0; i < plot->count; i++)
        for (int k = 0; k <= TABLE_STEPS; k++)
            if (plot->curves[i].value(&plot->curves[i], plot->x_max * k / TABLE_STEPS) > 1)
                plot->y_max = 2;
    return true;
}

// --- output

static void print_text(FILE *file, const struct plot *plot)
{
    for (int i = 0; i < plot->count; i++) {
        const struct curve *c = &plot->curves[i];
        // The width of the column is a number of characters, so bytes that continue a character are not counted.
        int letters = 0;
        for (const char *s = c->label; *s; s++)
            letters += (*s & 0xC0) != 0x80;
        fprintf(file, "%s%*s  ", c->label, letters < 30 ? 30 - letters : 0, "");
        if (c->below - c->below != 0 && !(c->below > 0)) // NaN
            for (int k = 0; k <= 4; k++)
                fprintf(file, "%s%.5g: %.5g%s", k ? ", " : "", plot->x_max * k / 4, c->value(c, plot->x_max * k / 4),
                        k < 4 ? "" : "\n");
        else if (c->below < 1e30)
            fprintf(file, "below 1/255 from %.5g%s\n", c->below,
                    strcmp(plot->kind, "attenuation") == 0 ? "" : " degrees");
        else
            fprintf(file, "never below 1/255\n");
    }
}

static void print_json(FILE *file, const struct plot *plot, const char *path)
{
    struct json json = {.file = file};
    json_open(&json, NULL, '{');
    json_text(&json, "plot", plot->kind);
    json_text(&json, "x", plot->x_label);
    json_text(&json, "y", plot->y_label);
    json_open(&json, "curves", '[');
    for (int i = 0; i < plot->count; i++) {
        const struct curve *c = &plot->curves[i];
        json_open(&json, NULL, '{');
        json_text(&json, "label", c->label);
        json_number(&json, "below_1_255_from", c->below);
        json_open(&json, "points", '[');
        for (int k = 0; k <= TABLE_STEPS; k++) {
            double x = (double)(float)(plot->x_max * k / TABLE_STEPS);
            json_numbers(&json, NULL, (double[]){x, c->value(c, x)}, 2);
        }
        json_close(&json, ']');
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_text(&json, "picture", path);
    json_close(&json, '}');
    putc('\n', file);
}

static bool draw_to(const struct plot *plot, const char *path, const struct options *o, lam_error *error)
{
    bool svg = drawing_is_svg(path), to_stdout = strcmp(path, "-") == 0;
    if (!terminal_start(o, true, error))
        return false;
    if (to_stdout && isatty(STDOUT_FILENO) && !terminal_shows())
        return terminal_refuse("plot", error);
    if (!svg && !output_check_bytes(path, "plot", ".svg, ", error))
        return false;
    if (!to_stdout && !output_check(path, "", output_is_named(o->picture.output), error))
        return false;
    if (!svg && o->captions.title && !o->captions.no_captions &&
        !drawing_check_text("title", o->captions.title, o->captions.font != NULL, error))
        return false;
    struct drawing drawing;
    bool sized = o->picture.has_size;
    if (!drawing_open(&drawing, sized ? o->picture.width : 1600, sized ? o->picture.height : 1000, svg,
                      !o->captions.no_captions, o->captions.font, error))
        return false;
    char text[300];
    snprintf(text, sizeof text, "%d curves over the %s: %.200s%s", plot->count, plot->x_label, plot->curves[0].label,
             plot->count > 1 ? " and others" : "");
    bool ok = drawing_describe(&drawing, plot->title, text, error) &&
              (strcmp(plot->kind, "lobe") == 0 ? plot_draw_lobes : plot_draw)(plot, &drawing, error) &&
              drawing_write(&drawing, path, error);
    drawing_free(&drawing);
    return ok;
}

int run_plot(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    const struct kind *kind = find_kind(operands[0], &error);
    struct plot *plot = kind ? malloc(sizeof *plot) : NULL;
    bool ok = kind && (plot || complain(&error, LAM_MACHINE, "out of memory"));
    char *path = ok ? output_path(options->picture.output, kind->name, ".png") : NULL;
    ok = ok && (path || complain(&error, LAM_MACHINE, "out of memory"));
    ok = ok && fill(plot, kind, operand_count - 1, operands + 1, options, &error) &&
         draw_to(plot, path, options, &error);
    if (ok) {
        FILE *file = strcmp(path, "-") == 0 ? stderr : stdout;
        if (options->report.json)
            print_json(file, plot, path);
        else if (!options->report.quiet)
            print_text(file, plot);
    }
    free(path);
    free(plot);
    return ok ? 0 : report_failure(&error, options);
}
