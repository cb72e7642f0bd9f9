// target_codec.h: shared by the fuzz targets that read one format of pictures.
#ifndef TARGET_CODEC_H
#define TARGET_CODEC_H

#include "codec.h"
#include "target.h"

// Invariant for every input: a picture, or an error with a sentence and no picture. Memory and time are limited.
static inline void read_picture(const struct codec *codec, const uint8_t *data, size_t size, const char *name)
{
    struct call_control call;
    call_start(&call, &(lam_control){.memory_limit_bytes = 256 << 20, .time_limit_s = 20});
    lam_image image = {0};
    lam_error error = {0};
    if (codec->read(&(struct picture_file){data, size, name, &call}, &image, &error) ? !image.pixels
                                                                                     : image.pixels || !error.text[0])
        abort();
    picture_free(&call, &image);
    if (call.memory_used != 0)
        abort();
}

#endif
