// webp.c: reads and writes WebP files, lossy and lossless, with alpha. This file uses the library libwebp, which is
// loaded on demand (dlopen). Files are read chunk by chunk, so that a call can stop during a long decoding.
// Animations are not supported. The written bytes depend on the version of libwebp.
// https://developers.google.com/speed/webp/docs/riff_container
#include "codec.h"
#include "dynamic_library.h"
#include "fail.h"
#include "remedy.h"
#include "little_endian.h"
#include "webp_library.h"

#include <stdlib.h>
#include <string.h>

enum {
    RIFF_HEADER = 12,
    CHUNK_BYTES = 1 << 14, // bytes per step; fewer if these bytes contain more than CHUNK_PIXELS pixels on average
    CHUNK_PIXELS = 1 << 22,
};

static bool webp_probe(const uint8_t *bytes, size_t size)
{
    return size >= RIFF_HEADER && memcmp(bytes, "RIFF", 4) == 0 && memcmp(bytes + 8, "WEBP", 4) == 0;
}

#ifdef HAVE_WEBP

#define NEEDED "install the Debian package libwebp7"

bool webp_open(struct webp_library *webp, const char *file, lam_error *error)
{
    const char *name = file ? file : "", *colon = file ? ": " : "";
    const char *fault = library_open_functions(&webp->handle, WEBP_LIBRARY, false, LIBRARY_NAMES(WEBP_FUNCTIONS),
                                               "lacks functions of libwebp 1.0");
    return !fault ||
           fail(error, LAM_UNSUPPORTED, "%s%sWebP needs " WEBP_LIBRARY ", which %s; " NEEDED, name, colon, fault);
}

bool webp_is_installed(void)
{
    struct webp_library webp;
    if (!webp_open(&webp, NULL, NULL))
        return false;
    library_close(webp.handle);
    return true;
}

// --- reading

static bool fail_status(const struct picture_file *file, int status, lam_error *error)
{
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY:
        return fail_memory(error, file->size);
    case VP8_STATUS_SUSPENDED:
    case VP8_STATUS_NOT_ENOUGH_DATA:
        return fail(error, LAM_CANNOT_READ, "%s: ends at byte %zu, within the WebP picture", file->name, file->size);
    case VP8_STATUS_UNSUPPORTED_FEATURE:
        return fail(error, LAM_UNSUPPORTED, "%s: WebP uses a feature that libwebp does not support", file->name);
    default:
        return fail(error, LAM_CANNOT_READ, "%s: WebP: the picture is damaged", file->name);
    }
}

// Decodes the file chunk by chunk. After each chunk, all completed rows are available.
static bool decode(const struct webp_library *webp, const struct picture_file *file, lam_image *image, lam_error *error)
{
    size_t stride = 4 * (size_t)image->width;
    WebPIDecoder *decoder = webp->WebPINewRGB(MODE_RGBA, image->pixels, stride * (size_t)image->height, (int)stride);
    if (!decoder)
        return fail_memory(error, file->size);
    int status = VP8_STATUS_SUSPENDED;
    bool runs = true;
    double bytes_of_pixel = (double)file->size / ((double)image->width * image->height);
    double even = bytes_of_pixel * CHUNK_PIXELS;
    size_t chunk = even < 1 ? 1 : even < CHUNK_BYTES ? (size_t)even : CHUNK_BYTES;
    for (size_t size = 0; runs && status == VP8_STATUS_SUSPENDED && size < file->size;) {
        size += file->size - size < chunk ? file->size - size : chunk;
        runs = call_should_continue(file->call) || call_error(file->call, error);
        if (runs)
            status = webp->WebPIUpdate(decoder, file->bytes, size);
    }
    webp->WebPIDelete(decoder);
    return runs && (status == VP8_STATUS_OK || fail_status(file, status, error));
}

static bool read_with(const struct webp_library *webp, const struct picture_file *file, lam_image *image,
                      lam_error *error)
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
    // libwebp decodes all pixels of a lossless picture, or the alpha of a lossy picture, in one step, with memory for
    // these pixels. Version 1.2 may dereference a null pointer if an allocation fails.
    enum { LOSSLESS = 2 };
    size_t own = (size_t)features.width * (size_t)features.height *
                 (features.format == LOSSLESS ? 4
                  : features.has_alpha        ? 2
                                              : 0);
    if (!picture_make(file, (uint32_t)features.width, (uint32_t)features.height, LAM_RGBA8, image, error))
        return false;
    bool ok = picture_step_check(file, (uint32_t)features.width, (uint32_t)features.height, own, error);
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
    struct webp_library webp;
    if (!webp_open(&webp, file->name, error))
        return false;
    bool ok = read_with(&webp, file, image, error);
    library_close(webp.handle);
    return ok;
}

// --- writing

bool webp_check_size(int width, int height, lam_error *error)
{
    return (width <= WEBP_MAX_DIMENSION && height <= WEBP_MAX_DIMENSION) ||
           fail(error, LAM_LIMIT, "WebP: a picture of %d×%d pixels, expected at most %d on a side", width, height,
                WEBP_MAX_DIMENSION);
}

struct sink {
    uint8_t *bytes; // allocated with malloc
    size_t size, capacity;
    bool full; // memory ran out
};

static int write_sink(const uint8_t *bytes, size_t size, const WebPPicture *picture)
{
    struct sink *sink = picture->custom_ptr;
    if (size > sink->capacity - sink->size) {
        size_t capacity = 2 * sink->capacity > sink->size + size ? 2 * sink->capacity : sink->size + size;
        uint8_t *larger = realloc(sink->bytes, capacity);
        sink->full = !larger;
        if (!larger)
            return 0;
        sink->bytes = larger;
        sink->capacity = capacity;
    }
    memcpy(sink->bytes + sink->size, bytes, size);
    sink->size += size;
    return 1;
}

static int report_progress(int percent, const WebPPicture *picture)
{
    (void)percent;
    return call_should_continue(picture->user_data);
}

static bool fail_encoding(const WebPPicture *picture, const struct sink *sink, lam_error *error)
{
    struct call_control *call = picture->user_data;
    if (!call_should_continue(call))
        return call_error(call, error);
    if (sink->full || picture->error_code == VP8_ENC_ERROR_OUT_OF_MEMORY ||
        picture->error_code == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY)
        return fail_memory(error, 4 * (size_t)picture->width * (size_t)picture->height);
    return fail(error, LAM_LIMIT, "WebP: libwebp cannot encode %d×%d pixels (its error %d)", picture->width,
                picture->height, (int)picture->error_code);
}

// Configures either lossless encoding, which keeps the colours of fully transparent pixels, or lossy encoding with the
// given quality.
bool webp_configure(const struct webp_library *webp, const lam_image *image, const lam_save_params *params,
                    struct call_control *call, WebPConfig *config, WebPPicture *picture, lam_error *error)
{
    int quality = (int)params->quality;
    if (!webp->WebPConfigInitInternal(config, WEBP_PRESET_DEFAULT, (float)quality, WEBP_ENCODER_ABI_VERSION) ||
        !webp->WebPPictureInitInternal(picture, WEBP_ENCODER_ABI_VERSION))
        return fail(error, LAM_UNSUPPORTED, "WebP: " WEBP_LIBRARY " is not the version that this build requires");
    config->lossless = quality == 0 || quality == 100;
    if (config->lossless)
        config->quality = 75; // the effort of lossless encoding, not a quality
    config->exact = config->lossless;
    picture->use_argb = config->lossless;
    picture->width = image->width;
    picture->height = image->height;
    picture->progress_hook = report_progress;
    picture->user_data = call;
    call_start(call, params->control);
    return true;
}

static bool encode(const struct webp_library *webp, const lam_image *image, const lam_save_params *params,
                   struct sink *sink, lam_error *error)
{
    WebPConfig config;
    WebPPicture picture;
    struct call_control call;
    if (!webp_configure(webp, image, params, &call, &config, &picture, error))
        return false;
    picture.writer = write_sink;
    picture.custom_ptr = sink;
    bool ok = (call_should_continue(&call) && webp->WebPPictureImportRGBA(&picture, image->pixels, 4 * image->width) &&
               webp->WebPEncode(&config, &picture)) ||
              fail_encoding(&picture, sink, error);
    webp->WebPPictureFree(&picture);
    return ok;
}

static bool webp_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                       lam_error *error)
{
    (void)pool;
    if (!webp_check_size(image->width, image->height, error))
        return false;
    struct webp_library webp;
    struct sink sink = {0};
    if (!webp_open(&webp, NULL, error))
        return false;
    bool ok = encode(&webp, image, params, &sink, error);
    library_close(webp.handle);
    if (ok)
        *out = (lam_bytes){sink.bytes, sink.size};
    else
        free(sink.bytes);
    return ok;
}

#else

bool webp_is_installed(void) { return false; }

static bool webp_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                       lam_error *error)
{
    (void)image, (void)params, (void)pool, (void)out;
    return fail(
        error, LAM_UNSUPPORTED,
        "this build does not support WebP" REMEDY("; install the Debian package libwebp-dev and build again", ""));
}

static bool webp_read(const struct picture_file *file, lam_image *image, lam_error *error)
{
    (void)image;
    return fail(
        error, LAM_UNSUPPORTED,
        "%s: " REMEDY("this build does not support WebP; install the Debian package libwebp-dev and build again",
                      "is a WebP picture, which this page cannot read; use the program lambent"),
        file->name);
}

#endif

const struct codec codec_webp = {
    .name = "webp",
    .title = "WebP",
    .written = "8 bits, sRGB, with alpha, lossless or lossy; needs libwebp",
    .pixels = LAM_RGBA8,
    .write = webp_write,
    .probe = webp_probe,
    .read = webp_read,
};
