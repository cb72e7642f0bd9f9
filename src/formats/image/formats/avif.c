// avif.c: reads AVIF files; of several pictures, the first. This file uses the library libavif, which is loaded on demand
// (dlopen). The pixels of lossy files may depend on the version of libavif.
// https://aomediacodec.github.io/av1-avif
#include "codec.h"
#include "dynamic_library.h"
#include "fail.h"
#include "remedy.h"

#include <string.h>

// The file begins with a box that lists its kinds.
static bool avif_probe(const uint8_t *bytes, size_t size)
{
    size_t end = size >= 16 && !bytes[0] && !bytes[1] ? (size_t)bytes[2] << 8 | bytes[3] : 0;
    bool found = false;
    for (size_t at = 8; at + 4 <= end && at + 4 <= size; at += 4)
        found |= at != 12 && (memcmp(bytes + at, "avif", 4) == 0 || memcmp(bytes + at, "avis", 4) == 0);
    return found && memcmp(bytes + 4, "ftyp", 4) == 0;
}

#ifdef HAVE_AVIF

#include <avif/avif.h>

// Version 1 has other structures than 0.11, so the library must be of the version of the headers.
#define AVIF_LIBRARY (AVIF_VERSION_MAJOR >= 1 ? "libavif.so.16" : "libavif.so.15")
#define NEEDED       "install the Debian package libavif16 (libavif15 in Debian 12)"
#define FUNCTIONS(each)                                                                                                \
    each(avifCodecName) each(avifDecoderCreate) each(avifDecoderSetIOMemory) each(avifDecoderParse)                    \
        each(avifDecoderNextImage) each(avifDecoderDestroy) each(avifRGBImageSetDefaults) each(avifImageYUVToRGB)      \
            each(avifResultToString)

struct library {
    void *handle;
    FUNCTIONS(LIBRARY_MEMBER)
};

static const char *open_library(struct library *avif)
{
    return library_open_functions(&avif->handle, AVIF_LIBRARY, true, LIBRARY_NAMES(FUNCTIONS), "lacks functions");
}

bool avif_is_installed(void)
{
    struct library avif;
    bool found = !open_library(&avif);
    library_close(avif.handle);
    return found;
}

static bool decode(const struct library *avif, avifDecoder *decoder, const struct picture_file *file, lam_image *image,
                   lam_error *error)
{
    avifRGBImage rgb;
    uint32_t width = 0, height = 0;
    size_t own = 0; // planes and reference frames of the decoder, which decodes all pixels in one step
    if (avif->avifCodecName(AVIF_CODEC_CHOICE_AOM, AVIF_CODEC_FLAG_CAN_DECODE))
        decoder->codecChoice = AVIF_CODEC_CHOICE_AOM; // dav1d prints messages about damaged files
    decoder->ignoreExif = decoder->ignoreXMP = AVIF_TRUE;
    decoder->strictFlags = AVIF_STRICT_DISABLED; // as in browsers
    avifResult result = avif->avifDecoderSetIOMemory(decoder, file->bytes, file->size);
    if (result == AVIF_RESULT_OK && (result = avif->avifDecoderParse(decoder)) == AVIF_RESULT_OK) {
        width = decoder->image->width;
        height = decoder->image->height;
        own = (size_t)width * height * (decoder->image->depth > 8 ? 16 : 8);
        if (!picture_make(file, width, height, LAM_RGBA8, image, error) ||
            !picture_step_check(file, width, height, own, error))
            return false;
        result = avif->avifDecoderNextImage(decoder);
    }
    if (result == AVIF_RESULT_OK && (decoder->image->width != width || decoder->image->height != height))
        result = AVIF_RESULT_DECODE_COLOR_FAILED;
    if (result == AVIF_RESULT_OK) {
        avif->avifRGBImageSetDefaults(&rgb, decoder->image);
        rgb.depth = 8;
        rgb.format = AVIF_RGB_FORMAT_RGBA;
        rgb.avoidLibYUV = AVIF_TRUE; // it rounds differently on other processors
        rgb.pixels = image->pixels;
        rgb.rowBytes = 4 * width;
        result = avif->avifImageYUVToRGB(decoder->image, &rgb);
    }
    if (file->call)
        call_refund(file->call, own);
    return result == AVIF_RESULT_OK || fail(error, LAM_CANNOT_READ, "%s: AVIF: the picture is damaged (%s)", file->name,
                                            avif->avifResultToString(result));
}

static bool avif_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    struct library avif;
    const char *fault = open_library(&avif);
    if (fault)
        return fail(error, LAM_UNSUPPORTED, "%s: AVIF needs %s, which %s; " NEEDED, file->name, AVIF_LIBRARY, fault);
    avifDecoder *decoder = avif.avifDecoderCreate();
    bool ok = decoder ? decode(&avif, decoder, file, image, error) : fail_memory(error, sizeof *decoder);
    if (!ok)
        picture_free(file->call, image);
    if (decoder)
        avif.avifDecoderDestroy(decoder);
    library_close(avif.handle);
    return ok;
}

#else

bool avif_is_installed(void) { return false; }

static bool avif_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    (void)image;
    return fail(error, LAM_UNSUPPORTED,
                "%s: this is an AVIF picture, which " REMEDY(
                    "this build does not support; install the Debian package libavif-dev and build again",
                    "this page cannot read; use the program lambent"),
                file->name);
}

#endif

const struct codec codec_avif = {
    .name = "avif", .title = "AVIF", .pixels = LAM_RGBA8, .probe = avif_probe, .read = avif_read};
