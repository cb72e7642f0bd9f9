// contact_sheet.c: the command `sheet`: draws small pictures of many models on pages, with the models' names and sizes.
#include "command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/scene.h>

#include "batch.h"
#include "console.h"
#include "drawing.h"
#include "job.h"
#include "kept_picture.h"
#include "output.h"
#include "report.h"
#include "sandbox.h"

enum { CELL = 256, MODELS_MAX = 4000, RED = 0xb00020 };

struct contact {
    const struct options *options;
    struct batch_plan plan;
    const char *path;
    int width, height; // pixels of a cell's picture
    int per_page, columns;
    uint32_t paper, ink, grey; // colours, 0xrrggbb
    double scale; // 0: each model fills its picture; otherwise the largest model units per pixel of all models
};

// Returns the model units that one pixel covers at the middle of the model.
static double units_per_pixel(const struct job *job)
{
    const lam_camera *c = &job->camera;
    double x = c->target.x - c->eye.x, y = c->target.y - c->eye.y, z = c->target.z - c->eye.z;
    double half = c->ortho_half_height > 0 ? c->ortho_half_height : sqrt(x * x + y * y + z * z) * tan(c->fovy_rad / 2);
    return 2 * half / job->image.height;
}

static bool draw(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error)
{
    const struct contact *c = user;
    lam_vec3 low, high;
    (void)model;
    if (!job_draw(job, LAM_RGBA8, progress, error))
        return false;
    kept_picture_store(found, "picture", &job->image, c->width > c->height ? c->width : c->height);
    json_object_set_new(found, "units_per_pixel", json_real(units_per_pixel(job)));
    if (lam_scene_bounds(job->scene, &low, &high))
        json_object_set_new(found, "size", json_pack("[fff]", high.x - low.x, high.y - low.y, high.z - low.z));
    return true;
}

// Returns the path of a page, counted from 0, allocated with malloc: the path of the command, or "sheet-2.png" for one of
// several pages.
static char *page_path(const struct contact *c, int page)
{
    int pages = ((int)c->plan.count + c->per_page - 1) / c->per_page, digits = snprintf(NULL, 0, "%d", pages);
    const char *slash = strrchr(c->path, '/'), *dot = strrchr(slash ? slash : c->path, '.');
    char *path = NULL;
    if (pages <= 1)
        return strdup(c->path);
    return asprintf(&path, "%.*s-%0*d%s", (int)(dot ? dot - c->path : (int)strlen(c->path)), c->path, digits, page + 1,
                    dot ? dot : "") < 0
               ? NULL
               : path;
}

static enum writer_right right_of(void *user, const char *path)
{
    const struct contact *c = user;
    enum writer_right right = WRITER_NONE;
    for (int i = 0; right == WRITER_NONE && i * c->per_page < (int)c->plan.count; i++) {
        char *page = page_path(c, i);
        if (page && strcmp(page, path) == 0)
            right = WRITER_ANY;
        free(page);
    }
    return right;
}

// --- the pages

// Draws text, with its middle left out if it is too wide.
static void draw_short(struct drawing *d, double middle, double y, double size, double width, uint32_t color,
                       const char *text)
{
    char shown[256];
    size_t length = strlen(text), kept = length;
    snprintf(shown, sizeof shown, "%s", text);
    while (text_width(d, size, shown) > width && kept > 8) {
        kept -= 1;
        size_t head = kept / 2, tail = length - (kept - kept / 2);
        while (head > 0 && ((unsigned char)text[head] & 0xc0) == 0x80) // whole characters only
            head--;
        while (tail < length && ((unsigned char)text[tail] & 0xc0) == 0x80)
            tail++;
        snprintf(shown, sizeof shown, "%.*s…%s", (int)head, text, text + tail);
    }
    draw_text(d, (struct point){middle, y}, size, ALIGN_MIDDLE, color, shown);
}

// Draws a model's picture in the middle of its cell, smaller by `factor`.
static bool draw_picture(struct drawing *d, const json_t *record, const struct contact *c, int left, int top,
                         const char *name, lam_error *error)
{
    lam_image whole = {0}, small = {0};
    double units = json_real_value(json_object_get(record, "units_per_pixel"));
    int most = c->width > c->height ? c->width : c->height;
    if (c->scale > 0 && units < c->scale)
        most = (int)lround(most * units / c->scale);
    bool ok = kept_picture_load(record, "picture", &whole) || complain(error, LAM_MACHINE, "out of memory");
    ok = ok && shrink_bytes(&whole, most > 0 ? most : 1, &small, error) &&
         draw_image(d, &small, left + (c->width - small.width) / 2, top + (c->height - small.height) / 2, name, error);
    lam_image_free(&whole);
    lam_image_free(&small);
    return ok;
}

static const char *size_text(const json_t *record, char text[96])
{
    const json_t *size = json_object_get(record, "size");
    char each[3][24];
    for (int i = 0; i < 3; i++) {
        double value = json_number_value(json_array_get(size, (size_t)i));
        snprintf(each[i], sizeof each[i], value >= 1000 && value < 1e7 ? "%.0f" : "%.4g", value);
    }
    snprintf(text, 96, "%s × %s × %s", each[0], each[1], each[2]);
    return size ? text : "";
}

static bool draw_page(const struct contact *c, int page, json_t *const *records, const char *path, lam_error *error)
{
    const struct captions_options *captions = &c->options->captions;
    int first = page * c->per_page, last = first + c->per_page;
    last = last < (int)c->plan.count ? last : (int)c->plan.count;
    double u = c->width / (double)CELL;
    int gap = (int)(16 * u) + 1, foot = captions->no_captions ? 0 : (int)(48 * u);
    int head = captions->title && *captions->title && !captions->no_captions ? (int)(44 * u) : 0;
    int rows = (last - first + c->columns - 1) / c->columns;
    int64_t width = (int64_t)c->columns * (c->width + gap) + gap;
    int64_t height = (int64_t)rows * (c->height + foot + gap) + gap + head;
    if (width > 65535 || height > 65535)
        return complain(error, LAM_LIMIT,
                        "the sheet would have %lldx%lld pixels, more than 65535; choose smaller pictures with -s, or "
                        "fewer models with --per-page",
                        (long long)width, (long long)height);
    struct drawing d;
    if (!drawing_open(&d, (int)width, (int)height, drawing_is_svg(path), !captions->no_captions, captions->font, error))
        return false;
    d.compress = (lam_compress)c->options->picture.compress;
    d.quality = c->options->picture.quality;
    d.durable = c->options->picture.durable;
    draw_box(&d, (struct point){0, 0}, (double)width, (double)height, c->paper);
    if (head)
        draw_short(&d, (double)width / 2, gap + 26 * u, 26 * u, (double)width - 2 * gap, c->ink, captions->title);
    bool ok = true;
    for (int i = first; ok && i < last; i++) {
        const char *slash = strrchr(c->plan.models[i].path, '/'),
                   *name = slash && slash[1] ? slash + 1 : c->plan.models[i].path;
        int left = gap + (i - first) % c->columns * (c->width + gap);
        int top = gap + head + (i - first) / c->columns * (c->height + foot + gap);
        double middle = left + c->width / 2.0;
        bool drawn = json_object_get(records[i], "picture") != NULL;
        char size[96];
        if (drawn)
            ok = draw_picture(&d, records[i], c, left, top, name, error);
        else
            draw_box(&d, (struct point){left, top}, c->width, c->height, 0xf2f2f2);
        if (foot) {
            draw_short(&d, middle, top + c->height + 17 * u, 15 * u, c->width, c->ink, name);
            draw_short(&d, middle, top + c->height + 35 * u, 13 * u, c->width, drawn ? c->grey : RED,
                       drawn ? size_text(records[i], size) : "not drawn");
        }
    }
    ok = ok && drawing_write(&d, path, error);
    if (ok && !c->options->report.quiet)
        say_plain("%s  %dx%d  %d model%s\n", strcmp(path, "-") == 0 ? "standard output" : path, d.width, d.height,
                  last - first, last - first == 1 ? "" : "s");
    drawing_free(&d);
    return ok;
}

static int finish(void *user, json_t *const *records, size_t failed)
{
    struct contact *c = user;
    lam_error error = {0};
    bool ok = true;
    for (size_t i = 0; c->options->contact.to_scale && i < c->plan.count; i++)
        c->scale = fmax(c->scale, json_real_value(json_object_get(records[i], "units_per_pixel")));
    for (int page = 0; ok && page * c->per_page < (int)c->plan.count; page++) {
        char *path = page_path(c, page);
        ok = path ? draw_page(c, page, records, path, &error) : complain(&error, LAM_MACHINE, "out of memory");
        free(path);
    }
    return !ok ? report_failure(&error, c->options) : failed && !c->options->batch.failures_ok ? EXIT_SOME_FAILED : 0;
}

// --- the command

static bool check(int operands, const struct options *o, const char *path, lam_error *error)
{
    if (!operands && !o->batch.lists.count)
        return complain(error, LAM_BAD_ARGUMENT, "sheet: no model given, expected files, folders or @FILE with a list");
    if (!output_is_named(path) || strchr(path, '{'))
        return complain(error, LAM_BAD_ARGUMENT, "option '--output': found '%.200s', expected the file of one sheet",
                        path);
    if (strcmp(path, "-") == 0 && isatty(STDOUT_FILENO))
        return complain(error, LAM_BAD_ARGUMENT, "sheet: standard output is a terminal, expected -o FILE");
    if (!drawing_is_svg(path) && !output_check_bytes(path, "sheet", ".svg, ", error))
        return false;
    if (o->captions.title && !drawing_is_svg(path) && !o->captions.no_captions &&
        !drawing_check_text("title", o->captions.title, o->captions.font != NULL, error))
        return false;
    return job_check_options(o, error);
}

static bool fill(struct contact *c, int count, char **operands, lam_error *error)
{
    const struct options *o = c->options;
    bool ok = true;
    for (int i = 0; ok && i < count; i++)
        ok = batch_add_operand(&c->plan, operands[i], error);
    for (int i = 0; ok && i < o->batch.lists.count; i++)
        ok = batch_add_list(&c->plan, o->batch.lists.items[i], error);
    if (ok && c->plan.count > MODELS_MAX)
        return complain(error, LAM_LIMIT,
                        "sheet: %zu models, at most %d; lambent batch --report page.html shows more on one page",
                        c->plan.count, MODELS_MAX);
    if (!ok)
        return false;
    int count_on_page = (int)c->plan.count;
    c->per_page = o->contact.per_page ? o->contact.per_page : 60;
    if (count_on_page > c->per_page && strcmp(c->path, "-") == 0)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "option '--output': %zu models fill several pages, which standard output cannot take; expected a "
            "file, or --per-page %zu",
            c->plan.count, c->plan.count);
    count_on_page = count_on_page < c->per_page ? count_on_page : c->per_page;
    c->columns = o->contact.columns ? o->contact.columns : (int)ceil(sqrt(count_on_page * 1.2));
    c->columns = c->columns < count_on_page ? c->columns : count_on_page;
    for (int page = 0; ok && strcmp(c->path, "-") != 0 && page * c->per_page < (int)c->plan.count; page++) {
        char *path = page_path(c, page);
        ok = path ? output_check(path, c->plan.models[0].path, OUTPUT_NAMED, error)
                  : complain(error, LAM_MACHINE, "out of memory");
        free(path);
    }
    return ok;
}

// Chooses the colours of the page: the background of the pictures, if it is an opaque colour.
static void choose_colors(struct contact *c, const char *background)
{
    lam_rgba color;
    lam_error ignored;
    c->paper = 0xffffff;
    if (lam_color_parse(background, LAM_COLOR_SRGB, &color, &ignored) && color.a == 1) {
        const float parts[3] = {color.r, color.g, color.b};
        c->paper = 0;
        for (int i = 0; i < 3; i++)
            c->paper = c->paper << 8 | (uint32_t)lround(255 * (parts[i] <= 0.0031308f
                                                                   ? 12.92 * (double)parts[i]
                                                                   : 1.055 * pow((double)parts[i], 1 / 2.4) - 0.055));
    }
    const bool dark = ((c->paper >> 16) * 2 + (c->paper >> 8 & 255) * 5 + (c->paper & 255)) / 8 < 110;
    c->ink = dark ? 0xe6e6e6 : 0x222222;
    c->grey = dark ? 0xa0a0a0 : 0x777777;
}

int run_sheet(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    struct options drawn = *options; // the batch draws the cells; it prints no reports and writes no pictures
    struct contact c = {.options = options, .path = options->picture.output ? options->picture.output : "sheet.png"};
    c.width = options->picture.has_size ? options->picture.width : CELL;
    c.height = options->picture.has_size ? options->picture.height : CELL;
    drawn.report.json = drawn.report.verbose = false;
    drawn.picture.output = NULL;
    drawn.picture.width = c.width;
    drawn.picture.height = c.height;
    drawn.picture.background = options->picture.background ? options->picture.background : SHEET_BACKGROUND;
    choose_colors(&c, drawn.picture.background);
    struct batch_receiver use = {.draw = draw, .right = right_of, .files = {c.path}, .finish = finish, .user = &c};
    bool ok = check(operand_count, options, c.path, &error) && batch_plan_start(&c.plan, &drawn, &error) &&
              fill(&c, operand_count, operands, &error);
    int code = ok ? batch_receive(&c.plan, &use) : report_failure(&error, options);
    batch_plan_free(&c.plan);
    return code;
}
