// webp_animation.c: writes animated WebP files with libwebpmux, which is loaded (dlopen) when an animation begins. For
// each frame, the library stores only the changes. The written bytes depend on the version of the library.
#include "animation.h"
#include "dynamic_library.h"
#include "fail.h"
#include "webp_library.h"

#include <stdlib.h>
#include <string.h>

#ifdef HAVE_WEBP

#include <webp/mux.h>

#define LIBRARY "libwebpmux.so.3"
#define NEEDED  "install the Debian package libwebpmux3"

#define FUNCTIONS(each)                                                                                                \
    each(WebPAnimEncoderOptionsInitInternal) each(WebPAnimEncoderNewInternal) each(WebPAnimEncoderAdd)                 \
        each(WebPAnimEncoderAssemble) each(WebPAnimEncoderGetError) each(WebPAnimEncoderDelete)

struct webp_animation {
    struct webp_library webp;
    void *handle;
    FUNCTIONS(LIBRARY_MEMBER)
    struct animation_settings settings;
    WebPAnimEncoder *encoder;
    int count; // number of frames so far
};

static void animation_free(void *state)
{
    struct webp_animation *animation = state;
    if (animation->encoder)
        animation->WebPAnimEncoderDelete(animation->encoder);
    library_close(animation->handle);
    library_close(animation->webp.handle);
    free(animation);
}

static bool open_mux(struct webp_animation *animation, lam_error *error)
{
    const char *fault = library_open_functions(&animation->handle, LIBRARY, false, LIBRARY_NAMES(FUNCTIONS),
                                               "lacks functions of libwebp 1.0");
    return !fault || fail(error, LAM_UNSUPPORTED, "animated WebP needs " LIBRARY ", which %s; " NEEDED, fault);
}

static bool make_encoder(struct webp_animation *animation, lam_error *error)
{
    WebPAnimEncoderOptions options;
    if (!animation->WebPAnimEncoderOptionsInitInternal(&options, WEBP_MUX_ABI_VERSION))
        return fail(error, LAM_UNSUPPORTED, "WebP: " LIBRARY " is not the version that this build requires");
    options.anim_params.loop_count = animation->settings.loops;
    animation->encoder = animation->WebPAnimEncoderNewInternal(animation->settings.width, animation->settings.height,
                                                               &options, WEBP_MUX_ABI_VERSION);
    return animation->encoder ||
           fail_memory(error, (size_t)8 * (size_t)animation->settings.width * (size_t)animation->settings.height);
}

static void *animation_start(const struct animation_settings *settings, lam_error *error)
{
    if (!webp_check_size(settings->width, settings->height, error))
        return NULL;
    struct webp_animation *animation = calloc(1, sizeof *animation);
    if (!animation)
        return fail_memory(error, sizeof *animation), NULL;
    animation->settings = *settings;
    if (webp_open(&animation->webp, NULL, error) && open_mux(animation, error) && make_encoder(animation, error))
        return animation;
    animation_free(animation);
    return NULL;
}

// Returns the start time of a frame in milliseconds, the unit of the format.
static int time_of(const struct webp_animation *animation, int frame)
{
    return (int)(frame * 1000.0 / animation->settings.frames_per_second + 0.5);
}

static bool animation_add(void *state, const lam_image *frame, const lam_save_params *params, struct pool *pool,
                          lam_error *error)
{
    (void)pool;
    struct webp_animation *animation = state;
    struct webp_library *webp = &animation->webp;
    WebPConfig config;
    WebPPicture picture;
    struct call_control call;
    if (!webp_configure(webp, frame, params, &call, &config, &picture, error))
        return false;
    picture.use_argb = 1; // required by the animation encoder
    bool ok =
        call_should_continue(&call) && webp->WebPPictureImportRGBA(&picture, frame->pixels, 4 * frame->width) &&
        animation->WebPAnimEncoderAdd(animation->encoder, &picture, time_of(animation, animation->count), &config);
    if (!ok && !call_should_continue(&call))
        call_error(&call, error);
    else if (!ok)
        fail(error, LAM_LIMIT, "WebP: libwebpmux cannot add frame %d of %d×%d pixels: %.200s", animation->count + 1,
             frame->width, frame->height, animation->WebPAnimEncoderGetError(animation->encoder));
    webp->WebPPictureFree(&picture);
    animation->count++;
    return ok;
}

static bool animation_finish(void *state, const lam_save_params *params, lam_bytes *out, lam_error *error)
{
    (void)params;
    struct webp_animation *animation = state;
    WebPData data = {0};
    if (!animation->WebPAnimEncoderAdd(animation->encoder, NULL, time_of(animation, animation->count), NULL) ||
        !animation->WebPAnimEncoderAssemble(animation->encoder, &data))
        return fail(error, LAM_LIMIT, "WebP: libwebpmux cannot make the animation: %.200s",
                    animation->WebPAnimEncoderGetError(animation->encoder));
    *out = (lam_bytes){malloc(data.size), data.size}; // the library may use another allocator
    if (out->data)
        memcpy(out->data, data.bytes, data.size);
    animation->webp.WebPFree((void *)(uintptr_t)data.bytes);
    return out->data || fail_memory(error, data.size);
}

// Returns the size in bytes of the encoder's three canvases. The encoder reports the size of its encoded frames only
// together with the finished file.
static uint64_t animation_held(const void *state)
{
    const struct webp_animation *animation = state;
    return (uint64_t)3 * 4 * (uint64_t)animation->settings.width * (uint64_t)animation->settings.height;
}

#else

static void *animation_start(const struct animation_settings *settings, lam_error *error)
{
    (void)settings;
    fail(error, LAM_UNSUPPORTED,
         "this build does not support WebP; install the Debian package libwebp-dev and build again");
    return NULL;
}

static bool animation_add(void *state, const lam_image *frame, const lam_save_params *params, struct pool *pool,
                          lam_error *error)
{
    (void)state, (void)frame, (void)params, (void)pool, (void)error;
    return false;
}

static bool animation_finish(void *state, const lam_save_params *params, lam_bytes *out, lam_error *error)
{
    (void)state, (void)params, (void)out, (void)error;
    return false;
}

static void animation_free(void *state) { free(state); }

static uint64_t animation_held(const void *state)
{
    (void)state;
    return 0;
}

#endif

const struct animation_codec animation_webp = {.start = animation_start,
                                               .add = animation_add,
                                               .finish = animation_finish,
                                               .held = animation_held,
                                               .free = animation_free};
