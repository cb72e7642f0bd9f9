// lambent/animation.h: writes animations: several pictures in one file.
#ifndef LAMBENT_ANIMATION_H
#define LAMBENT_ANIMATION_H

#include "image.h"

#ifdef __cplusplus
extern "C" {
#endif

// An animation that is being encoded. The animation stores the last frame and the encoded frames, not the earlier
// pictures. Only one thread at a time may use an animation.
typedef struct lam_animation lam_animation;

// Parameters of an animation. If all fields are zero, the defaults apply.
typedef struct lam_animation_params {
    double frames_per_second; // 0.1..240; 0: 24
    int loops;                // number of repetitions, 0..65535; 0: forever
    // The encoding of each frame, as for lam_image_save; its `control` is ignored. NULL: the defaults.
    const lam_save_params *frames;
    LAM_RESERVED(8);
} lam_animation_params;

// Returns the format of an animation file by its extension: "png" (animated PNG; programs without support for animation
// show its first frame), "webp" or "gif" (255 colours per frame, at most 50 frames per second). Returns NULL if the extension belongs to no animation format.
LAM_API const char *lam_animation_format(const char *path);

// Begins an animation of pictures of width × height pixels in one of these formats. `params` may be NULL; the call
// copies them. The caller frees the animation. Returns NULL on failure: LAM_BAD_ARGUMENT, LAM_UNSUPPORTED (another
// format; WebP if libwebp or libwebpmux is missing), LAM_LIMIT.
LAM_API lam_animation *lam_animation_make(const char *format, int width, int height, const lam_animation_params *params,
                                          lam_error *error);

// Encodes the next frame, with 8 bits per channel and the size of the animation. PNG and WebP store only the smallest
// rectangle that contains all changes since the previous frame. `control` may be NULL; its memory limit includes the encoded
// frames of a PNG and the encoder's canvases of a WebP. Fails with LAM_BAD_ARGUMENT, LAM_LIMIT or LAM_CANCELLED; after
// a failure the animation can only be freed.
LAM_API bool lam_animation_add(lam_animation *animation, const lam_image *frame, const lam_control *control,
                               lam_error *error);

// Ends the animation, which needs at least one frame, and encodes its file; the caller frees the bytes. A PNG
// (LAM_COMPRESS_FAST) or a GIF is identical on every machine; a WebP depends on the version of its library. Later calls fail. Fails
// with LAM_BAD_ARGUMENT, LAM_LIMIT or LAM_CANCELLED.
LAM_API bool lam_animation_finish(lam_animation *animation, const lam_control *control, lam_bytes *out,
                                  lam_error *error);

LAM_API void lam_animation_free(lam_animation *animation); // NULL is allowed

#ifdef __cplusplus
}
#endif
#endif
