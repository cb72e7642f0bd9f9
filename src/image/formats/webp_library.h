// webp_library.h: libwebp, loaded by webp.c, for other encoders.
#ifndef WEBP_LIBRARY_H
#define WEBP_LIBRARY_H

#include <stdbool.h>

// Returns whether this machine can read WebP pictures.
bool webp_is_installed(void);

#ifdef HAVE_WEBP

#include "call_control.h"

#include <webp/decode.h>
#include <webp/encode.h>

#define WEBP_LIBRARY "libwebp.so.7"

// The functions that Lambent uses; each is a member of struct webp_library with the type of its declaration.
#define WEBP_FUNCTIONS(each)                                                                                           \
    each(WebPGetFeaturesInternal) each(WebPINewRGB) each(WebPIUpdate) each(WebPIDelete) each(WebPConfigInitInternal)   \
        each(WebPPictureInitInternal) each(WebPPictureImportRGBA) each(WebPEncode) each(WebPPictureFree)               \
            each(WebPFree)

struct webp_library {
    void *handle; // the handle for library_close
#define MEMBER(name) __typeof__(&name) name;
    WEBP_FUNCTIONS(MEMBER)
#undef MEMBER
};

// Opens libwebp. Messages begin with `file`, unless it is NULL. Fails with LAM_UNSUPPORTED.
bool webp_open(struct webp_library *webp, const char *file, lam_error *error);

// Sets up the encoding of an image and starts `call`, to which the encoder reports. Fails with LAM_UNSUPPORTED.
bool webp_configure(const struct webp_library *webp, const lam_image *image, const lam_save_params *params,
                    struct call_control *call, WebPConfig *config, WebPPicture *picture, lam_error *error);

// Fails with LAM_LIMIT.
bool webp_check_size(int width, int height, lam_error *error);

#endif
#endif
