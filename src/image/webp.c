// webp.c: WebP, lossy and lossless with alpha, through libwebp, which is opened (dlopen) when a file is at hand and not
// before. Read piece by piece, so that a long decoding can be stopped. Animations are not read.
// https://developers.google.com/speed/webp/docs/riff_container
#include "codec.h"
#include "dynamic_library.h"
#include "fail.h"
#include "little_endian.h"

#include <stdlib.h>
#include <string.h>

enum { RIFF_HEADER = 12, PIECE_BYTES = 1 << 14 };

static bool webp_probe(const uint8_t *bytes, size_t size)
{
    return size >= RIFF_HEADER && memcmp(bytes, "RIFF", 4) == 0 && memcmp(bytes + 8, "WEBP", 4) == 0;
}

#ifdef HAVE_WEBP

#include <webp/decode.h>

#define LIBRARY "libwebp.so.7"
#define NEEDED  "the Debian package libwebp7 has it"

// The functions that are used here: each is a member of struct library with the type of its own declaration.
#define FUNCTIONS(each) each(WebPGetFeaturesInternal) each(WebPINewRGB) each(WebPIUpdate) each(WebPIDelete)

struct library {
    void *handle;
#define MEMBER(name) __typeof__(&name) name;
    FUNCTIONS(MEMBER)
};

static bool open_library(struct library *webp, const char *subject, lam_error *error)
{
    *webp = (struct library){.handle = library_open(LIBRARY, false, NULL)};
    if (!webp->handle)
        return fail(error, LAM_UNSUPPORTED, "%s: WebP needs " LIBRARY ", which is not installed; " NEEDED, subject);
    bool all = true;
#define LOOK_UP(name) all = all && library_find(webp->handle, #name, &webp->name);
    FUNCTIONS(LOOK_UP)
    if (all)
        return true;
    library_close(webp->handle);
    return fail(error, LAM_UNSUPPORTED, "%s: " LIBRARY " lacks functions that libwebp 1.0 has; " NEEDED, subject);
}

static bool fail_status(const struct picture_file *file, int status, lam_error *error)
{
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY:
        return fail_memory(error, file->size);
    case VP8_STATUS_SUSPENDED:
    case VP8_STATUS_NOT_ENOUGH_DATA:
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, within the WebP picture", file->name, file->size);
    case VP8_STATUS_UNSUPPORTED_FEATURE:
        return fail(error, LAM_UNSUPPORTED, "%s: WebP with a feature that libwebp does not know", file->name);
    default:
        return fail(error, LAM_CANNOT_READ, "%s: WebP: the picture is damaged", file->name);
    }
}

// The file piece by piece; after each, all rows that it completes are there.
static bool decode(const struct library *webp, const struct picture_file *file, lam_image *image, lam_error *error)
{
    size_t stride = 4 * (size_t)image->width;
    WebPIDecoder *decoder = webp->WebPINewRGB(MODE_RGBA, image->pixels, stride * (size_t)image->height, (int)stride);
    if (!decoder)
        return fail_memory(error, file->size);
    int status = VP8_STATUS_SUSPENDED;
    bool runs = true;
    for (size_t size = 0; runs && status == VP8_STATUS_SUSPENDED && size < file->size;) {
        size += file->size - size < PIECE_BYTES ? file->size - size : PIECE_BYTES;
        runs = call_should_continue(file->call) || call_error(file->call, error);
        if (runs)
            status = webp->WebPIUpdate(decoder, file->bytes, size);
    }
    webp->WebPIDelete(decoder);
    return runs && (status == VP8_STATUS_OK || fail_status(file, status, error));
}

static bool read_with(const struct library *webp, const struct picture_file *file, lam_image *image, lam_error *error)
{
    WebPBitstreamFeatures features;
    int status = webp->WebPGetFeaturesInternal(file->bytes, file->size, &features, WEBP_DECODER_ABI_VERSION);
    if (status != VP8_STATUS_OK)
        return fail_status(file, status, error);
    if (features.has_animation)
        return fail(error, LAM_UNSUPPORTED, "%s: WebP animation, expected one picture", file->name);
    uint64_t end = 8 + (uint64_t)u32_at(file->bytes + 4);
    if (end > file->size)
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, but its WebP header says byte %llu", file->name,
                    file->size, (unsigned long long)end);
    if (!picture_make(file, (uint32_t)features.width, (uint32_t)features.height, LAM_RGBA8, image, error))
        return false;
    // What libwebp takes itself: all pixels of a lossless picture, and of lossy ones the alpha.
    enum { LOSSLESS = 2 };
    size_t pixels = (size_t)features.width * (size_t)features.height;
    size_t own = features.format == LOSSLESS ? 4 * pixels : features.has_alpha ? 2 * pixels : 0;
    bool ok = !file->call || call_charge(file->call, own) || call_memory_error(file->call, own, error);
    if (ok) {
        ok = decode(webp, file, image, error);
        if (file->call)
            call_refund(file->call, own);
    }
    if (!ok)
        picture_free(file->call, image);
    return ok;
}

static bool webp_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    struct library webp;
    if (!open_library(&webp, file->name, error))
        return false;
    bool ok = read_with(&webp, file, image, error);
    library_close(webp.handle);
    return ok;
}

#else

static bool webp_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    (void)image;
    return fail(error, LAM_UNSUPPORTED, "%s: WebP is not in this build; the Debian package libwebp-dev was missing",
                file->name);
}

#endif

const struct codec codec_webp = {
    .name = "webp", .title = "WebP", .pixels = LAM_RGBA8, .probe = webp_probe, .read = webp_read};
