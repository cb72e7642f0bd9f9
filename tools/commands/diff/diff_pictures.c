// diff_pictures.c: `lambent diff` for two pictures: reports their difference as numbers and as a picture.
#include "diff.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "console.h"
#include "json.h"
#include "limit_options.h"
#include "job.h"
#include "output.h"
#include "report.h"
#include "sandbox_start.h"

struct pair {
    const char *name[2];
    char *output; // the path of the picture, or NULL
    lam_image image[2];
    lam_difference difference;
    lam_image where; // the picture of the difference; drawn only for --output
};

static bool load_pair(struct pair *pair, const struct options *o, lam_error *error)
{
    lam_control control = limits_control(o);
    for (int i = 0; i < 2; i++)
        if (!lam_image_load(&pair->image[i], pair->name[i], &control, error)) {
            size_t used = strlen(error->text);
            if (is_model_name(pair->name[i]))
                snprintf(error->text + used, sizeof error->text - used, "; diff compares two pictures, or two models");
            return false;
        }
    const lam_image *a = &pair->image[0], *b = &pair->image[1];
    if (a->width != b->width || a->height != b->height)
        return complain(error, LAM_BAD_ARGUMENT, "%.180s has %dx%d pixels and %.180s %dx%d, expected the same size",
                        pair->name[0], a->width, a->height, pair->name[1], b->width, b->height);
    if (a->format != b->format)
        return complain(error, LAM_BAD_ARGUMENT,
                        "%.180s contains %s and %.180s contains %s, expected two pictures of one kind", pair->name[0],
                        a->format == LAM_RGBA8 ? "bytes" : "floats", pair->name[1],
                        b->format == LAM_RGBA8 ? "bytes" : "floats");
    for (int i = 0; i < 2 && a->no_alpha != b->no_alpha; i++) // only one of the files stores alpha
        for (size_t at = 3; at < 4 * (size_t)a->width * (size_t)a->height; at += 4)
            ((float *)pair->image[i].pixels)[at] = 1;
    return lam_image_compare(a, b, &pair->difference, error);
}

// Converts floats to bytes without encoding; 1 becomes 255.
static bool to_bytes(lam_image *image, lam_error *error)
{
    lam_image bytes;
    if (!lam_image_make(&bytes, image->width, image->height, LAM_RGBA8, error))
        return false;
    const float *from = image->pixels;
    uint8_t *to = bytes.pixels;
    for (size_t i = 0; i < 4 * (size_t)image->width * (size_t)image->height; i++)
        to[i] = from[i] < 1.0f ? (uint8_t)(from[i] * 255.0f + 0.5f) : 255;
    lam_image_free(image);
    *image = bytes;
    return true;
}

static bool write_picture(struct pair *pair, const struct options *o, lam_error *error)
{
    lam_pixel_format format;
    if (!output_format(pair->output, &format, error))
        return false;
    if (format == LAM_RGBA32F && pair->image[0].format == LAM_RGBA8)
        return complain(error, LAM_BAD_ARGUMENT, "%s stores floats, but the pictures contain bytes; write .png or .ppm",
                        pair->output);
    if (!lam_image_difference(&pair->image[0], &pair->image[1], (float)o->diff.gain, &pair->where, error) ||
        (pair->where.format != format && !to_bytes(&pair->where, error)))
        return false;
    lam_save_params params = {.raw = true};
    uint64_t size;
    return output_save(&pair->where, pair->output, &params, &size, error);
}

static void print_json(FILE *file, const struct pair *pair, const struct options *o, bool differ)
{
    const lam_difference *d = &pair->difference;
    struct json json = {.file = file};
    json_put(&json,
             OBJECT(NULL, TEXT("a", pair->name[0]), TEXT("b", pair->name[1]), COUNT("width", pair->image[0].width),
                    COUNT("height", pair->image[0].height), NUMBER("maximum", d->maximum), NUMBER("mean", d->mean),
                    NUMBER("rmse", d->rmse), NUMBER("psnr_db", d->psnr_db), NUMBER("share_over_1", d->share_over_1),
                    NUMBER("share_over_2", d->share_over_2), NUMBER("tolerance", o->diff.tolerance),
                    COUNT("differ", differ), TEXT("picture", pair->output)));
    putc('\n', file);
}

static void print_text(FILE *file, const struct pair *pair, const struct options *o, bool differ)
{
    const lam_difference *d = &pair->difference;
    fprintf(file, "maximum      %.7g (%.5g/255)\n", d->maximum, d->maximum * 255);
    fprintf(file, "mean         %.7g\n", d->mean);
    fprintf(file, "rmse         %.7g\n", d->rmse);
    if (d->psnr_db - d->psnr_db == 0)
        fprintf(file, "psnr         %.2f dB\n", d->psnr_db);
    else
        fprintf(file, "psnr         %s\n", d->psnr_db > 0 ? "infinite" : "minus infinite");
    fprintf(file, "over 1/255   %.4g %% of %dx%d pixels\n", d->share_over_1 * 100, pair->image[0].width,
            pair->image[0].height);
    fprintf(file, "over 2/255   %.4g %%\n", d->share_over_2 * 100);
    fprintf(file, "%s\n",
            d->maximum == 0     ? "equal"
            : !differ           ? "within the tolerance"
            : o->diff.tolerance ? "beyond the tolerance"
                                : "different");
}

int diff_pictures(char **operands, const struct options *options)
{
    struct pair pair = {.name = {operands[0], operands[1]}};
    bool to_stdout = options->picture.output && strcmp(options->picture.output, "-") == 0;
    lam_error error = {0};
    bool ok = true;
    if (to_stdout && isatty(STDOUT_FILENO))
        ok = complain(&error, LAM_BAD_ARGUMENT,
                      "standard output is a terminal, and the picture is not text; redirect it: lambent diff "
                      "A B -o - > FILE");
    else if (options->picture.output &&
             !(pair.output = output_path(options->picture.output, pair.name[0], "-difference.png")))
        ok = complain(&error, LAM_MACHINE, "out of memory");
    else if (options->picture.output && !to_stdout)
        ok = output_check(pair.output, pair.name[0], output_is_named(options->picture.output), &error) &&
             ((!job_is_same_file(pair.output, operands[0]) && !job_is_same_file(pair.output, operands[1])) ||
              complain(&error, LAM_BAD_ARGUMENT,
                       "%.300s: the output would replace one of the compared pictures; name another output",
                       pair.output));
    if (ok) {
        struct sandbox_paths paths = {0};
        for (int i = 0; i < 2; i++)
            sandbox_add_file(&paths, operands[i]);
        if (pair.output)
            sandbox_add_output(&paths, pair.output, !output_is_named(options->picture.output));
        ok = sandbox_start(options, &paths, &error) && load_pair(&pair, options, &error) &&
             (!options->picture.output || write_picture(&pair, options, &error));
    }
    bool differ = ok && pair.difference.maximum > options->diff.tolerance / 255.0;
    if (ok) {
        FILE *file = to_stdout ? stderr : stdout;
        if (options->report.json)
            print_json(file, &pair, options, differ);
        else if (!options->report.quiet)
            print_text(file, &pair, options, differ);
    }
    for (int i = 0; i < 2; i++)
        lam_image_free(&pair.image[i]);
    lam_image_free(&pair.where);
    free(pair.output);
    if (!ok)
        return report_failure(&error, options);
    return differ ? EXIT_DIFFERS : 0;
}
