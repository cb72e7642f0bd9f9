// target_codec.h: shared by the fuzz targets that read one format of pictures.
#ifndef TARGET_CODEC_H
#define TARGET_CODEC_H

#include "codec.h"
#include "pixels.h"
#include "target.h"

#include <dlfcn.h>

// Opens a library that reading opens each time: that takes longer than most inputs.
static inline void keep_open(const char *library)
{
    static void *handle;
    if (!handle)
        handle = dlopen(library, RTLD_NOW | RTLD_NODELETE);
}

// Invariant for every input: a picture, or an error with a sentence and no picture. Memory and time are limited. A format that
// keeps more than 8 bits is read both ways. Small files can claim many pixels, and to clear their memory takes a thousand times
// as long as to read them: one input in 16 (by its size) may have as many as the memory takes, the others PIXELS.
enum { PIXELS = 1 << 16 };

static inline void read_picture(const struct codec *codec, const uint8_t *data, size_t size, const char *name)
{
    for (int wide = 0; wide <= (codec->read_wide != NULL); wide++) {
        struct call_control call;
        call_start(
            &call,
            &(lam_control){.memory_limit_bytes = 256 << 20, .pixel_limit = size % 16 ? PIXELS : 0, .time_limit_s = 20});
        const struct picture_file file = {data, size, name, &call};
        lam_image image = {0};
        lam_error error = {0};
        bool is_wide = false;
        bool ok = wide ? codec->read_wide(&file, &image, &is_wide, &error) : codec->read(&file, &image, &error);
        if (ok ? !image.pixels || is_wide != (wide && image.format == LAM_RGBA32F) : image.pixels || !error.text[0])
            abort();
        const size_t count = (size_t)image.width * (size_t)image.height;
        if (ok) // its last byte is there
            (void)((const volatile uint8_t *)image.pixels)[pixel_bytes(image.format) * count - 1];
        note_sentence(ok ? "" : error.text);
        picture_free(&call, &image);
        if (call.memory_used != 0)
            abort();
    }
}

#endif
