// check_sheet.c: draws the sheet with the shader's picture, the reference and the difference for each scene.
#include "check.h"

#include <string.h>

#include "drawing.h"

enum { INK = 0x222222, GREY = 0x777777, GOOD = 0x0a7d33, BAD = 0xb3261e, GAP = 12, HEAD = 96, SIDE = 196 };

// Converts floats to bytes without encoding, because a screen shows the output of a shader without encoding.
// Transparent pixels become white, so that the model is visible.
static bool to_bytes(const lam_image *from, lam_image *bytes, lam_error *error)
{
    if (!lam_image_make(bytes, from->width, from->height, LAM_RGBA8, error))
        return false;
    const float *in = from->pixels;
    uint8_t *out = bytes->pixels;
    for (size_t i = 0; i < (size_t)from->width * (size_t)from->height; i++) {
        for (size_t c = 0; c < 3; c++) {
            float x = in[4 * i + c];
            out[4 * i + c] = !(x > 0) ? 0 : x < 1 ? (uint8_t)(x * 255 + 0.5f) : 255;
        }
        bool clear = in[4 * i] == 0 && in[4 * i + 1] == 0 && in[4 * i + 2] == 0 && in[4 * i + 3] == 0;
        if (clear)
            memset(out + 4 * i, 255, 3);
        out[4 * i + 3] = 255;
    }
    return true;
}

static bool put(struct drawing *d, const lam_image *image, int left, int top, lam_error *error)
{
    lam_image bytes;
    if (!to_bytes(image, &bytes, error))
        return false;
    bool ok = draw_image(d, &bytes, left, top, "", error);
    lam_image_free(&bytes);
    return ok;
}

static bool put_difference(struct drawing *d, const lam_check_scene *s, double gain, int left, int top,
                           lam_error *error)
{
    lam_image theirs, reference, where = {0};
    bool a = to_bytes(&s->theirs, &theirs, error), b = a && to_bytes(&s->reference, &reference, error);
    bool ok = b && lam_image_difference(&theirs, &reference, (float)gain, &where, error);
    ok = ok && draw_image(d, &where, left, top, "", error);
    if (a)
        lam_image_free(&theirs);
    if (b)
        lam_image_free(&reference);
    lam_image_free(&where);
    return ok;
}

static void put_words(struct drawing *d, const lam_check_scene *s, int top)
{
    char line[96];
    draw_text(d, (struct point){GAP, top + 20}, 18, ALIGN_LEFT, INK, s->name);
    draw_text(d, (struct point){GAP, top + 42}, 14, ALIGN_LEFT, s->passes ? GOOD : BAD, check_scene_word(s));
    snprintf(line, sizeof line, "largest %.3f", s->maximum);
    draw_text(d, (struct point){GAP, top + 62}, 13, ALIGN_LEFT, GREY, line);
    snprintf(line, sizeof line, "mean %.4f", s->mean);
    draw_text(d, (struct point){GAP, top + 80}, 13, ALIGN_LEFT, GREY, line);
    if (s->looks_like) {
        draw_text(d, (struct point){GAP, top + 100}, 13, ALIGN_LEFT, INK, "looks like");
        draw_text(d, (struct point){GAP, top + 117}, 13, ALIGN_LEFT, INK, s->looks_like);
    }
}

static void put_head(struct drawing *d, const lam_check_report *r, const char *shader, double gain, int size)
{
    char line[256] = "", title[256];
    const char *slash = strrchr(shader, '/');
    snprintf(title, sizeof title, "%.100s: %s", slash ? slash + 1 : shader, lam_check_verdict_name(r->verdict));
    draw_text(d, (struct point){GAP, 32}, 22, ALIGN_LEFT, r->verdict == LAM_CHECK_PASSES ? GOOD : BAD, title);
    for (int i = 0; i < r->finding_count; i++)
        snprintf(line + strlen(line), sizeof line - strlen(line), "%s%.50s", i ? ", " : "", r->findings[i].mistake);
    if (r->verdict == LAM_CHECK_DIFFERS && !r->finding_count)
        snprintf(line, sizeof line, "no known mistake");
    double fits = text_width(d, 15, line) > d->width - 2 * GAP ? 11 : 15;
    draw_text(d, (struct point){GAP, 56}, fits, ALIGN_LEFT, INK, line);
    snprintf(title, sizeof title, "difference × %g", gain);
    const char *heads[] = {"shader", "reference", title};
    for (int i = 0; i < 3; i++)
        draw_text(d, (struct point){SIDE + i * (size + GAP) + size / 2.0, HEAD - 10}, 14, ALIGN_MIDDLE, GREY, heads[i]);
}

bool check_sheet(const lam_check_report *r, const char *shader, const struct options *o, const char *path,
                 lam_error *error)
{
    int size = r->scenes[0].reference.width, row = (size > 124 ? size : 124) + GAP;
    struct drawing d;
    if (!drawing_open(&d, SIDE + 3 * (size + GAP), HEAD + r->scene_count * row, false, !o->captions.no_captions,
                      o->captions.font, error))
        return false;
    put_head(&d, r, shader, o->diff.gain, size);
    bool ok = true;
    for (int i = 0; ok && i < r->scene_count; i++) {
        int top = HEAD + i * row;
        put_words(&d, &r->scenes[i], top);
        ok = put(&d, &r->scenes[i].theirs, SIDE, top, error) &&
             put(&d, &r->scenes[i].reference, SIDE + size + GAP, top, error) &&
             put_difference(&d, &r->scenes[i], o->diff.gain, SIDE + 2 * (size + GAP), top, error);
    }
    ok = ok && drawing_write(&d, path, error);
    drawing_free(&d);
    return ok;
}
