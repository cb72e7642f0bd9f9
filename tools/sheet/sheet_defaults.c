// sheet_defaults.c: decides which defaults of a sheet apply to a command line and a model.
#include "sheet.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

// For some shapes, a number of segments that makes the facets clearly visible. All other shapes use 24x12. The teapot's
// stacks are counted per patch, the knot needs more segments because it is long, and implicit surfaces have cells
// instead of segments.
static const struct {
    const char *shape, *segments;
} coarse_shapes[] = {{"teapot", "24x4"}, {"torus-knot", "72x10"}, {"gyroid", "32"}, {"metaballs", "24"}};

static const char *coarse(const char *shape)
{
    for (size_t i = 0; i < sizeof coarse_shapes / sizeof *coarse_shapes; i++)
        if (strcmp(coarse_shapes[i].shape, shape) == 0)
            return coarse_shapes[i].segments;
    return "24x12";
}

// Returns whether the command line or a row of variants sets the option.
static bool is_given(const struct sheet *sheet, const struct options *options, const char *dashed)
{
    if (option_given(options, dashed + 2))
        return true;
    for (int i = 0; sheet->across && i < sheet->count; i++)
        for (int k = 0; k < CELL_WORDS && sheet->cells[i].words[k]; k += 2)
            if (strcmp(sheet->cells[i].words[k], dashed) == 0)
                return true;
    return false;
}

// Returns whether a default applies. Options of the command line and of the sheet replace defaults.
static bool is_open(const struct sheet *sheet, const struct options *options, const struct sheet_default *one)
{
    bool light = strcmp(one->option, "--light") == 0;
    return !is_given(sheet, options, one->option) && !(light && is_given(sheet, options, "--rig"));
}

bool sheet_defaults_need_model(const struct sheet *sheet, const struct options *options)
{
    for (const struct sheet_default *one = sheet->defaults; one->option; one++)
        if ((strcmp(one->option, "--light") == 0 || strcmp(one->option, "--material") == 0) &&
            is_open(sheet, options, one))
            return true;
    return false;
}

int sheet_defaults(const struct sheet *sheet, const struct options *options, const struct sheet_model *model,
                   const char *words[2 * SHEET_DEFAULTS_MAX])
{
    int count = 0;
    for (const struct sheet_default *one = sheet->defaults; one->option; one++) {
        const char *value = one->value;
        bool light = strcmp(one->option, "--light") == 0, material = strcmp(one->option, "--material") == 0;
        if (!is_open(sheet, options, one) || (light && model->lights) || (material && model->materials))
            continue;
        if (strcmp(one->option, "--segments") == 0) {
            if (!model->shape)
                continue;
            value = coarse(model->shape);
        }
        words[count++] = one->option;
        words[count++] = value;
    }
    return count;
}

void sheet_defaults_merge(struct sheet *sheet, const struct sheet *other)
{
    for (const struct sheet_default *one = other->defaults; one->option; one++) {
        int at = 0;
        while (sheet->defaults[at].option && strcmp(sheet->defaults[at].option, one->option) != 0)
            at++;
        if (!sheet->defaults[at].option && at < SHEET_DEFAULTS_MAX)
            sheet->defaults[at] = *one;
    }
}

// --- finds the brightest highlight of a picture.

struct highlight highlight_find(const lam_image *whole, const lam_image *matt, int enlarged)
{
    int w = whole->width, h = whole->height, width = w / enlarged, height = h / (2 * enlarged);
    int span = w / 40 > 1 ? w / 40 : 1; // the size of the search window
    const uint8_t *a = whole->pixels, *b = matt->pixels;
    int64_t best = -1;
    int best_x = w / 2, best_y = h / 2;
    for (int y = 0; y + span <= h; y += (span + 1) / 2)
        for (int x = 0; x + span <= w; x += (span + 1) / 2) {
            int64_t sum = 0;
            for (int j = y; j < y + span; j++)
                for (int i = x; i < x + span; i++)
                    for (int k = 0; k < 3; k++) {
                        size_t at = 4 * ((size_t)j * (size_t)w + (size_t)i) + (size_t)k;
                        sum += a[at] - b[at];
                    }
            if (sum > best) {
                best = sum;
                best_x = x + span / 2;
                best_y = y + span / 2;
            }
        }
    struct highlight box = {best_x - width / 2, best_y - height / 2, width > 0 ? width : 1, height > 0 ? height : 1};
    box.left = box.left < 0 ? 0 : box.left > w - box.width ? w - box.width : box.left;
    box.top = box.top < 0 ? 0 : box.top > h - box.height ? h - box.height : box.top;
    return box;
}
