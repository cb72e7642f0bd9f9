// picture_load.c: reads pictures of any format, from memory and from files.
#include "codec.h"
#include "fail.h"
#include "file.h"
#include "float_state.h"
#include "picture_kinds.h"

#include <stdlib.h>
#include <string.h>

#define KNOWN "PNG, JPEG, WebP, BMP, TGA, PPM (P6), PFM, EXR or Radiance"

// After an error that is_doubtful, tests whether memory can still be allocated. If the test fails, replaces the error.
static bool blame_memory(lam_error *error)
{
    enum { SOME = 1 << 20 };            // more memory than these libraries request at once
    void *volatile some = malloc(SOME); // volatile, so that the unused memory is really allocated
    if (!some)
        return fail_memory(error, SOME);
    free(some);
    return false;
}

// If memory runs out, picture libraries report a damaged file, and loading a library fails. A picture with such an error
// is therefore decoded a second time: a model must not be drawn without its texture because one allocation failed.
static bool is_doubtful(const lam_error *error)
{
    return error->code == LAM_CANNOT_READ || error->code == LAM_UNSUPPORTED;
}

static bool read_once(const struct codec *codec, const struct picture_file *file, bool *wide, lam_image *image,
                      lam_error *error)
{
    return wide && codec->read_wide ? codec->read_wide(file, image, wide, error) : codec->read(file, image, error);
}

#define ROW(offset, length, magic, name) {offset, length, magic, name}
static const struct {
    size_t offset, length;
    const char *magic, *name;
} kinds[] = {UNREAD_PICTURES(ROW)};

// Decodes a picture. Keeps all bits of the file if `wide` is not NULL (codec.read_wide).
static bool decode(const struct picture_file *file, bool *wide, lam_image *image, lam_error *error)
{
    const struct codec *codec = codec_of(file->bytes, file->size, file->name);
    *image = (lam_image){0};
    if (!call_should_continue(file->call))
        return call_error(file->call, error);
    if (file->size == 0)
        return fail(error, LAM_CANNOT_READ, "%s: is empty, expected a " KNOWN " picture", file->name);
    for (size_t i = 0; !codec && i < sizeof kinds / sizeof *kinds; i++)
        if (file->size >= kinds[i].offset + kinds[i].length &&
            memcmp(file->bytes + kinds[i].offset, kinds[i].magic, kinds[i].length) == 0)
            return fail(error, LAM_UNSUPPORTED, "%s: this is %s, expected a " KNOWN " picture", file->name,
                        kinds[i].name);
    if (!codec)
        return fail(error, LAM_CANNOT_READ, "%s: byte 0: not the start of a " KNOWN " picture", file->name);
    lam_error own = {0};
    error = error ? error : &own;
    uint64_t state = float_state_enter();
    bool ok = read_once(codec, file, wide, image, error);
    ok = ok || (is_doubtful(error) && read_once(codec, file, wide, image, error));
    float_state_leave(state);
    return ok || (is_doubtful(error) && blame_memory(error));
}

bool picture_decode_wide(const struct picture_file *file, bool *wide, lam_image *image, lam_error *error)
{
    *wide = false;
    return decode(file, wide, image, error);
}

bool picture_decode(const struct picture_file *file, lam_image *image, lam_error *error)
{
    return decode(file, NULL, image, error);
}

bool picture_decode_linear(const struct picture_file *file, lam_color_mode color, lam_image *image, lam_error *error)
{
    bool wide = false;
    if (!decode(file, &wide, image, error))
        return false;
    uint64_t state = float_state_enter();
    bool ok = picture_linearize(file, image, wide, color, error);
    float_state_leave(state);
    if (!ok)
        picture_free(file->call, image);
    return ok;
}

// Loads a picture. If `color` is NULL, the file's values are not converted.
static bool load(lam_image *image, const char *path, const lam_color_mode *color, const lam_control *control,
                 lam_error *error)
{
    if (!image || !path)
        return fail(error, LAM_BAD_ARGUMENT, "load: a path and a picture to fill are needed");
    *image = (lam_image){0};
    struct call_control call;
    struct file_bytes bytes;
    call_start(&call, control);
    if (!file_read(path, NULL, &call, &bytes, error))
        return false;
    struct picture_file file = {bytes.data, bytes.size, strcmp(path, "-") == 0 ? "standard input" : path, &call};
    bool ok = color ? picture_decode_linear(&file, *color, image, error) : picture_decode(&file, image, error);
    file_release(&bytes);
    return ok;
}

bool lam_image_load(lam_image *image, const char *path, const lam_control *control, lam_error *error)
{
    return load(image, path, NULL, control, error);
}

bool lam_image_load_linear(lam_image *image, const char *path, lam_color_mode color, const lam_control *control,
                           lam_error *error)
{
    if ((unsigned)color > LAM_COLOR_RAW)
        return fail(error, LAM_BAD_ARGUMENT, "load: color mode %d is not one of lam_color_mode", (int)color);
    return load(image, path, &color, control, error);
}
