// shader_constants.c: reads `name = number` and pow(x, number).
#include "shader_interface.h"

#include <string.h>

#include "linear.h"

// Parses vec3(a) or vec3(a, b, c), and advances *at past it.
static bool read_vector(const struct declarations *d, int *at, double out[3])
{
    if (!word_is(d, *at, "vec3") || !word_is(d, *at + 1, "("))
        return false;
    int i = *at + 2, count = 0;
    do
        if (!word_take_number(d, &i, &out[count]))
            return false;
    while (++count < 3 && word_is(d, i, ",") && i++);
    if (count == 1)
        out[1] = out[2] = out[0];
    if ((count != 1 && count != 3) || !word_is(d, i, ")"))
        return false;
    *at = i + 1;
    return true;
}

// Parses a number, vec3(a), vec3(a, b, c), or normalize() of one of these. A `;` or the next name must follow.
static bool read_value(const struct declarations *d, int at, double out[3])
{
    bool unit = word_is(d, at, "normalize") && word_is(d, at + 1, "(");
    at += unit ? 2 : 0;
    if (!read_vector(d, &at, out)) {
        if (!word_take_number(d, &at, &out[0]))
            return false;
        out[1] = out[2] = out[0];
    }
    lam_vec3 v = v3_unit(v3(out[0], out[1], out[2]));
    if (unit)
        memcpy(out, (const double[]){v.x, v.y, v.z}, 3 * sizeof *out);
    return (word_is(d, at + unit, ";") || word_is(d, at + unit, ",")) && (!unit || word_is(d, at, ")"));
}

// Parses the number in pow(x, number), if the second argument is only a number.
static bool read_exponent(const struct declarations *d, int at, double *out)
{
    int depth = 0;
    for (int i = at + 1; i < d->word_count; i++) {
        depth += word_is(d, i, "(") - word_is(d, i, ")");
        if (depth == 0)
            return false;
        if (depth == 1 && word_is(d, i, ",")) {
            i++;
            return word_take_number(d, &i, out) && word_is(d, i, ")");
        }
    }
    return false;
}

// Finds the exponent of a highlight: the largest constant exponent in the calls of pow(). Smaller exponents, such as 2,
// have other meanings.
static bool find_exponent(const struct declarations *d, double *out)
{
    bool found = false;
    double number;
    for (int i = 0; i + 2 < d->word_count; i++)
        if (word_is(d, i, "pow") && !d->words[i].is_member && read_exponent(d, i, &number) &&
            (!found || number > *out)) {
            *out = number;
            found = true;
        }
    return found;
}

static bool find_value(const struct declarations *d, const char *name, double out[3])
{
    if (strcmp(name, "pow") == 0)
        return find_exponent(d, &out[0]);
    for (int i = 0; i + 2 < d->word_count; i++)
        if (word_is(d, i, name) && !d->words[i].is_member && word_is(d, i + 1, "=") && read_value(d, i + 2, out))
            return true;
    return false;
}

static void set_color(struct default_color *color, const double v[3])
{
    *color = (struct default_color){COLOR_GIVEN, {(float)v[0], (float)v[1], (float)v[2]}};
}

static void set_constant(struct shader_interface *r, enum uniform_semantic semantic, const double v[3])
{
    struct contract_defaults *d = &r->defaults;
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
    case SEMANTIC_ATTENUATION_CONSTANT:
    case SEMANTIC_ATTENUATION_LINEAR:
    case SEMANTIC_ATTENUATION_QUADRATIC:
        d->has_attenuation = true;
        d->attenuation[semantic - SEMANTIC_ATTENUATION_CONSTANT] = number.value;
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
            set_constant(r, c->semantic, v);
            r->constants |= (uint64_t)1 << c->semantic;
        }
    }
}

static uint64_t mix(uint64_t hash, double number) // FNV-1a, one number at a time
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    return (hash ^ bits ^ bits >> 29) * 1099511628211u;
}

uint64_t shader_constants_hash(const struct shader_interface *r)
{
    const struct contract_defaults *d = &r->defaults;
    const struct default_color *const colors[] = {&d->ambient_color, &d->diffuse_color,  &d->specular_color,
                                                  &d->light_color,   &d->light_specular, &d->light_ambient};
    const struct default_number *const numbers[] = {&d->ambient_strength, &d->diffuse_strength, &d->specular_strength,
                                                    &d->shininess, &d->spot_exponent};
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < sizeof colors / sizeof *colors; i++) {
        hash = mix(hash, colors[i]->source);
        hash = mix(mix(mix(hash, (double)colors[i]->value.r), (double)colors[i]->value.g), (double)colors[i]->value.b);
    }
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        hash = mix(mix(hash, numbers[i]->given), (double)numbers[i]->value);
    for (int i = 0; i < 3; i++)
        hash = mix(hash, (double)d->attenuation[i]);
    hash = mix(mix(hash, d->has_attenuation), d->has_direction);
    return mix(mix(mix(hash, d->direction.x), d->direction.y), d->direction.z);
}
