// settings.c: reads the settings of a picture: its size and colours ("image"), and the rows of the table of settings.
#include "description.h"

#include "fail.h"
#include "linear.h"

#include <stdio.h>
#include <string.h>

static bool read_image(struct reader *r, const json_t *root)
{
    static const char *const keys[] = {"size",  "samples",  "background", "color_mode",
                                       "color", "exposure", "tone",       NULL};
    const json_t *image = json_object_get(root, "image");
    const struct place *place = KEY_OF(NULL, "image");
    lam_picture_settings *s = r->settings;
    int color = LAM_COLOR_SRGB;
    if (!image)
        return true;
    // The colour mode is read first, because it determines how colours are read. Older files use the key `color` for
    // the mode.
    bool mode = json_object_get(image, "color_mode"), former = json_object_get(image, "color");
    if (!json_check_keys(&r->json, place, image, keys))
        return false;
    if (mode && former)
        return json_fail(&r->json, place, "contains both color_mode and color, expected only one");
    if (!json_take_word(&r->json, place, image, mode ? "color_mode" : "color", color_words, &color))
        return false;
    if (mode || former) {
        s->present |= LAM_SETTING_COLOR;
        s->draw.color = (lam_color_mode)color;
        if (!r->source->params->override_color)
            r->color = (lam_color_mode)color;
    }
    const json_t *size = json_object_get(image, "size");
    if (size) {
        double sides[2];
        const struct place *here = KEY_OF(place, "size");
        if (!json_numbers_of(&r->json, here, size, 2, 2, sides, NULL))
            return false;
        for (size_t i = 0; i < 2; i++)
            if (!(sides[i] >= 1 && sides[i] <= 65535) || sides[i] != (double)(int)sides[i])
                return json_fail(&r->json, ELEMENT_OF(here, i), "found %.10g, expected pixels from 1 to 65535",
                                 sides[i]);
        s->width = (int)sides[0];
        s->height = (int)sides[1];
        s->present |= LAM_SETTING_SIZE;
    }
    if (json_object_get(image, "samples")) {
        int n = 0;
        if (!take_whole(r, place, image, "samples", 1, 16, &n))
            return false;
        if (n & (n - 1))
            return json_fail(&r->json, KEY_OF(place, "samples"), "found %d, expected 1, 2, 4, 8 or 16", n);
        s->draw.samples = n;
        s->present |= LAM_SETTING_SAMPLES;
    }
    static const struct {
        const char *key;
        unsigned bit;
    } rows[] = {{"background", LAM_SETTING_BACKGROUND}, {"exposure", LAM_SETTING_EXPOSURE}, {"tone", LAM_SETTING_TONE}};
    struct json_choice tones[LAM_TONE_COUNT + 1] = {0};
    int tone = LAM_TONE_AUTO;
    for (int i = 0; i < LAM_TONE_COUNT; i++)
        tones[i] = (struct json_choice){lam_tone_name((lam_tone)i), i};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        s->present |= json_object_get(image, rows[i].key) ? rows[i].bit : 0;
    if (!take_rgba(r, place, image, "background", &s->draw.background) ||
        !json_take_number(&r->json, place, image, "exposure", -100, 100, &s->draw.exposure) ||
        !json_take_word(&r->json, place, image, "tone", tones, &tone))
        return false;
    s->draw.tone = (lam_tone)tone;
    return true;
}

// Reads a list of keywords and sets one bit for each keyword.
static bool read_words(struct reader *r, const json_t *root, const lam_setting *setting, int *bits)
{
    const json_t *list = json_object_get(root, setting->key);
    char known[160] = "";
    int value;
    bool ok = json_is_array(list);
    *bits = 0;
    for (size_t i = 0; ok && i < json_array_size(list); i++) {
        const char *text = json_string_value(json_array_get(list, i)), *word;
        int at = 0;
        while ((word = setting->word(at, &value)) && (!text || strcmp(word, text) != 0))
            at++;
        ok = word != NULL;
        *bits |= ok ? value : 0;
    }
    const char *word;
    for (int at = 0; (word = setting->word(at, &value)); at++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s\"%s\"", at ? ", " : "", word);
    }
    return ok || json_fail(&r->json, KEY_OF(NULL, setting->key), "expected a list of some of %s", known);
}

// Reads the setting of one row of the table.
static bool read_setting(struct reader *r, const json_t *root, const lam_setting *setting)
{
    void *member = (char *)&r->settings->draw + setting->offset;
    switch (setting->type) {
    case LAM_SETTING_WORD: {
        struct json_choice words[17] = {0};
        for (int i = 0; i < 16 && (words[i].name = setting->word(i, &words[i].value)); i++)
            ;
        return json_take_word(&r->json, NULL, root, setting->key, words, member);
    }
    case LAM_SETTING_FLAG:
        return json_take_bool(&r->json, NULL, root, setting->key, member);
    case LAM_SETTING_RGB:
        return take_rgb(r, NULL, root, setting->key, member);
    case LAM_SETTING_RGBA:
        return take_rgba(r, NULL, root, setting->key, member);
    case LAM_SETTING_WORDS:
        return read_words(r, root, setting, member);
    case LAM_SETTING_ANGLE: {
        double angle = 0;
        if (!json_take_number(&r->json, NULL, root, setting->key, setting->min, setting->max, &angle))
            return false;
        *(float *)member = (float)math_radians(angle);
        return true;
    }
    case LAM_SETTING_NOT_FLAG: {
        bool on = true;
        if (!json_take_bool(&r->json, NULL, root, setting->key, &on))
            return false;
        *(bool *)member = !on;
        return true;
    }
    case LAM_SETTING_WHOLE:
    case LAM_SETTING_NUMBER:
        break;
    }
    double number = 0, min = setting->zero ? 0 : setting->min;
    int whole = 0;
    bool is_whole = setting->type == LAM_SETTING_WHOLE;
    if (!(is_whole ? take_whole(r, NULL, root, setting->key, (int)min, (int)setting->max, &whole)
                   : json_take_number(&r->json, NULL, root, setting->key, min, setting->max, &number)))
        return false;
    number = is_whole ? whole : number;
    if (number != 0 && number < setting->min)
        return json_fail(&r->json, KEY_OF(NULL, setting->key), "found %.10g, expected 0 or at least %.10g", number,
                         setting->min);
    if (is_whole)
        *(int *)member = whole;
    else
        *(float *)member = number == 0 && setting->zero_is_negative ? -1.0f : (float)number;
    return true;
}

// Lighting per vertex implies Gouraud shading, unless the file sets another method.
static bool check_stage(struct reader *r)
{
    lam_picture_settings *s = r->settings;
    uint64_t shading = UINT64_C(1) << lam_draw_setting_find("shading");
    bool by_vertex = s->draw.stage == LAM_STAGE_APPLICATION || s->draw.stage == LAM_STAGE_VERTEX;
    if (by_vertex && !(s->draw_present & shading)) {
        s->draw.shading = LAM_SHADING_GOURAUD;
        s->draw_present |= shading;
    }
    if (by_vertex && s->draw.shading == LAM_SHADING_PHONG)
        return json_fail(&r->json, KEY_OF(NULL, "stage"),
                         "Phong shading needs the stage fragment; application and vertex work with flat and gouraud");
    if (s->draw.stage == LAM_STAGE_FRAGMENT && s->draw.shading == LAM_SHADING_GOURAUD)
        return json_fail(&r->json, KEY_OF(NULL, "stage"),
                         "Gouraud shading needs the stage application or vertex; fragment works with flat and phong");
    return true;
}

bool read_settings(struct reader *r, const json_t *root)
{
    if (!read_image(r, root))
        return false;
    for (int i = 0; lam_draw_setting(i); i++) {
        const lam_setting *setting = lam_draw_setting(i);
        if (!json_object_get(root, setting->key))
            continue;
        if (!read_setting(r, root, setting))
            return false;
        r->settings->draw_present |= UINT64_C(1) << i;
    }
    return check_stage(r);
}
