// animation.c: the public interface of animations: checks arguments and calls the codec.
#include "animation.h"
#include "codec.h"
#include "fail.h"
#include "file.h"
#include "float_state.h"
#include "pixels.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *name;
    const struct animation_codec *codec;
} formats[] = {{"png", &animation_png}, {"webp", &animation_webp}, {"gif", &animation_gif}};

struct lam_animation {
    const struct animation_codec *codec;
    struct animation_settings settings;
    void *state;
    int count; // number of frames so far
    bool finished;
};

static int format_index(const char *name)
{
    for (int i = 0; i < (int)(sizeof formats / sizeof *formats); i++)
        if (strcasecmp(formats[i].name, name) == 0)
            return i;
    return -1;
}

const char *lam_animation_format(const char *path)
{
    int index = path ? format_index(path_ending(path)) : -1;
    return index < 0 ? NULL : formats[index].name;
}

static bool check(int width, int height, const lam_animation_params *p, lam_error *error)
{
    if (!check_reserved("lam_animation_params", p, error) || (p->frames && !save_params_check(p->frames, error)))
        return false;
    if (width < 1 || height < 1 || width > 65535 || height > 65535)
        return fail(error, LAM_BAD_ARGUMENT, "animation: %dx%d pixels, expected 1 to 65535 on a side", width, height);
    if (p->frames_per_second != 0 && !(p->frames_per_second >= 0.1 && p->frames_per_second <= 240))
        return fail(error, LAM_BAD_ARGUMENT, "animation: %g frames a second, expected 0.1 to 240",
                    p->frames_per_second);
    if (p->loops < 0 || p->loops > 65535)
        return fail(error, LAM_BAD_ARGUMENT, "animation: %d loops, expected 0 (forever) to 65535", p->loops);
    return true;
}

lam_animation *lam_animation_make(const char *format, int width, int height, const lam_animation_params *params,
                                  lam_error *error)
{
    static const lam_animation_params plain = {0};
    const lam_animation_params *p = params ? params : &plain;
    int index = format ? format_index(format) : -1;
    if (!format)
        return fail(error, LAM_BAD_ARGUMENT, "animation: a format is needed"), NULL;
    if (index < 0) {
        fail(error, LAM_UNSUPPORTED, "animation: '%s' is not a format for animations, expected png, webp or gif",
             format);
        return NULL;
    }
    if (!check(width, height, p, error))
        return NULL;
    lam_animation *animation = calloc(1, sizeof *animation);
    if (!animation)
        return fail_memory(error, sizeof *animation), NULL;
    animation->codec = formats[index].codec;
    animation->settings = (struct animation_settings){
        .width = width,
        .height = height,
        .frames_per_second = p->frames_per_second != 0 ? p->frames_per_second : 24,
        .loops = p->loops,
    };
    if (p->frames)
        animation->settings.frames = *p->frames;
    animation->settings.frames.control = NULL;
    animation->state = animation->codec->start(&animation->settings, error);
    if (!animation->state) {
        free(animation);
        return NULL;
    }
    return animation;
}

static bool check_frame(const lam_animation *animation, const lam_image *frame, lam_error *error)
{
    const struct animation_settings *s = &animation->settings;
    if (animation->finished)
        return fail(error, LAM_BAD_ARGUMENT, "animation: it is finished");
    if (!image_check(frame, "frame", error))
        return false;
    if (format_is_float(frame->format))
        return fail(error, LAM_BAD_ARGUMENT, "frame: floats, expected bytes");
    if (frame->width != s->width || frame->height != s->height)
        return fail(error, LAM_BAD_ARGUMENT, "frame: %dx%d pixels, the animation has %dx%d", frame->width,
                    frame->height, s->width, s->height);
    return true;
}

// Returns whether the memory limit allows another frame. The next frame needs three more buffers, each as large as a
// picture: for the previous picture, the changed rectangle and the encoded rectangle. If the limit does not allow
// another frame, the animation can no longer be used.
static bool check_memory(lam_animation *animation, const lam_control *control, lam_error *error)
{
    struct call_control call;
    const struct animation_settings *s = &animation->settings;
    const uint64_t held = animation->codec->held(animation->state);
    const size_t next = (size_t)12 * (size_t)s->width * (size_t)s->height;
    call_start(&call, control);
    if (call_charge(&call, held) && call_charge(&call, next))
        return true;
    animation->finished = true;
    return call_memory_error(&call, next, error);
}

bool lam_animation_add(lam_animation *animation, const lam_image *frame, const lam_control *control, lam_error *error)
{
    lam_image working;
    if (!animation)
        return fail(error, LAM_BAD_ARGUMENT, "animation: it is NULL");
    if (!check_frame(animation, frame, error) || !check_memory(animation, control, error) ||
        !image_working(frame, &working, error))
        return false;
    lam_save_params params = animation->settings.frames;
    params.control = control;
    uint64_t state = float_state_enter();
    struct pool *pool = encoding_pool(&working, params.threads);
    bool ok = animation->codec->add(animation->state, &working, &params, pool, error);
    pool_free(pool);
    float_state_leave(state);
    lam_image_free(&working);
    animation->count++;
    animation->finished |= !ok;
    return ok;
}

bool lam_animation_finish(lam_animation *animation, const lam_control *control, lam_bytes *out, lam_error *error)
{
    if (!animation || !out)
        return fail(error, LAM_BAD_ARGUMENT, "animation: %s needed",
                    animation ? "a pointer for the bytes is" : "an animation is");
    *out = (lam_bytes){0};
    if (animation->finished || animation->count == 0)
        return fail(error, LAM_BAD_ARGUMENT, "animation: it %s", animation->count ? "is finished" : "has no frame");
    animation->finished = true;
    lam_save_params params = animation->settings.frames;
    params.control = control;
    return animation->codec->finish(animation->state, &params, out, error);
}

void lam_animation_free(lam_animation *animation)
{
    if (!animation)
        return;
    animation->codec->free(animation->state);
    free(animation);
}
