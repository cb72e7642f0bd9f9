// target_codec.c: fuzz target that reads one picture format, TARGET_CODEC.

#include "codec.h"
#include "pixels.h"
#include "target.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

size_t fuzz_seed(uint8_t *data, size_t capacity);

// Keeps open a library that reading would load each time, because loading takes longer than most inputs.
static void keep_open(const char *library) { dlopen(library, RTLD_NOW | RTLD_NODELETE); }

// Invariant for every input: a picture, or an error with a message and no picture. Memory and time are limited. A
// format with more than 8 bits is read in both ways. Small files can claim many pixels, and clearing their memory takes
// a thousand times as long as reading them. One input in 16 (by its size) may have as many pixels as the memory limit
// allows, the others PIXELS.
enum { PIXELS = 1 << 16 };

static void read_picture(const struct codec *codec, const uint8_t *data, size_t size, const char *name)
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
        if (ok) // its last byte exists
            (void)((const volatile uint8_t *)image.pixels)[pixel_bytes(image.format) * count - 1];
        note_sentence(ok ? "" : error.text);
        picture_free(&call, &image);
        if (call.memory_used != 0)
            abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static bool open;
    if (!open) {
        keep_open("libwebp.so.7");
        keep_open("libOpenEXRCore-3_1.so.30");
        open = true;
    }
    char name[32];
    snprintf(name, sizeof name, "fuzz.%s", TARGET_CODEC.name);
    read_picture(&TARGET_CODEC, data, size, name);
    return 0;
}

// A picture written by the format's own encoder.
size_t fuzz_seed(uint8_t *data, size_t capacity)
{
    lam_image image;
    lam_bytes bytes = {0};
    if (!TARGET_CODEC.write || !lam_image_make(&image, 13, 7, TARGET_CODEC.pixels, NULL))
        return 0;
    for (size_t i = 0; i < 13 * 7 * 4; i++)
        if (TARGET_CODEC.pixels == LAM_RGBA8)
            ((uint8_t *)image.pixels)[i] = (uint8_t)(i * 37 + i / 7);
        else
            ((float *)image.pixels)[i] = (float)i * 0.25f;
    size_t size =
        lam_image_encode(&image, TARGET_CODEC.name, NULL, &bytes, NULL) && bytes.size <= capacity ? bytes.size : 0;
    if (size)
        memcpy(data, bytes.data, size);
    lam_bytes_free(&bytes);
    lam_image_free(&image);
    return size;
}
