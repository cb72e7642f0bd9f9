// animation.h: the interface of formats that store several pictures in one file.
#ifndef ANIMATION_H
#define ANIMATION_H

#include "call_control.h"
#include "pool.h"

#include <lambent/animation.h>

// Settings of all frames.
struct animation_settings {
    int width, height;
    double frames_per_second;
    int loops;              // 0 means forever
    lam_save_params frames; // `control` is not set
};

struct animation_codec {
    // Returns the writer's state, or NULL and fills the error.
    void *(*start)(const struct animation_settings *settings, lam_error *error);

    // Adds a picture in RGBA8 without padding, of the size in the settings. `params` are the settings, with the control
    // of this call. `pool` may be NULL, and does not affect the bytes.
    bool (*add)(void *state, const lam_image *frame, const lam_save_params *params, struct pool *pool,
                lam_error *error);

    // Makes the bytes of the file. This function is called once, after at least one frame.
    bool (*finish)(void *state, const lam_save_params *params, lam_bytes *out, lam_error *error);

    // Returns the size in bytes of the encoded frames that the writer keeps. For WebP, returns the size of the
    // encoder's canvases, because libwebpmux does not report the size of its frames.
    uint64_t (*held)(const void *state);

    void (*free)(void *state);
};

extern const struct animation_codec animation_png, animation_webp, animation_gif;

#endif
