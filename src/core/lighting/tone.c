// tone.c: the names and formulas of the tone curves, and their application to a single colour.
#define LANES 1
#include "lighting.h"

#include "float_state.h"

static const char *const names[LAM_TONE_COUNT] = {[LAM_TONE_AUTO] = "auto",
                                                  [LAM_TONE_NONE] = "none",
#define TONE(NAME, function, word, ...) [LAM_TONE_##NAME] = (word),
                                                  TONES(TONE)
#undef TONE
};

const char *lam_tone_name(lam_tone tone) { return (unsigned)tone < LAM_TONE_COUNT ? names[tone] : NULL; }

const char *lam_tone_formula(lam_tone tone)
{
    switch (tone) {
#define TONE(NAME, function, word, formula)                                                                            \
    case LAM_TONE_##NAME:                                                                                              \
        return formula;
        TONES(TONE)
#undef TONE
    default:
        return "x";
    }
}

lam_rgb lam_tone_apply(lam_tone tone, lam_rgb color)
{
    uint64_t state = float_state_enter();
    vec3 c = tone_color(vec3_of(color.r, color.g, color.b), (int)tone);
    float_state_leave(state);
    return (lam_rgb){c.x, c.y, c.z};
}
