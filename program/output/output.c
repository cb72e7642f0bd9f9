// output.c: determines the path of a picture, checks it and writes the picture.
#include "output.h"
#include "console.h"
#include "file_io.h"
#include "writer.h"

#include <lambent/path.h>
#include <lambent/scene.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

bool output_is_named(const char *output)
{
    return output && output[strlen(output) - 1] != '/' && !path_is_folder(output);
}

char *output_path_of(const char *output, const struct output_words *words)
{
    return output_name_is_pattern(output) ? output_name_expand(output, words)
                                          : output_path(output, words->model, ".png");
}

char *output_path(const char *output, const char *model, const char *ending)
{
    if (output_is_named(output))
        return strdup(output);
    const char *folder = output ? output : "";
    int length;
    const char *stem = output_stem(model, &length);
    bool slash = *folder && folder[strlen(folder) - 1] != '/';
    char *path = NULL;
    if (asprintf(&path, "%s%s%.*s%s", folder, slash ? "/" : "", length, stem, ending) < 0)
        return NULL;
    return path;
}

// Checks that files can be created in the folder of `path` or, if this folder is missing and `makes` is set, in the
// nearest existing folder above it.
static bool check_folder(const char *path, bool makes, lam_error *error)
{
    char *folder = output_folder_of(path);
    struct stat found;
    while (folder && makes && lam_path_stat(folder, &found) != 0 && errno == ENOENT && strcmp(folder, ".") != 0) {
        char *above = output_folder_of(folder);
        free(folder);
        folder = above;
    }
    if (!folder)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = true;
    if (lam_path_stat(folder, &found) != 0)
        ok = complain(error, LAM_CANNOT_WRITE, "%s: cannot write: the folder '%s': %s", path, folder, strerror(errno));
    else if (!S_ISDIR(found.st_mode))
        ok = complain(error, LAM_CANNOT_WRITE, "%s: cannot write: '%s' is not a folder", path, folder);
    else if (access(folder, W_OK | X_OK) != 0)
        ok = complain(error, LAM_CANNOT_WRITE, "%s: cannot write: the folder '%s': %s", path, folder, strerror(errno));
    free(folder);
    return ok;
}

enum output_given output_given(const char *output)
{
    return output_name_is_pattern(output) ? OUTPUT_PATTERN : output_is_named(output) ? OUTPUT_NAMED : OUTPUT_BY_MODEL;
}

bool output_check(const char *path, const char *model, enum output_given given, lam_error *error)
{
    struct stat there, of_model;
    bool named = given != OUTPUT_BY_MODEL;
    if (lam_path_stat(path, &there) != 0)
        return check_folder(path, given != OUTPUT_NAMED, error);
    // If `path` is the model itself (such as koala.png), loading it will report that it is not a model file.
    if (given != OUTPUT_NAMED && lam_path_stat(model, &of_model) == 0 && there.st_dev == of_model.st_dev &&
        there.st_ino == of_model.st_ino)
        return true;
    if (S_ISDIR(there.st_mode))
        return complain(error, LAM_CANNOT_WRITE, "%s: cannot write: the path is a folder%s", path,
                        named ? "" : "; name another file with -o");
    if (!S_ISREG(there.st_mode)) { // pipes and devices are written directly
        if (access(path, W_OK) != 0)
            return complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", path, strerror(errno));
        return true;
    }
    if (!named && !lam_image_is_from_lambent(path))
        return complain(error, LAM_CANNOT_WRITE,
                        "%s: already exists, and lambent did not write it; -o %s replaces it, -o FILE writes another",
                        path, path);
    return check_folder(path, false, error);
}

uint64_t output_size(const char *path)
{
    struct stat found;
    return lam_path_stat(path, &found) == 0 && S_ISREG(found.st_mode) ? (uint64_t)found.st_size : 0;
}

bool output_is_stream(const char *path)
{
    struct stat found;
    lam_pixel_format format;
    return strcmp(path, "-") == 0 || (lam_path_stat(path, &found) == 0 && !S_ISREG(found.st_mode) &&
                                      !S_ISDIR(found.st_mode) && !lam_image_format_for(path, &format, NULL));
}

// File managers pass a thumbnailer a name without an extension, and expect a PNG.
static bool is_without_ending(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    return *name && !strchr(name, '.');
}

const char *output_ending(const char *path)
{
    return output_is_stream(path) || is_without_ending(path) ? "png" : strrchr(path, '.') + 1;
}

bool output_format(const char *path, lam_pixel_format *format, lam_error *error)
{
    *format = LAM_RGBA8; // the format of a stream
    if (output_is_stream(path) || is_without_ending(path) || lam_image_format_for(path, format, error))
        return true;
    size_t used = strlen(error->text);
    if (is_model_name(path))
        snprintf(error->text + used, sizeof error->text - used, "; to write a model: lambent convert MODEL OUT");
    return false;
}

// Returns whether the format is written with 8 bits per channel.
static bool holds_bytes(int format)
{
    char path[32];
    lam_pixel_format pixels;
    snprintf(path, sizeof path, "a.%s", lam_image_format_name(format));
    return lam_image_format_written(format) && lam_image_format_for(path, &pixels, NULL) && pixels == LAM_RGBA8;
}

bool output_check_bytes(const char *path, const char *noun, const char *others, lam_error *error)
{
    lam_pixel_format format;
    if (!output_format(path, &format, error)) {
        size_t length = strlen(error->text);
        if (*others)
            snprintf(error->text + length, sizeof error->text - length, "; for vector graphics, use %.4s", others);
        return false;
    }
    if (format == LAM_RGBA8)
        return true;
    char list[128] = "";
    int last = -1;
    for (int i = 0; lam_image_format_name(i); i++)
        last = holds_bytes(i) ? i : last;
    size_t used = 0;
    for (int i = 0; i <= last && used < sizeof list; i++)
        if (holds_bytes(i))
            used += (size_t)snprintf(list + used, sizeof list - used, "%s.%s",
                                     !used       ? ""
                                     : i == last ? " or "
                                                 : ", ",
                                     lam_image_format_name(i));
    return complain(error, LAM_UNSUPPORTED, "%s: a %s is written as %s%s", path, noun, others, list);
}

bool is_model_name(const char *name)
{
    const char *dot = strrchr(name, '.');
    for (int format = 0; dot && dot != name && lam_model_format_name(format); format++) {
        bool readable;
        lam_model_format_package(format, &readable);
        if (!readable || strcmp(lam_model_format_name(format), "scene") == 0)
            continue;
        for (const char *ending = lam_model_format_extensions(format); *ending; ending += strspn(ending, " ")) {
            size_t length = strcspn(ending, " ");
            if (strlen(dot + 1) == length && strncasecmp(dot + 1, ending, length) == 0)
                return true;
            ending += length;
        }
    }
    return false;
}

static bool write_stdout(const lam_bytes *bytes, lam_error *error)
{
    return (fflush(stdout) == 0 && write_all(STDOUT_FILENO, bytes->data, bytes->size)) ||
           complain(error, LAM_CANNOT_WRITE, "standard output: cannot write: %s", strerror(errno));
}

static output_show_fn *shows;

void output_show_with(output_show_fn *show) { shows = show; }

static bool save(const lam_image *image, const char *path, const lam_save_params *params, uint64_t *size,
                 lam_error *error)
{
    lam_bytes bytes = {0};
    bool ok = lam_image_encode(image, output_ending(path), params, &bytes, error) &&
              output_save_bytes(&bytes, path, params->durable, size, error);
    lam_bytes_free(&bytes);
    return ok;
}

// Writes a picture that is already encoded as a PNG.
static bool save_shown(const lam_image *image, const lam_bytes *png, const char *path, const lam_save_params *params,
                       uint64_t *size, lam_error *error)
{
    const char *dot = strrchr(path, '.');
    *size = 0;
    if (output_is_stream(path) || is_without_ending(path) || (dot && strcmp(dot, ".png") == 0))
        return strcmp(path, "-") == 0 || output_save_bytes(png, path, params->durable, size, error);
    return save(image, path, params, size, error);
}

bool output_save(const lam_image *image, const char *path, const lam_save_params *params, uint64_t *size,
                 lam_error *error)
{
    if (!shows)
        return save(image, path, params, size, error);
    lam_bytes png = {0};
    bool ok = lam_image_encode(image, "png", params, &png, error) &&
              save_shown(image, &png, path, params, size, error) && shows(&png, image, error);
    lam_bytes_free(&png);
    return ok;
}

bool output_save_bytes(const lam_bytes *bytes, const char *path, bool durable, uint64_t *size, lam_error *error)
{
    bool to_stdout = strcmp(path, "-") == 0, stream = output_is_stream(path);
    bool ok = to_stdout ? write_stdout(bytes, error) : writer_save(path, bytes, durable, error);
    *size = !ok ? 0 : stream ? bytes->size : output_size(path);
    return ok;
}

// --- averages the pixels of a large picture, in linear light.

static unsigned char encode(double linear)
{
    double x = linear <= 0 ? 0 : linear >= 1 ? 1 : linear;
    return (unsigned char)((x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055) * 255 + 0.5);
}

// Averages the pixels of the large picture under each pixel of the small picture, in linear light with premultiplied
// alpha.
static void average(const lam_image *from, const lam_image *to)
{
    for (int y = 0; y < to->height; y++)
        for (int x = 0; x < to->width; x++) {
            int left = (int)((int64_t)x * from->width / to->width),
                right = (int)((int64_t)(x + 1) * from->width / to->width);
            int top = (int)((int64_t)y * from->height / to->height),
                bottom = (int)((int64_t)(y + 1) * from->height / to->height);
            double sum[4] = {0};
            for (int v = top; v < bottom; v++)
                for (int u = left; u < right; u++)
                    for (int c = 0; c < 4; c++)
                        sum[c] +=
                            (double)((const float *)
                                         from->pixels)[4 * ((size_t)v * (size_t)from->width + (size_t)u) + (size_t)c];
            unsigned char *pixel = (unsigned char *)to->pixels + 4 * ((size_t)y * (size_t)to->width + (size_t)x);
            double alpha = sum[3] / ((double)(right - left) * (bottom - top));
            for (int c = 0; c < 3; c++)
                pixel[c] = encode(sum[3] > 0 ? sum[c] / sum[3] : 0);
            pixel[3] = (unsigned char)((alpha < 1 ? alpha : 1) * 255 + 0.5);
        }
}

bool shrink_linear(const lam_image *from, int most, lam_image *to, lam_error *error)
{
    int longer = from->width > from->height ? from->width : from->height;
    most = longer < most ? longer : most;
    int width = (int)((int64_t)from->width * most / longer), height = (int)((int64_t)from->height * most / longer);
    if (!lam_image_make(to, width ? width : 1, height ? height : 1, LAM_RGBA8, error))
        return false;
    average(from, to);
    return true;
}

static double decode(unsigned char value)
{
    double x = value / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

bool shrink_bytes(const lam_image *from, int most, lam_image *to, lam_error *error)
{
    size_t count = (size_t)from->width * (size_t)from->height;
    if (from->width <= most && from->height <= most) {
        if (!lam_image_make(to, from->width, from->height, LAM_RGBA8, error))
            return false;
        memcpy(to->pixels, from->pixels, 4 * count);
        return true;
    }
    lam_image linear;
    float light[256];
    if (!lam_image_make(&linear, from->width, from->height, LAM_RGBA32F, error))
        return false;
    for (int i = 0; i < 256; i++)
        light[i] = (float)decode((unsigned char)i);
    const unsigned char *bytes = from->pixels;
    float *numbers = linear.pixels;
    for (size_t i = 0; i < 4 * count; i += 4) {
        float alpha = (float)bytes[i + 3] / 255;
        for (size_t c = 0; c < 3; c++)
            numbers[i + c] = light[bytes[i + c]] * alpha;
        numbers[i + 3] = alpha;
    }
    bool ok = shrink_linear(&linear, most, to, error);
    lam_image_free(&linear);
    return ok;
}
