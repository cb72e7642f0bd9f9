// shader_constants.c: reads `name = number` and pow(x, number).
#include "shader_constants.h"

#include <string.h>

#include "linear.h"
#include "number.h"

static bool is(const struct declarations *d, int i, const char *text)
{
    return i >= 0 && i < d->word_count && strcmp(d->words[i].text, text) == 0;
}

// Reads a number with its sign and moves past it. False: there is none.
static bool read_number(const struct declarations *d, int *at, double *out)
{
    bool minus = is(d, *at, "-");
    int i = *at + minus;
    const char *text = i < d->word_count ? d->words[i].text : "";
    size_t length = strcspn(text, "fF");
    const uint8_t *end = (const uint8_t *)text + length;
    if (!strchr("0123456789.", text[0]) || !length || number_double((const uint8_t *)text, end, out) != end)
        return false;
    *out = minus ? -*out : *out;
    *at = i + 1;
    return true;
}

// Reads a number, vec3(a), vec3(a, b, c), or normalize() of one of these, up to `;`.
static bool read_value(const struct declarations *d, int at, double out[3])
{
    bool unit = is(d, at, "normalize") && is(d, at + 1, "(");
    at += unit ? 2 : 0;
    if (is(d, at, "vec3") && is(d, at + 1, "(")) {
        at += 2;
        int count = 0;
        do
            if (!read_number(d, &at, &out[count]))
                return false;
        while (++count < 3 && is(d, at, ",") && at++);
        if ((count != 1 && count != 3) || !is(d, at++, ")"))
            return false;
        if (count == 1)
            out[1] = out[2] = out[0];
    } else {
        if (!read_number(d, &at, &out[0]))
            return false;
        out[1] = out[2] = out[0];
    }
    lam_vec3 v = v3_unit(v3(out[0], out[1], out[2]));
    if (unit)
        memcpy(out, (const double[]){v.x, v.y, v.z}, 3 * sizeof *out);
    return is(d, at + unit, ";") && (!unit || is(d, at, ")"));
}

// The number in pow(x, number): the second argument, alone.
static bool read_exponent(const struct declarations *d, int at, double *out)
{
    int depth = 0;
    for (int i = at + 1; i < d->word_count; i++) {
        depth += is(d, i, "(") - is(d, i, ")");
        if (depth == 0)
            return false;
        if (depth == 1 && is(d, i, ",")) {
            i++;
            return read_number(d, &i, out) && is(d, i, ")");
        }
    }
    return false;
}

static bool find_value(const struct declarations *d, const char *name, double out[3])
{
    for (int i = 0; i + 2 < d->word_count; i++) {
        if (!is(d, i, name) || d->words[i].is_member)
            continue;
        if (strcmp(name, "pow") == 0 ? read_exponent(d, i, &out[0]) : is(d, i + 1, "=") && read_value(d, i + 2, out))
            return true;
    }
    return false;
}

static void set_color(struct default_color *color, const double v[3])
{
    *color = (struct default_color){COLOR_GIVEN, {(float)v[0], (float)v[1], (float)v[2]}};
}

static void set(struct contract_defaults *d, enum uniform_semantic semantic, const double v[3])
{
    struct default_number number = {true, (float)v[0]};
    switch (semantic) {
    case SEMANTIC_KA:
        d->ambient_strength = number;
        break;
    case SEMANTIC_KD:
        d->diffuse_strength = number;
        break;
    case SEMANTIC_KS:
        d->specular_strength = number;
        break;
    case SEMANTIC_SHININESS:
        d->shininess = number;
        break;
    case SEMANTIC_COLOR:
        set_color(&d->diffuse_color, v);
        break;
    case SEMANTIC_SPECULAR_COLOR:
        set_color(&d->specular_color, v);
        break;
    case SEMANTIC_LIGHT_COLOR:
        set_color(&d->light_color, v);
        break;
    case SEMANTIC_LIGHT_SPECULAR:
        set_color(&d->light_specular, v);
        break;
    case SEMANTIC_LIGHT_AMBIENT:
    case SEMANTIC_AMBIENT_LIGHT:
        set_color(&d->light_ambient, v);
        break;
    default: // SEMANTIC_LIGHT_DIRECTION
        d->direction = (lam_vec3){v[0], v[1], v[2]};
        d->has_direction = v[0] != 0 || v[1] != 0 || v[2] != 0;
    }
}

void shader_constants_find(struct shader_interface *r)
{
    r->constants = 0;
    r->defaults = r->contract->defaults;
    for (const struct contract_constant *c = r->contract->constants; c->name; c++) {
        double v[3];
        if (find_value(&r->fragment, c->name, v) || find_value(&r->vertex, c->name, v)) {
            set(&r->defaults, c->semantic, v);
            r->constants |= (uint64_t)1 << c->semantic;
        }
    }
}
