// materials.c: the command `materials`: lists the classic named materials and draws them.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/caption.h>
#include <lambent/fields.h>
#include <lambent/light.h>
#include <lambent/material.h>

#include "console.h"
#include "interrupt.h"
#include "json.h"
#include "output.h"
#include "report.h"
#include "terminal.h"
#include "vectors.h"

// The distance from a teapot's centre down to the baseline of its caption, in model units.
#define CAPTION_BELOW 0.83

enum { COLUMNS = 6, ROWS = (LAM_MATERIAL_COUNT + COLUMNS - 1) / COLUMNS };

// Returns the decimal number with the fewest digits that parses to the same float, as in the printed table.
static double decimal(float x)
{
    char text[32];
    shortest_float(x, text);
    return strtod(text, NULL);
}

// Returns whether the list has a column for this field. The list has the column if at least one classic material has a
// value other than the default. Colours are printed without alpha.
static bool is_column(const lam_field *field, lam_color_mode color)
{
    bool differs = false;
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++) {
        lam_material m = lam_material_named((lam_material_id)i, color);
        double numbers[4];
        for (int k = lam_field_get_written(field, &m, numbers) - 1; k >= 0; k--)
            differs |= (float)numbers[k] != (float)field->standard[k];
    }
    return differs;
}

static void print_row(const lam_material *m, lam_color_mode mode)
{
    printf("%-15s", m ? m->name : "");
    for (int i = 0; lam_material_field(i); i++) {
        const lam_field *field = lam_material_field(i);
        double numbers[4] = {0};
        bool color = field->type == LAM_FIELD_RGB || field->type == LAM_FIELD_RGBA;
        if (!is_column(field, mode))
            continue;
        if (m)
            lam_field_get_written(field, m, numbers);
        if (!m)
            printf(color ? "  %-26s" : "  %s", field->key);
        else if (color)
            printf("  %8.6f %8.6f %8.6f", numbers[0], numbers[1], numbers[2]);
        else
            printf("  %g", numbers[0]);
    }
    printf("\n");
}

static void print_table(lam_color_mode color)
{
    print_row(NULL, color);
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++) {
        lam_material m = lam_material_named((lam_material_id)i, color);
        print_row(&m, color);
    }
    printf("\nSource: teapots.c, a demonstration program of OpenGL (Silicon Graphics, 1993 and 1997); the "
           "shininess there is\n"
           "a fraction of 128. %s\n"
           "--material NAME applies a material to a model.\n",
           color == LAM_COLOR_RAW ? "The colours are the published sRGB colours."
                                  : "The colours are linear light, decoded from the published sRGB colours\n"
                                    "(--color-mode raw lists the published colours).");
}

// Prints the list as JSON. The keys are the same as in the materials of scene files.
static void print_json(lam_color_mode color, FILE *out)
{
    struct json json = {.file = out};
    json_open(&json, NULL, '{');
    json_open(&json, "materials", '[');
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++) {
        lam_material m = lam_material_named((lam_material_id)i, color);
        json_open(&json, NULL, '{');
        json_text(&json, "name", m.name);
        for (int k = 0; lam_material_field(k); k++) {
            const lam_field *field = lam_material_field(k);
            double numbers[4];
            bool single = lam_field_get_written(field, &m, numbers) == 1;
            if (!is_column(field, color))
                continue;
            if (!single)
                json_open(&json, field->key, '[');
            for (int n = 0; n < (single ? 1 : 3); n++)
                json_number(&json, single ? field->key : NULL, decimal((float)numbers[n]));
            if (!single)
                json_close(&json, ']');
        }
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', out);
}

static void print_list(const struct options *options)
{
    if (options->report.json)
        print_json((lam_color_mode)options->picture.color_mode, report_stream(options));
    else
        print_table((lam_color_mode)options->picture.color_mode);
}

// Builds a scene with one teapot for each material, in rows of COLUMNS from the top left. All teapots share a mesh. As
// in the original program, a directional light comes from (0, 3, 3), the global ambient light is 0.2, and the viewer is
// at infinity.
static bool build_scene(lam_scene *scene, lam_color_mode color, lam_error *error)
{
    int mesh = lam_scene_add_shape(scene, "teapot", NULL, error);
    if (mesh < 0)
        return false;
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++) {
        lam_material material = lam_material_named((lam_material_id)i, color);
        lam_object object = lam_object_default();
        object.name = material.name;
        object.mesh = mesh;
        object.material = lam_scene_add_material(scene, &material, error);
        object.transform.m[0][3] = 2.2 * (i % COLUMNS - (COLUMNS - 1) * 0.5);
        // NOLINTNEXTLINE(bugprone-integer-division): the row is a whole number
        object.transform.m[1][3] = 1.7 * ((ROWS - 1) * 0.5 - i / COLUMNS);
        if (object.material < 0 || lam_scene_add_object(scene, &object, error) < 0)
            return false;
    }
    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    light.direction = (lam_vec3){0, -1, -1};
    lam_scene_set_ambient(scene, (lam_rgb){0.2f, 0.2f, 0.2f});
    return lam_scene_add_light(scene, &light, error) >= 0;
}

// --- captions

// Draws each material's name below its teapot. The text is grey, so it is legible on any background.
static bool draw_captions(const lam_scene *scene, const struct options *o, const lam_camera *camera, lam_image *image,
                          lam_error *error)
{
    lam_font *font = lam_font_open(o->captions.font, error);
    if (!font) {
        if (error->code == LAM_UNSUPPORTED) {
            lam_error reason = *error;
            complain(error, LAM_UNSUPPORTED, "%.400s; --no-captions draws without them", reason.text);
        }
        return false;
    }
    bool bytes = image->format == LAM_RGBA8, ok = true;
    float grey = bytes ? 0.5f : 0.21f;
    double unit = image->height / (2 * camera->ortho_half_height); // pixels per unit
    lam_vec3 centre;
    double radius;
    for (int i = 0; ok && i < lam_scene_object_count(scene) && lam_scene_sphere(scene, i, &centre, &radius); i++) {
        const lam_object *object = lam_scene_object(scene, i);
        // The camera looks from the front and slightly from above: x is horizontal in the picture, and y and z
        // determine the height.
        lam_vec3 from_target = {centre.x + object->transform.m[0][3] - camera->target.x,
                                centre.y + object->transform.m[1][3] - camera->target.y, centre.z - camera->target.z};
        double size = 0.21 * unit, max_width = 2.1 * unit, width = lam_text_width(font, size, object->name);
        if (width > max_width) {
            size *= max_width / width;
            width = max_width;
        }
        double x = image->width / 2.0 + from_target.x * unit - width / 2;
        double y = image->height / 2.0 - (dot(from_target, camera->up) - CAPTION_BELOW) * unit;
        ok = size < 1 || lam_text_draw(image, font, x, y, size, (lam_rgba){grey, grey, grey, 1}, object->name, error);
    }
    lam_font_free(font);
    return ok;
}

static bool draw_sheet(const lam_scene *scene, const struct options *o, lam_image *image, lam_error *error)
{
    lam_rgba background;
    if (!lam_color_parse(o->picture.background ? o->picture.background : SHEET_BACKGROUND,
                         (lam_color_mode)o->picture.color_mode, &background, error))
        return false;
    lam_draw_params params = {.samples = o->draw.samples,
                              .background = background,
                              .color = (lam_color_mode)o->picture.color_mode,
                              .viewer = LAM_VIEWER_INFINITE};
    lam_view view = {.from_angles = true, .orthographic = true, .elevation_rad = 0.2, .fill = 0.97};
    lam_camera camera = lam_camera_fit(scene, image->width, image->height, &view);
    lam_device *device = lam_device_cpu(NULL, error);
    lam_control control = {.cancel = interrupt_flag()};
    bool ok = device && lam_draw(device, scene, &camera, &params, image, &control, error);
    lam_device_free(device);
    return ok && (o->captions.no_captions || draw_captions(scene, o, &camera, image, error));
}

static bool write_sheet(const struct options *o, const lam_image *image, const char *path, lam_error *error)
{
    lam_rgba under;
    if (!lam_color_parse(o->picture.background ? o->picture.background : SHEET_BACKGROUND,
                         (lam_color_mode)o->picture.color_mode, &under, error))
        return false;
    lam_save_params params = {.background = {under.r, under.g, under.b},
                              .raw = o->picture.color_mode == LAM_COLOR_RAW,
                              .compress = (lam_compress)o->picture.compress,
                              .quality = o->picture.quality,
                              .durable = o->picture.durable};
    uint64_t size;
    return output_save(image, path, &params, &size, error);
}

static bool make_sheet(const struct options *o, const char *path, lam_error *error)
{
    lam_pixel_format format;
    if (!output_format(path, &format, error) ||
        !(output_is_stream(path) || output_check(path, "", output_is_named(o->picture.output), error)))
        return false;
    lam_scene *scene = lam_scene_make(error);
    lam_image image = {0};
    // The default size is square, but the sheet is wider than it is high.
    int height = o->picture.width == o->picture.height ? o->picture.height * 58 / 100 : o->picture.height;
    bool ok = scene && build_scene(scene, (lam_color_mode)o->picture.color_mode, error) &&
              lam_image_make(&image, o->picture.width, height > 0 ? height : 1, format, error) &&
              draw_sheet(scene, o, &image, error) && write_sheet(o, &image, path, error);
    lam_image_free(&image);
    lam_scene_free(scene);
    return ok;
}

int run_materials(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands;
    lam_error error = {0};
    if (!options->picture.output && (options->picture.term == TERM_AUTO || options->picture.term == TERM_OFF)) {
        print_list(options);
        return 0;
    }
    interrupt_start();
    const char *output =
        options->picture.output ? options->picture.output : "-"; // with only --term, the sheet is shown and not written
    bool ok = terminal_start(options, true, &error);
    if (ok && !options->picture.output && !isatty(STDOUT_FILENO) && !terminal_shows()) {
        print_list(options);
        return 0;
    }
    if (ok && strcmp(output, "-") == 0 && isatty(STDOUT_FILENO) && !terminal_shows())
        ok = terminal_refuse("materials", &error);
    char *path = ok ? output_path(output, "materials", ".png") : NULL;
    ok = ok && (path ? make_sheet(options, path, &error) : complain(&error, LAM_MACHINE, "out of memory"));
    free(path);
    if (!ok)
        return report_failure(&error, options);
    if (!output_is_stream(output) || options->report.json) // with --json, print_list may write to standard error
        print_list(options);
    return 0;
}
