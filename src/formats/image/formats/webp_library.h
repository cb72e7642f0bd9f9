// webp_library.h: provides other encoders with access to libwebp, which webp.c loads.
#ifndef WEBP_LIBRARY_H
#define WEBP_LIBRARY_H

#include <stdbool.h>

// Returns whether this machine can read WebP pictures.
bool webp_is_installed(void);

#ifdef HAVE_WEBP

#include "call_control.h"
#include "dynamic_library.h"

#include <webp/decode.h>
#include <webp/encode.h>

#define WEBP_LIBRARY "libwebp.so.7"

// The functions that Lambent uses. Each function becomes a member of struct webp_library, with the type of its
// declaration.
#define WEBP_FUNCTIONS(each)                                                                                           \
    each(WebPGetFeaturesInternal) each(WebPINewRGB) each(WebPIUpdate) each(WebPIDelete) each(WebPConfigInitInternal)   \
        each(WebPPictureInitInternal) each(WebPPictureImportRGBA) each(WebPEncode) each(WebPPictureFree)               \
            each(WebPFree)

struct webp_library {
    void *handle; // the handle for library_close
    WEBP_FUNCTIONS(LIBRARY_MEMBER)
};

// Opens libwebp. Error messages begin with `file`, unless `file` is NULL. Fails with LAM_UNSUPPORTED.
bool webp_open(struct webp_library *webp, const char *file, lam_error *error);

// Sets up the encoding of an image, and initializes `call`, which then receives the encoder's progress. Fails with
// LAM_UNSUPPORTED.
bool webp_configure(const struct webp_library *webp, const lam_image *image, const lam_save_params *params,
                    struct call_control *call, WebPConfig *config, WebPPicture *picture, lam_error *error);

// Checks that WebP supports the size. Otherwise fails with LAM_LIMIT.
bool webp_check_size(int width, int height, lam_error *error);

#endif
#endif
