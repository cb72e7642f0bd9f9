// codecs.c: the table of picture formats, and the functions that select from it.
#include "codec.h"
#include "fail.h"
#include "file.h"
#include "float_state.h"
#include "pixels.h"
#include "spelling.h"

#include <lambent/path.h>

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#define ROW(name) &codec_##name,
static const struct codec *const codecs[] = {CODECS(ROW) & codec_gif};
enum { COUNT = sizeof codecs / sizeof *codecs, MAX_THREADS = 1024, LIST_BYTES = 128 };

const char *lam_image_format_name(int format) { return (unsigned)format < COUNT ? codecs[format]->name : NULL; }

const char *lam_image_format_alias(int format) { return (unsigned)format < COUNT ? codecs[format]->alias : NULL; }

bool lam_image_format_is_read(int format) { return (unsigned)format < COUNT && codecs[format]->read; }

const char *lam_image_format_written(int format) { return (unsigned)format < COUNT ? codecs[format]->written : NULL; }

static const struct codec *codec_named(const char *name)
{
    for (int i = 0; i < COUNT; i++)
        if (codecs[i]->write &&
            (strcasecmp(codecs[i]->name, name) == 0 || (codecs[i]->alias && strcasecmp(codecs[i]->alias, name) == 0)))
            return codecs[i];
    return NULL;
}

// Lists the names of the formats that Lambent can write, and returns how many there are.
static int written_names(const char *names[COUNT])
{
    int count = 0;
    for (int i = 0; i < COUNT; i++)
        if (codecs[i]->write)
            names[count++] = codecs[i]->name;
    return count;
}

// Makes the list "png, ppm, … or webp", with the prefix `before` before each name.
static const char *list_names(const char *before, char list[LIST_BYTES])
{
    const char *names[COUNT];
    int count = written_names(names);
    size_t used = 0;
    for (int i = 0; i < count; i++) {
        const char *parts[] = {i == 0 ? "" : i == count - 1 ? " or " : ", ", before, names[i]};
        for (int part = 0; part < 3; part++)
            for (const char *letter = parts[part]; *letter && used < LIST_BYTES - 1; letter++)
                list[used++] = *letter;
    }
    list[used] = 0;
    return list;
}

// Returns the formats to suggest instead of an unsupported format, or NULL if the unsupported format is unknown.
static const char *instead_of(const char *word)
{
    static const struct {
        const char *words[12], *instead;
    } rows[] = {
        {{"mp4", "mov", "avi", "mkv", "webm", "m4v", "mpg", "mpeg", "ogv"},
         "gif or .webp, which support animations; for a video, pipe frames to ffmpeg: -o - (docs/animation.md)"},
        {{"apng"}, "png, which contains all frames of an animation (APNG)"},
        {{"bmp", "tga", "tif", "tiff", "heic", "avif", "jp2", "svg", "pdf", "eps", "ico"}, "png"},
        {{"hdr", "rgbe"}, "exr"},
        {{"obj", "stl", "ply", "gltf", "glb", "3mf", "json", "step", "fbx"}, "png"}, // models
    };
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++)
        for (const char *const *known = rows[row].words; *known; known++)
            if (strcasecmp(*known, word) == 0)
                return rows[row].instead;
    return NULL;
}

static bool fail_unknown(lam_error *error, const char *subject, const char *before, const char *word)
{
    const char *names[COUNT], *instead = instead_of(word);
    char list[LIST_BYTES];
    list_names(before, list);
    if (instead || (instead = nearest_word(word, names, written_names(names))))
        return fail(error, LAM_UNSUPPORTED, "%s: lambent cannot write %s%s; use %s%s (it writes %s)", subject, before,
                    word, before, instead, list);
    if (*before && word[strspn(word, "0123456789")] == 0) // "part-v1.0" has no extension
        return fail(error, LAM_UNSUPPORTED, "%s: the extension .%s is not a picture format; expected %s, as in %s.png",
                    subject, word, list, subject);
    return fail(error, LAM_UNSUPPORTED, "%s: lambent cannot write %s%s; use %s", subject, before, word, list);
}

static const struct codec *codec_for(const char *path, lam_error *error)
{
    const char *ending = path_ending(path);
    const struct codec *codec = codec_named(ending);
    char list[LIST_BYTES];
    if (!codec && *ending)
        fail_unknown(error, path, ".", ending);
    else if (!codec)
        fail(error, LAM_UNSUPPORTED, "%s: the name has no extension of a picture, expected %s", path,
             list_names(".", list));
    return codec;
}

struct pool *encoding_pool(const lam_image *image, int threads)
{
    // Starting a thread takes as long as encoding a few thousand pixels, so each thread encodes at least 65536 pixels.
    const int64_t max_threads = (int64_t)image->width * image->height >> 16;
    if (threads == 0)
        threads = lam_processors_available();
    if (threads > max_threads)
        threads = (int)max_threads;
    return threads > 1 ? pool_make(threads) : NULL;
}

bool save_params_check(const lam_save_params *params, lam_error *error)
{
    if (!check_reserved("lam_save_params", params, error))
        return false;
    if (params->threads < 0 || params->threads > MAX_THREADS)
        return fail(error, LAM_BAD_ARGUMENT, "threads: %d, expected 0 to %d", params->threads, MAX_THREADS);
    if (params->quality < 0 || params->quality > 100)
        return fail(error, LAM_BAD_ARGUMENT, "quality: %lld, expected 1 to 100, or 0 for the format's own",
                    (long long)params->quality);
    size_t length = 0;
    for (; params->comment && params->comment[length]; length++)
        if (length == SAVE_COMMENT_MAX || params->comment[length] < ' ' || params->comment[length] > '~')
            return fail(error, LAM_BAD_ARGUMENT, "comment: expected at most %d printable characters of ASCII",
                        SAVE_COMMENT_MAX);
    return true;
}

static bool encode(const struct codec *codec, const lam_image *image, const lam_save_params *params, lam_bytes *out,
                   lam_error *error)
{
    static const lam_save_params plain = {0};
    if (!params)
        params = &plain;
    if (!image_check(image, "image", error) || !save_params_check(params, error))
        return false;
    lam_pixel_format pixels = params->single && codec == &codec_png ? LAM_RGBA32F : codec->pixels;
    if (working_format(image->format) != pixels)
        return fail(error, LAM_BAD_ARGUMENT, "image: %s is made from %s, the picture has %s", codec->title,
                    pixels == LAM_RGBA8 ? "bytes (LAM_RGBA8)" : "floats (LAM_RGBA32F)",
                    format_is_float(image->format) ? "floats" : "bytes");
    lam_image working;
    if (!image_working(image, &working, error))
        return false;
    uint64_t state = float_state_enter();
    struct pool *pool = encoding_pool(image, params->threads);
    bool ok = codec->write(&working, params, pool, out, error);
    pool_free(pool);
    float_state_leave(state);
    lam_image_free(&working);
    return ok;
}

bool lam_image_encode(const lam_image *image, const char *format, const lam_save_params *params, lam_bytes *out,
                      lam_error *error)
{
    if (!out || !format)
        return fail(error, LAM_BAD_ARGUMENT, "encode: a format and a pointer for the bytes are needed");
    *out = (lam_bytes){0};
    const struct codec *codec = codec_named(format);
    if (!codec)
        return fail_unknown(error, "format", "", format);
    return encode(codec, image, params, out, error);
}

bool lam_image_save(const lam_image *image, const char *path, const lam_save_params *params, lam_error *error)
{
    if (!path)
        return fail(error, LAM_BAD_ARGUMENT, "save: a path is needed");
    const struct codec *codec = codec_for(path, error);
    lam_bytes bytes = {0};
    if (!codec || !encode(codec, image, params, &bytes, error))
        return false;
    // Before the file is created, check whether the call must stop.
    struct call_control call;
    call_start(&call, params ? params->control : NULL);
    bool ok = call_should_continue(&call)
                  ? file_write(path, bytes.data, bytes.size, params && params->durable, &call, error)
                  : call_error(&call, error);
    lam_bytes_free(&bytes);
    return ok;
}

bool lam_image_save_layers(const lam_layer *layers, int count, const char *path, lam_error *error)
{
    if (!path)
        return fail(error, LAM_BAD_ARGUMENT, "save: a path is needed");
    lam_bytes bytes;
    if (!lam_image_encode_layers(layers, count, &bytes, error))
        return false;
    bool ok = file_write(path, bytes.data, bytes.size, false, NULL, error);
    lam_bytes_free(&bytes);
    return ok;
}

static bool save_bytes(const lam_bytes *bytes, const char *path, bool durable, lam_error *error)
{
    if (!bytes || !path || !*path)
        return fail(error, LAM_BAD_ARGUMENT, "save: %s needed", bytes ? "a path is" : "bytes are");
    return file_write(path, bytes->data, bytes->size, durable, NULL, error);
}

bool lam_bytes_save(const lam_bytes *bytes, const char *path, lam_error *error)
{
    return save_bytes(bytes, path, false, error);
}

bool lam_bytes_save_durably(const lam_bytes *bytes, const char *path, lam_error *error)
{
    return save_bytes(bytes, path, true, error);
}

bool lam_image_format_for(const char *path, lam_pixel_format *format, lam_error *error)
{
    if (!path || !format)
        return fail(error, LAM_BAD_ARGUMENT, "format: a path and a pointer for the result are needed");
    const struct codec *codec = codec_for(path, error);
    if (codec)
        *format = codec->pixels;
    return codec != NULL;
}

const struct codec *codec_of(const uint8_t *bytes, size_t size, const char *name)
{
    for (int i = 0; i < COUNT; i++)
        if (codecs[i]->probe && codecs[i]->probe(bytes, size))
            return codecs[i];
    for (int i = 0; name && i < COUNT; i++)
        if (codecs[i]->unmarked && strcasecmp(path_ending(name), codecs[i]->name) == 0)
            return codecs[i];
    return NULL;
}

bool lam_image_is_from_lambent(const char *path)
{
    if (!path)
        return false;
    // Pipes and devices are not opened. O_NONBLOCK protects against a pipe or device that has replaced the file since
    // stat.
    struct stat about;
    int file = lam_path_stat(path, &about) == 0 && S_ISREG(about.st_mode)
                   ? lam_path_open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)
                   : -1;
    if (file < 0)
        return false;
    uint8_t head[CODEC_HEAD];
    size_t size = 0;
    if (fstat(file, &about) == 0 && S_ISREG(about.st_mode))
        for (ssize_t got; size < sizeof head && (got = read(file, head + size, sizeof head - size)) > 0;)
            size += (size_t)got;
    close(file);
    const struct codec *codec = codec_of(head, size, NULL);
    return codec && codec->ours && codec->ours(head, size);
}
