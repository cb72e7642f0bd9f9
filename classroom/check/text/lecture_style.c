// lecture_style.c: parses the lecture style's loop over the lights.
#include "shader_interface.h"

#include "reference_scene.h"

#include <stdlib.h>
#include <string.h>

struct range {
    int first, end; // the lights that a condition on `i` selects: `first` to `end` − 1
};

// Parses "i >= 1 && i < 3" or one half of such a condition. Without a condition, all lights are selected. Returns the
// position after the condition.
static int read_condition(const struct declarations *d, int at, struct range *range)
{
    *range = (struct range){0, MAX_SCENE_LIGHTS};
    if (word_is(d, at, "i") && word_is(d, at + 1, ">") && word_is(d, at + 2, "=") && at + 3 < d->word_count) {
        range->first = atoi(d->words[at + 3].text);
        at += 4;
        at += word_is(d, at, "&") && word_is(d, at + 1, "&") ? 2 : 0;
    }
    if (word_is(d, at, "i") && word_is(d, at + 1, "<") && at + 2 < d->word_count) {
        range->end = atoi(d->words[at + 2].text);
        at += 3;
    }
    return at;
}

// Returns the condition of the statement at `at`: "if (i >= 3) spot = …".
static struct range condition_before(const struct declarations *d, int at)
{
    struct range range = {0, MAX_SCENE_LIGHTS};
    int open = at - 1;
    while (word_is(d, at - 1, ")") && open > 0 && !word_is(d, open, "("))
        open--;
    if (word_is(d, at - 1, ")") && word_is(d, open - 1, "if"))
        read_condition(d, open + 1, &range);
    return range;
}

// Returns whether a statement contains the word `a` or `b`.
static bool names(const struct declarations *d, int at, const char *a, const char *b)
{
    for (; at < d->word_count && !word_is(d, at, ";"); at++)
        if (word_is(d, at, a) || word_is(d, at, b))
            return true;
    return false;
}

unsigned lecture_light_rules(const struct declarations *lit)
{
    unsigned kinds[MAX_SCENE_LIGHTS] = {0}, rules = 0;
    bool attenuated = false, found = false, printed = false;
    for (int i = 0; i < lit->word_count; i++) {
        struct range range;
        printed |= word_is(lit, i, "vec3") && word_is(lit, i + 1, "lit") && word_is(lit, i + 2, "(");
        attenuated |= lit->words[i].is_member && word_is(lit, i, "attenuation");
        if (printed && word_is(lit, i, "vec3") && word_is(lit, i + 1, "way") && word_is(lit, i + 2, "=")) {
            int at = read_condition(lit, i + 3, &range);
            bool chosen = word_is(lit, at, "?");
            at += chosen;
            at += word_is(lit, at, "-");
            bool directional = word_is(lit, at, "lights") && word_is(lit, at + 5, "direction");
            for (int k = 0; k < MAX_SCENE_LIGHTS; k++)
                kinds[k] = directional && k >= range.first && k < range.end ? RULE_DIRECTIONAL : RULE_POINT;
            found = true;
        }
        if (found && word_is(lit, i, "spot") && word_is(lit, i + 1, "=") && names(lit, i, "cutoff", "exponent")) {
            range = condition_before(lit, i);
            for (int k = range.first; k < range.end && k < MAX_SCENE_LIGHTS; k++)
                kinds[k] = RULE_SPOT;
        }
    }
    for (int k = 0; found && k < MAX_SCENE_LIGHTS; k++)
        rules |= (kinds[k] | (attenuated && kinds[k] != RULE_DIRECTIONAL ? 0 : RULE_UNATTENUATED))
                 << (RULE_FIRST + RULE_BITS * k);
    return rules;
}

lam_reflection lecture_model(const struct declarations *lit)
{
    bool threads = false, gated = false;
    for (int i = 0; i < lit->word_count; i++) {
        threads |= word_is(lit, i, "float") && word_is(lit, i + 1, "sin_TL");
        gated |= word_is(lit, i, "float") && word_is(lit, i + 1, "faces");
    }
    if (threads)
        return gated ? LAM_REFLECTION_KAJIYA_KAY : LAM_REFLECTION_KAJIYA_KAY_LECTURE;
    for (int i = 0; i < lit->word_count; i++)
        if (word_is(lit, i, "ceil") || (word_is(lit, i, "float") && word_is(lit, i + 1, "w"))) {
            return word_is(lit, i, "ceil") ? LAM_REFLECTION_TOON : LAM_REFLECTION_GOOCH;
        } else if (word_is(lit, i, "vec3") && word_is(lit, i + 2, "=")) {
            if (word_is(lit, i + 1, "R"))
                return LAM_REFLECTION_PHONG;
            if (word_is(lit, i + 1, "H"))
                return LAM_REFLECTION_BLINN_PHONG;
        }
    return LAM_REFLECTION_AUTO;
}

bool lecture_viewer_is_infinite(const struct declarations *lit)
{
    for (int i = 0; i < lit->word_count; i++)
        if (word_is(lit, i, "const") && word_is(lit, i + 1, "vec3") && word_is(lit, i + 2, "V"))
            return true;
    return false;
}
