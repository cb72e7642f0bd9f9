// compare.c: the command `compare`: draws several pictures of a model on one labelled sheet. It is longer than 600 lines
// because all kinds of sheets share one page: pictures, captions, the enlarged highlight, and figures.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "console.h"
#include "limit_options.h"
#include "drawing.h"
#include "sheet.h"
#include "interrupt.h"
#include "job.h"
#include "json.h"
#include "output.h"
#include "report.h"
#include "shader.h"
#include "sandbox_start.h"
#include "terminal.h"

enum {
    WARNINGS_MAX = 16,
    CELL_WIDTH = 480,
    CELL_HEIGHT = 400,
    ENLARGED = 3,
    INK = 0x222222,
    GREY = 0x777777,
    FRAME = 0xd55e00,
    BEAM = 0xc77700
};

// The layout of the page in pixels. `unit` is 1 for cells 480 pixels wide. The text size is proportional to `unit`.
struct page {
    double unit;
    int cell_width, cell_height; // the size of a picture
    int gap, head, foot;         // gap between cells and around them; heights of the title and of a caption
    int inset;                   // the height of the enlarged section with its gap; 0 without such a section
    int rows;
};

struct compare {
    const struct options *options;
    const char *model;
    lam_device *device;
    struct progress progress;
    struct sheet sheet;
    struct page page;
    struct drawing drawing;
    int done;                              // the number of pictures drawn so far
    lam_image other;                       // the picture that others are compared with
    lam_difference differences[CELLS_MAX]; // differences from `other`
    bool exposure_fitted;                  // the exposure was fitted to the first picture, and is used for all pictures
    double exposure;
    const char *defaults[2 * SHEET_DEFAULTS_MAX]; // arguments that the sheet adds to every picture
    int default_count;
    bool default_material;        // whether one of the defaults is a material
    char *warnings[WARNINGS_MAX]; // the warnings that apply to all pictures
};

// Returns the user's caption of a picture, or the sheet's caption.
static const char *caption_of(const struct compare *c, const struct cell *cell)
{
    int index = (int)(cell - c->sheet.cells);
    return index < c->options->captions.texts.count ? c->options->captions.texts.items[index] : cell->caption;
}

// --- one picture

// Stores the rotations of all pictures in the options, so that the pictures share one camera and one scale.
static bool share_rotations(const struct sheet *sheet, struct options *options)
{
    const char **items = malloc((size_t)CELLS_MAX * CELL_WORDS * sizeof *items);
    if (!items)
        return false;
    free(options->shading.sheet_rotations.items);
    options->shading.sheet_rotations = (struct texts){.items = items};
    for (int i = 0; i < sheet->count; i++)
        for (int k = 0; k + 1 < CELL_WORDS && sheet->cells[i].words[k]; k++)
            if (strcmp(sheet->cells[i].words[k], "--rotate") == 0)
                items[options->shading.sheet_rotations.count++] = sheet->cells[i].words[k + 1];
    return true;
}

// Collects the options that apply to only one cell and returns their number.
static int words_of(const struct compare *c, const struct cell *cell, const char *words[CELL_WORDS + 2])
{
    int count = 0;
    if (cell->look && c->default_material) {
        words[count++] = "--material";
        words[count++] = cell->look;
    }
    for (int i = 0; i < CELL_WORDS && cell->words[i]; i++)
        words[count++] = cell->words[i];
    return count;
}

// Creates the options of a cell's picture, with two additional arguments, which may be NULL. After a failure, there is
// nothing to free.
static bool cell_options(const struct compare *c, const struct cell *cell, const char *more, const char *value,
                         struct options *options, lam_error *error)
{
    if (!options_copy(options, c->options))
        return complain(error, LAM_MACHINE, "out of memory");
    char *words[2 * SHEET_DEFAULTS_MAX + CELL_WORDS + 4]; // options_parse does not modify the words
    int count = 0;
    for (int i = 0; i < c->default_count; i++)
        words[count++] = (char *)(uintptr_t)c->defaults[i];
    count += words_of(c, cell, (const char **)words + count);
    if (more) {
        words[count++] = (char *)(uintptr_t)more;
        words[count++] = (char *)(uintptr_t)value;
    }
    if (!options->picture.background)
        options->picture.background = SHEET_BACKGROUND;
    // Sheets compare methods of local lighting, so global effects are drawn only on request.
    if (!option_given(options, "ao"))
        options->draw.occlusion = LAM_OCCLUSION_OFF;
    options->shader.lecture_device = c->sheet.mistakes;
    options->shader.mistake = cell->mistake;
    bool ok = share_rotations(&c->sheet, options) || complain(error, LAM_MACHINE, "out of memory");
    ok = ok && options_parse(count, words, find_groups("render"), options, error) >= 0;
    if (!ok)
        options_free(options);
    return ok;
}

// Returns the device that draws a cell. On a sheet of mistakes, the shaders of this device contain the mistake.
static lam_device *cell_device(const struct compare *c, const struct options *options, lam_error *error)
{
    if (!c->sheet.mistakes)
        return c->device;
    lam_error reason;
    lam_device *device = device_option_make(options, &reason);
    if (!device)
        complain(error, reason.code, "mistakes are drawn by OpenGL: %s", reason.text);
    return device;
}

// Keeps the warnings that apply to all pictures so far. In a row of reflectivities, the environment may be invisible in
// only some of the pictures.
static void keep_warnings(struct compare *c, const lam_scene *scene)
{
    for (int i = 0; c->done == 0 && i < WARNINGS_MAX && lam_scene_warning(scene, i); i++)
        c->warnings[i] = strdup(lam_scene_warning(scene, i));
    for (int k = 0; k < WARNINGS_MAX; k++) {
        bool found = false;
        for (int i = 0; c->warnings[k] && lam_scene_warning(scene, i); i++)
            found |= strcmp(c->warnings[k], lam_scene_warning(scene, i)) == 0;
        if (!found) {
            free(c->warnings[k]);
            c->warnings[k] = NULL;
        }
    }
}

// Draws a cell's picture, magnified by the factor `enlarge`. `more` and `value` are two additional arguments, or NULL.
static bool draw_cell(struct compare *c, const struct cell *cell, int enlarge, const char *more, const char *value,
                      lam_image *image, lam_error *error)
{
    struct options options;
    if (!cell_options(c, cell, more, value, &options, error))
        return false;
    options.picture.width = c->page.cell_width * enlarge;
    options.picture.height = c->page.cell_height * enlarge;
    options.picture.has_size = true;
    if (c->exposure_fitted) {
        options.picture.exposure_kind = EXPOSURE_LITERAL;
        options.picture.exposure = c->exposure;
        options.draw.light_cutoff = options.draw.light_cutoff != 0 ? options.draw.light_cutoff : -1;
    }
    struct job job = {.options = &options, .model = c->model, .device = cell_device(c, &options, error)};
    job.times.start = clock_ms();
    bool ok = job.device && job_draw(&job, LAM_RGBA8, &c->progress, error);
    if (ok)
        keep_warnings(c, job.scene);
    if (ok && job.exposure_fitted && !c->exposure_fitted && !options.report.quiet)
        say_plain("exposure %.4g stops (auto)\n", job.draw.exposure);
    if (ok && job.exposure_fitted) {
        c->exposure_fitted = true;
        c->exposure = job.draw.exposure;
    }
    c->done++;
    lam_scene_free(job.scene);
    if (job.device != c->device)
        lam_device_free(job.device);
    if (ok)
        *image = job.image;
    else
        lam_image_free(&job.image);
    options_free(&options);
    return ok;
}

// --- mistakes

static bool check_caption_count(const struct options *o, const struct sheet *sheet, lam_error *error)
{
    return o->captions.texts.count <= sheet->count ||
           complain(error, LAM_BAD_ARGUMENT, "option '--caption': found %d, but the sheet has %d pictures",
                    o->captions.texts.count, sheet->count);
}

// Returns whether a mistake changes the shader of this scene. Fails with LAM_UNSUPPORTED if the mistake affects nothing
// in the scene.
static bool mistake_applies(struct compare *c, const struct cell *cell, lam_error *error)
{
    struct options options;
    if (!cell_options(c, cell, NULL, NULL, &options, error))
        return false;
    options.shader.style = LAM_SHADER_STYLE_LECTURE;
    options.shader.products = true; // the OpenGL device uses the same form
    options.picture.width = CELL_WIDTH;
    options.picture.height = CELL_HEIGHT;
    struct job job = {.options = &options, .model = c->model};
    job.times.start = clock_ms();
    lam_shader *shader = job_shader(&job, &c->progress, error);
    bool ok = shader && !shader->application;
    if (shader && !ok)
        complain(error, LAM_BAD_ARGUMENT,
                 "options '--stage application' and '--across mistake': a sheet of mistakes needs shaders that compute "
                 "the lighting; expected '--stage vertex' or '--stage fragment'");
    lam_shader_free(shader);
    lam_scene_free(job.scene);
    options_free(&options);
    return ok;
}

// On a sheet of all mistakes, removes the mistakes without a visible effect, and prints the names of these mistakes.
static bool choose_mistakes(struct compare *c, lam_error *error)
{
    struct sheet *sheet = &c->sheet;
    if (option_given(c->options, "device") && c->options->work.device == DEVICE_CPU)
        return complain(error, LAM_BAD_ARGUMENT,
                        "options '--device cpu' and '--across mistake': mistakes change shaders, and only OpenGL uses "
                        "shaders; see 'lambent compare -h'");
    char left_out[1024] = "";
    int kept = 0;
    for (int i = 0; i < sheet->count; i++) {
        const struct cell *cell = &sheet->cells[i];
        if (cell->mistake && !shader_mistake_is_known(cell->mistake, error))
            return false;
        lam_error reason = {0};
        if (mistake_applies(c, cell, &reason)) {
            sheet->cells[kept++] = *cell;
        } else if (cell->mistake && sheet->all && reason.code == LAM_UNSUPPORTED) {
            size_t length = strlen(left_out);
            snprintf(left_out + length, sizeof left_out - length, "%s%s", length ? ", " : "", cell->mistake);
        } else {
            *error = reason;
            return false;
        }
    }
    sheet->count = kept;
    int rows = (kept + 5) / 6;
    sheet->columns = (kept + rows - 1) / rows;
    if (*left_out && !c->options->report.quiet)
        say_plain("omitted, because the scene does not show them: %s\n", left_out);
    return check_caption_count(c->options, sheet, error);
}

// --- the enlarged highlight

static bool draw_frame(struct compare *c, double left, double top, double width, double height, lam_error *error)
{
    struct point round[5] = {
        {left, top}, {left + width, top}, {left + width, top + height}, {left, top + height}, {left, top}};
    return draw_line(&c->drawing, round, 5, 2 * c->page.unit, FRAME, 0, error);
}

// Draws an enlarged section of a cell's picture below the picture, and draws a frame around the section in both
// pictures.
static bool draw_inset(struct compare *c, const struct cell *cell, struct highlight box, int left, int top,
                       lam_error *error)
{
    lam_image large, part;
    if (!draw_cell(c, cell, ENLARGED, NULL, NULL, &large, error))
        return false;
    bool ok = lam_image_make(&part, box.width * ENLARGED, box.height * ENLARGED, LAM_RGBA8, error);
    for (int y = 0; ok && y < part.height; y++)
        memcpy((uint8_t *)part.pixels + 4 * (size_t)y * (size_t)part.width,
               (uint8_t *)large.pixels +
                   4 * ((size_t)(box.top * ENLARGED + y) * (size_t)large.width + (size_t)(box.left * ENLARGED)),
               4 * (size_t)part.width);
    lam_image_free(&large);
    if (!ok)
        return false;
    int below = top + c->page.cell_height + c->page.gap / 2;
    ok = draw_image(&c->drawing, &part, left, below, caption_of(c, cell), error) &&
         draw_frame(c, left, below, part.width, part.height, error) &&
         draw_frame(c, left + box.left, top + box.top, box.width, box.height, error);
    lam_image_free(&part);
    return ok;
}

// --- the page

// Draws text. If the text is too wide, reduces the size step by step until the text fits, because the widths of hinted
// letters are not proportional to the size.
static void draw_fitting(struct drawing *d, struct point baseline, double size, double width, uint32_t color,
                         const char *text)
{
    double needed;
    while ((needed = text_width(d, size, text)) > width && size > 1)
        size *= needed > 1.02 * width ? width / needed : 0.98;
    draw_text(d, baseline, size, ALIGN_MIDDLE, color, text);
}

static void join(const char *const *words, int count, char line[512])
{
    line[0] = 0;
    for (int i = 0; i < count; i++)
        snprintf(line + strlen(line), 512 - strlen(line), "%s%s", i ? " " : "", words[i]);
}

// Draws text on one line, or on two lines if the text would be too small to read on one line. Breaks the text after the
// comma or the space that is nearest to the middle of the text.
static void draw_words(struct compare *c, struct point baseline, double width, const char *line)
{
    double u = c->page.unit, size = 15 * u, needed = text_width(&c->drawing, size, line);
    if (needed <= width * 1.25) {
        draw_fitting(&c->drawing, baseline, size, width, GREY, line);
        return;
    }
    size_t length = strlen(line), cut = 0;
    for (size_t i = 1; i < length; i++) {
        bool breakable = line[i - 1] == ',' || line[i - 1] == ' ';
        size_t half = length / 2, off = i > half ? i - half : half - i, best = cut > half ? cut - half : half - cut;
        if (breakable && off < best)
            cut = i;
    }
    char first[512];
    snprintf(first, sizeof first, "%.*s", (int)cut, line);
    draw_fitting(&c->drawing, (struct point){baseline.x, baseline.y - 1 * u}, 13 * u, width, GREY, first);
    draw_fitting(&c->drawing, (struct point){baseline.x, baseline.y + 17 * u}, 13 * u, width, GREY, line + cut);
}

static void draw_caption(struct compare *c, const struct cell *cell, int left, int top)
{
    double u = c->page.unit, middle = left + c->page.cell_width / 2.0, width = c->page.cell_width;
    draw_fitting(&c->drawing, (struct point){middle, top + 32 * u}, 23 * u, width, INK, caption_of(c, cell));
    // The second line shows the picture's options as typed. If the picture shows a mistake, the second line shows the
    // difference from the first picture instead.
    char line[512];
    const char *words[CELL_WORDS + 2];
    const lam_difference *d = &c->differences[cell - c->sheet.cells];
    if (cell->mistake && d->maximum == 0)
        snprintf(line, sizeof line, "not visible in this scene");
    else if (cell->mistake)
        snprintf(line, sizeof line, "mean difference %.4f, at most %.2f", d->mean, d->maximum);
    else
        join(words, c->options->captions.style == CAPTIONS_PLAIN ? 0 : words_of(c, cell, words), line);
    draw_words(c, (struct point){middle, top + 55 * u}, width, line);
}

static struct point cell_corner(const struct compare *c, int i)
{
    const struct page *p = &c->page;
    return (struct point){p->gap + i % c->sheet.columns * (p->cell_width + p->gap),
                          p->gap + p->head + i / c->sheet.columns * (p->cell_height + p->inset + p->foot + p->gap)};
}

// Draws Lambert's law after the last picture: an oblique beam, whose cosine is 0.6.
static bool draw_oblique_beam(struct compare *c, lam_error *error)
{
    const struct point corner = cell_corner(c, c->sheet.count);
    const double u = c->page.unit, middle = corner.x + c->page.cell_width / 2.0;
    const struct point foot = {middle, corner.y + 0.8 * c->page.cell_height};
    const struct {
        const char *name;
        struct point tip;
    } arrows[] = {{"n", {foot.x, foot.y - 170 * u}}, {"l", {foot.x - 136 * u, foot.y - 102 * u}}};
    bool ok = draw_beam(&c->drawing, foot, 1.2 * u, 0.6, BEAM, error);
    for (int i = 0; ok && i < 2; i++) {
        ok = draw_line(&c->drawing, (struct point[]){foot, arrows[i].tip}, 2, 2 * u, INK, 0, error);
        draw_text(&c->drawing, (struct point){arrows[i].tip.x, arrows[i].tip.y - 8 * u}, 20 * u, ALIGN_MIDDLE, INK,
                  arrows[i].name);
    }
    if (!c->options->captions.no_captions)
        draw_fitting(&c->drawing, (struct point){middle, corner.y + c->page.cell_height + 32 * u}, 23 * u,
                     c->page.cell_width, INK, "An oblique beam covers more area");
    return ok;
}

// Draws the absolute difference between two pictures after the last one, with its mean over the channels.
static bool draw_difference(struct compare *c, const lam_image *last, lam_error *error)
{
    enum { GAIN = 2 };
    const struct point corner = cell_corner(c, c->sheet.count);
    const double u = c->page.unit, middle = corner.x + c->page.cell_width / 2.0, top = corner.y + c->page.cell_height;
    lam_image image = {0};
    lam_difference *d = &c->differences[c->sheet.count - 1];
    char title[64], mean[96];
    bool ok = lam_image_compare(&c->other, last, d, error) &&
              lam_image_difference(&c->other, last, GAIN, &image, error) &&
              draw_image(&c->drawing, &image, (int)corner.x, (int)corner.y, "Difference", error);
    lam_image_free(&image);
    if (!ok || c->options->captions.no_captions)
        return ok;
    snprintf(title, sizeof title, "Difference of picture %d", c->sheet.apart);
    snprintf(mean, sizeof mean, "from the last picture, %d times as bright; mean %.1f of 255", GAIN, 255 * d->mean);
    draw_fitting(&c->drawing, (struct point){middle, top + 32 * u}, 23 * u, c->page.cell_width, INK, title);
    draw_words(c, (struct point){middle, top + 55 * u}, c->page.cell_width, mean);
    return true;
}

static bool lay_out(struct compare *c, const char *path, lam_error *error)
{
    const struct options *o = c->options;
    struct page *p = &c->page;
    p->cell_width = o->picture.has_size ? o->picture.width : CELL_WIDTH;
    p->cell_height = o->picture.has_size ? o->picture.height : CELL_HEIGHT;
    p->unit = p->cell_width / (double)CELL_WIDTH;
    p->gap = (int)(24 * p->unit) + 1;
    p->head = o->captions.no_captions ? 0 : (int)((c->default_count ? 100 : 60) * p->unit);
    p->foot = o->captions.no_captions ? 0 : (int)(82 * p->unit);
    p->rows = (c->sheet.count + c->sheet.beam + !!c->sheet.apart + c->sheet.columns - 1) / c->sheet.columns;
    p->inset = c->sheet.inset ? p->cell_height / (2 * ENLARGED) * ENLARGED + p->gap / 2 : 0;
    int64_t width = (int64_t)c->sheet.columns * (p->cell_width + p->gap) + p->gap;
    int64_t height = (int64_t)p->rows * (p->cell_height + p->inset + p->foot + p->gap) + p->head + p->gap;
    int64_t enlarged =
        (int64_t)(p->inset ? ENLARGED : 1) * (p->cell_width > p->cell_height ? p->cell_width : p->cell_height);
    if (width > 65535 || height > 65535 || enlarged > 65535)
        return complain(error, LAM_LIMIT,
                        "the sheet would have %lldx%lld pixels, more than 65535; choose smaller pictures with -s",
                        (long long)width, (long long)height);
    if (!drawing_open(&c->drawing, (int)width, (int)height, drawing_is_svg(path), !o->captions.no_captions,
                      o->captions.font, error))
        return false;
    c->drawing.compress = (lam_compress)o->picture.compress;
    c->drawing.quality = o->picture.quality;
    c->drawing.durable = o->picture.durable;
    return true;
}

static const char *title_of(const struct compare *c, char title[256])
{
    const char *slash = strrchr(c->model, '/');
    snprintf(title, 256, "%.120s — %.100s", c->sheet.title, slash && slash[1] ? slash + 1 : c->model);
    return title;
}

// Builds the description of an SVG: its title and the meaning of each picture.
static bool describe(struct compare *c, const char *title, lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return complain(error, LAM_MACHINE, "out of memory");
    fprintf(file, "%d pictures:", c->sheet.count);
    for (int i = 0; i < c->sheet.count; i++)
        fprintf(file, "%s %s", i ? ";" : "", caption_of(c, &c->sheet.cells[i]));
    bool failed = ferror(file);
    failed |= fclose(file) != 0;
    bool ok =
        failed ? complain(error, LAM_MACHINE, "out of memory") : drawing_describe(&c->drawing, title, text, error);
    free(text);
    return ok;
}

static bool draw_sheet(struct compare *c, lam_error *error)
{
    const struct page *p = &c->page;
    struct highlight box = {0};
    if (c->sheet.inset) { // the highlight is located in the last picture, which is shaded per fragment
        const struct cell *cell = &c->sheet.cells[c->sheet.count - 1];
        lam_image whole, matt;
        if (!draw_cell(c, cell, 1, NULL, NULL, &whole, error))
            return false;
        bool ok = draw_cell(c, cell, 1, "--reflection", "lambert", &matt, error);
        if (ok) {
            box = highlight_find(&whole, &matt, ENLARGED);
            lam_image_free(&matt);
        }
        lam_image_free(&whole);
        if (!ok)
            return false;
    }
    char own_title[256];
    const char *title = c->options->captions.title ? c->options->captions.title : title_of(c, own_title);
    if (!describe(c, title, error))
        return false;
    double middle = c->drawing.width / 2.0, width = c->drawing.width - 2.0 * p->gap;
    draw_fitting(&c->drawing, (struct point){middle, 45 * p->unit}, 30 * p->unit, width, INK, title);
    char line[512];
    join(c->defaults, c->options->captions.style == CAPTIONS_PLAIN ? 0 : c->default_count, line);
    draw_words(c, (struct point){middle, 75 * p->unit}, width, line);
    for (int i = 0; i < c->sheet.count; i++) {
        const struct cell *cell = &c->sheet.cells[i];
        const struct point corner = cell_corner(c, i);
        int left = (int)corner.x, top = (int)corner.y;
        lam_image image;
        if (!draw_cell(c, cell, 1, NULL, NULL, &image, error))
            return false;
        bool ok = draw_image(&c->drawing, &image, left, top, caption_of(c, cell), error);
        if (ok && (c->sheet.mistakes ? i == 0 : i + 1 == c->sheet.apart)) {
            c->other = image;
        } else {
            if (ok && c->sheet.mistakes)
                ok = lam_image_compare(&image, &c->other, &c->differences[i], error);
            if (ok && c->sheet.apart && i + 1 == c->sheet.count)
                ok = draw_difference(c, &image, error);
            lam_image_free(&image);
        }
        if (!ok)
            return false;
        if (c->sheet.inset && !draw_inset(c, cell, box, left, top, error))
            return false;
        draw_caption(c, cell, left, top + p->cell_height + p->inset);
    }
    return !c->sheet.beam || draw_oblique_beam(c, error);
}

static bool has_argument(const char *const *words, int count, const char *argument)
{
    for (int i = 0; i < count; i++)
        if (strcmp(words[i], argument) == 0)
            return true;
    return false;
}

// Prints the caption and the arguments of each picture, without the options of the sheet itself.
static void print_json(const struct compare *c, const char *path)
{
    struct json json = {.file = strcmp(path, "-") == 0 ? stderr : stdout};
    json_open(&json, NULL, '{');
    json_put(&json, TEXT("lambent", lam_version()), TEXT("model", c->model), TEXT("sheet", path));
    json_open(&json, "pictures", '[');
    for (int i = 0; i < c->sheet.count; i++) {
        const struct cell *cell = &c->sheet.cells[i];
        const char *words[CELL_WORDS + 2];
        int count = words_of(c, cell, words);
        json_open(&json, NULL, '{');
        json_text(&json, "caption", caption_of(c, cell));
        json_open(&json, "words", '[');
        for (int k = 0; k < c->default_count; k++)
            json_text(&json, NULL, c->defaults[k]);
        for (int k = 0; k < count; k++)
            json_text(&json, NULL, words[k]);
        const char *own[] = {"--background", c->options->picture.background ? NULL : SHEET_BACKGROUND, "--ao",
                             option_given(c->options, "ao") ? NULL : "off"};
        for (size_t k = 0; k < sizeof own / sizeof *own; k += 2)
            if (own[k + 1] && !has_argument(words, count, own[k])) {
                json_put(&json, TEXT(NULL, own[k]), TEXT(NULL, own[k + 1]));
            }
        json_close(&json, ']');
        if (c->sheet.mistakes)
            json_put(&json, TEXT("mistake", cell->mistake));
        if (c->sheet.mistakes || (c->sheet.apart && i + 1 == c->sheet.count))
            json_put(&json, NUMBER("mean_difference", c->differences[i].mean),
                     NUMBER("largest_difference", c->differences[i].maximum));
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', json.file);
}

// Returns the sheet's path. The default is a path such as "koala-terms.png".
static char *path_of(const struct options *o, const char *model, const char *sheet)
{
    char ending[64];
    snprintf(ending, sizeof ending, "-%s.png", sheet);
    return output_path(o->picture.output, model, ending);
}

// Selects the sheet's defaults that apply to this command line and model.
static bool find_defaults(struct compare *c, lam_error *error)
{
    int shape = lam_shape_find(c->model);
    struct sheet_model model = {.shape = shape >= 0 ? lam_shape_name(shape) : NULL};
    if (shape < 0 && sheet_defaults_need_model(&c->sheet, c->options)) {
        struct job job = {.options = c->options, .model = c->model, .device = c->device};
        job.times.start = clock_ms();
        bool ok = job_load(&job, &c->progress, error);
        model.materials = job.model_counts.materials > 0;
        model.lights = job.model_counts.lights > 0;
        lam_scene_free(job.scene);
        if (!ok)
            return false;
    }
    c->default_count = sheet_defaults(&c->sheet, c->options, &model, c->defaults);
    for (int i = 0; i < c->default_count; i += 2)
        c->default_material |= strcmp(c->defaults[i], "--material") == 0;
    return true;
}

// Checks the characters of the user's captions, unless the sheet is an SVG.
static bool check_words(const struct options *o, lam_error *error)
{
    bool has_font = o->captions.font != NULL;
    if (o->captions.title && !drawing_check_text("title", o->captions.title, has_font, error))
        return false;
    for (int i = 0; i < o->captions.texts.count; i++)
        if (!drawing_check_text("caption", o->captions.texts.items[i], has_font, error))
            return false;
    return true;
}

static bool check(const struct options *o, const struct sheet *sheet, const char *model, const char *path,
                  lam_error *error)
{
    if (!check_caption_count(o, sheet, error))
        return false;
    if (!drawing_is_svg(path) && !o->captions.no_captions && !check_words(o, error))
        return false;
    if (strcmp(model, "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "compare reads the model once for each picture, so it cannot read '-' (standard input)");
    if (!terminal_start(o, true, error))
        return false;
    if (strcmp(path, "-") == 0)
        return !isatty(STDOUT_FILENO) || terminal_shows() || terminal_refuse("compare MODEL", error);
    if (drawing_is_svg(path))
        return output_check(path, model, output_given(o->picture.output), error);
    if (!output_check_bytes(path, "sheet", ".svg, ", error))
        return false;
    return output_check(path, model, output_is_named(o->picture.output), error);
}

// Adds to `paths` the files that the cells' own options name, as in --across look=my.look.
static bool reach_cells(const struct compare *c, struct sandbox_paths *paths, lam_error *error)
{
    struct options own;
    for (int i = 0; i < c->sheet.count; i++) {
        if (!cell_options(c, &c->sheet.cells[i], NULL, NULL, &own, error))
            return false;
        sandbox_add_options(paths, &own);
        options_free(&own);
    }
    return true;
}

int run_compare(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count;
    interrupt_start();
    struct compare c = {.options = options, .model = operands[0]};
    lam_error error = {0};
    char *store[ACROSS_MAX] = {0}, *path = NULL;
    bool ok = sheet_choose(options, &c.sheet, store, &error);
    ok = ok && ((path = path_of(options, c.model, c.sheet.name)) || complain(&error, LAM_MACHINE, "out of memory"));
    ok = ok && check(options, &c.sheet, c.model, path, &error);
    if (ok) {
        struct sandbox_paths paths = {0};
        sandbox_add_input(&paths, c.model);
        sandbox_add_output(&paths, path, !output_is_named(options->picture.output));
        struct options drawn = *options;
        if (c.sheet.mistakes && drawn.work.device == DEVICE_AUTO)
            drawn.work.device = DEVICE_GL;
        ok = reach_cells(&c, &paths, &error) && sandbox_start(&drawn, &paths, &error);
    }
    if (ok) {
        c.device = device_option_make(options, &error);
        progress_start(&c.progress, c.model, console_is_terminal() && !options->report.quiet);
        ok = c.device && find_defaults(&c, &error) && (!c.sheet.mistakes || choose_mistakes(&c, &error)) &&
             lay_out(&c, path, &error) && draw_sheet(&c, &error);
        progress_end(&c.progress);
        for (int i = 0; i < WARNINGS_MAX; i++) {
            if (c.warnings[i] && !options->report.quiet)
                say_warning(c.warnings[i]);
            free(c.warnings[i]);
        }
        ok = ok && drawing_write(&c.drawing, path, &error);
        if (ok && options->report.json)
            print_json(&c, path);
        else if (ok && !options->report.quiet)
            say_plain("%s  %dx%d  %d pictures\n", strcmp(path, "-") == 0 ? "standard output" : path, c.drawing.width,
                      c.drawing.height, c.sheet.count);
        lam_device_free(c.device);
        lam_image_free(&c.other);
        drawing_free(&c.drawing);
    }
    free(path);
    for (int i = 0; i < ACROSS_MAX; i++)
        free(store[i]);
    if (interrupted())
        interrupt_finish();
    return ok ? 0 : report_failure(&error, options);
}
