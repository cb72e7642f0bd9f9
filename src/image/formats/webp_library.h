// webp_library.h: libwebp, which webp.c loads, for other encoders.
#ifndef WEBP_LIBRARY_H
#define WEBP_LIBRARY_H

#include <stdbool.h>

// Returns whether WebP pictures can be read here.
bool webp_is_installed(void);

#ifdef HAVE_WEBP

#include "call_control.h"

#include <webp/decode.h>
#include <webp/encode.h>

#define WEBP_LIBRARY "libwebp.so.7"

// The functions that are used here: each is a member of struct webp_library with the type of its own declaration.
#define WEBP_FUNCTIONS(each)                                                                                           \
    each(WebPGetFeaturesInternal) each(WebPINewRGB) each(WebPIUpdate) each(WebPIDelete) each(WebPConfigInitInternal)   \
        each(WebPPictureInitInternal) each(WebPPictureImportRGBA) each(WebPEncode) each(WebPPictureFree)               \
            each(WebPFree)

struct webp_library {
    void *handle; // library_close
#define MEMBER(name) __typeof__(&name) name;
    WEBP_FUNCTIONS(MEMBER)
#undef MEMBER
};

// `file` begins messages; NULL: none does. LAM_UNSUPPORTED.
bool webp_open(struct webp_library *webp, const char *file, lam_error *error);

// Sets up the encoding of an image: starts `call`, which the encoder reports to. LAM_UNSUPPORTED.
bool webp_configure(const struct webp_library *webp, const lam_image *image, const lam_save_params *params,
                    struct call_control *call, WebPConfig *config, WebPPicture *picture, lam_error *error);

// LAM_LIMIT.
bool webp_check_size(int width, int height, lam_error *error);

#endif
#endif
