// width.c: the functions and equations at one width. It is compiled once for each width; the build defines LANES,
// WIDTH_NAME and WIDTH_FEATURES.
#include "widths.h"

#include "cpu_features.h"
#include "encoding.h"
#include "lighting.h"

static num apply_one(enum function function, num a, num b)
{
    switch (function) {
    case FUNCTION_EXP2:
        return exp2_of(a);
    case FUNCTION_LOG2:
        return log2_of(a);
    case FUNCTION_POWER:
        return power(a, b);
    case FUNCTION_UNIT_POWER:
        return unit_power(a, b);
    case FUNCTION_INVERSE_ROOT:
        return rsqrt(a);
    case FUNCTION_ROOT:
        return square_root(a);
    case FUNCTION_SRGB_ENCODE:
        return srgb_encode(a);
    case FUNCTION_SRGB_DECODE:
        return srgb_decode(a);
    case FUNCTION_BYTE:
        return num_of_int(byte_of(a));
    case FUNCTION_SATURATE:
        return saturate(a);
    case FUNCTION_LESSER:
        return min_of(a, b);
    case FUNCTION_GREATER:
        return max_of(a, b);
    case FUNCTION_COUNT:
        break;
    }
    return num_of(0);
}

static void apply(enum function function, const float *a, const float *b, float *out, int count)
{
    for (int i = 0; i < count; i += LANES)
        num_store(out + i, apply_one(function, num_load(a + i), num_load(b + i)));
}

static vec3 load3(const float *const in[], int at, int i)
{
    return vec3_of(num_load(in[at] + i), num_load(in[at + 1] + i), num_load(in[at + 2] + i));
}

static void store3(float *const out[], int at, int i, vec3 v)
{
    num_store(out[at] + i, v.x);
    num_store(out[at + 1] + i, v.y);
    num_store(out[at + 2] + i, v.z);
}

static void light(const struct modes *modes, const float *const in[INPUTS], float *const out[OUTPUTS], int count)
{
    for (int i = 0; i < count; i += LANES) {
        surface s =
            surface_at(load3(in, IN_POINT, i), load3(in, IN_NORMAL, i), load3(in, IN_TANGENT, i), modes->viewer);
        light_source l;
        l.position = load3(in, IN_POSITION, i);
        l.direction = load3(in, IN_DIRECTION, i);
        l.diffuse = load3(in, IN_DIFFUSE, i);
        l.specular = load3(in, IN_SPECULAR, i);
        l.constant = num_load(in[IN_CONSTANT] + i);
        l.linear = num_load(in[IN_LINEAR] + i);
        l.quadratic = num_load(in[IN_QUADRATIC] + i);
        l.inverse_range = num_load(in[IN_INVERSE_RANGE] + i);
        l.cos_cutoff = num_load(in[IN_COS_CUTOFF] + i);
        l.exponent = num_load(in[IN_EXPONENT] + i);
        l.cos_outer = num_load(in[IN_COS_OUTER] + i);
        l.inverse_width = num_load(in[IN_INVERSE_WIDTH] + i);
        lobe_parameters m;
        int parameter = IN_PARAMETERS;
#define TAKE(name, ...) m.name = num_load(in[parameter++] + i);
        LOBE_PARAMETERS(TAKE)
        m.fibre = num_of((float)modes->fibre);
        hemisphere h = {load3(in, IN_UP, i), load3(in, IN_SKY, i), load3(in, IN_GROUND, i)};

        light_sample t = toward_light(s.p, l, modes->kind, modes->falloff);
        lobe_value r = reflect_light(s, t.l, m, modes->model);
        store3(out, OUT_L, i, t.l);
        num_store(out[OUT_DISTANCE] + i, t.distance);
        num_store(out[OUT_ATTENUATION] + i, t.attenuation);
        num_store(out[OUT_SPOT] + i, t.spot);
        num_store(out[OUT_D] + i, r.diffuse);
        num_store(out[OUT_S] + i, r.specular);
        num_store(out[OUT_N_DOT_L] + i, r.n_dot_l);
        num_store(out[OUT_BASE] + i, r.base);

        terms sum = start_terms(load3(in, IN_AMBIENT, i), load3(in, IN_EMISSION, i));
        sum = add_hemisphere(sum, s, h);
        if (lobe_properties(modes->model) & LOBE_TONED)
            l = with_tone(l, s.n, t.l);
        sum = add_reflected(sum, l, t, r);
        sum = tint_terms(sum, load3(in, IN_TINT, i));
        sum = add_environment(sum, load3(in, IN_MIRROR, i), load3(in, IN_ENVIRONMENT, i));
        store3(out, OUT_AMBIENT, i, sum.ambient);
        store3(out, OUT_DIFFUSE, i, sum.diffuse);
        store3(out, OUT_SPECULAR, i, sum.specular);
        store3(out, OUT_REFLECTION, i, sum.reflection);
        store3(out, OUT_SUM, i, sum_terms(sum));
    }
}

static void environment(int viewer, const float *const in[INPUTS], float *const out[ENVIRONMENT_OUTPUTS], int count)
{
    for (int i = 0; i < count; i += LANES) {
        surface s = surface_at(load3(in, IN_POINT, i), load3(in, IN_NORMAL, i), load3(in, IN_TANGENT, i), viewer);
        lobe_parameters m;
        int parameter = IN_PARAMETERS;
        LOBE_PARAMETERS(TAKE)
        vec3 base = load3(in, IN_TINT, i), l = unit3(sub3(load3(in, IN_POSITION, i), s.p));
        num n_dot_v = eye_cosine(s);
        fresnel f = fresnel_of(base, m.metallic, scattering_gain(s, m.roughness));
        light_source white = {.specular = vec3_of(num_of(1.0f), num_of(1.0f), num_of(1.0f))};
        store3(out, OUT_FRESNEL, i, with_fresnel(white, f, s.v, l).specular);
        surroundings e = {load3(in, IN_SKY, i), load3(in, IN_GROUND, i), single_scattering(n_dot_v, m.roughness),
                          schlick_scattering(n_dot_v, m.roughness)};
        vec3 kd = scale3(base, 1.0f - m.metallic);
        returned_light whole = surroundings_light(f, kd, e);
        returned_light alone = surroundings_light(fresnel_of(base, m.metallic, num_of(0.0f)), kd, e);
        store3(out, OUT_SPLIT_SUM, i, add3(whole.diffuse, whole.specular));
        store3(out, OUT_SPLIT_ALONE, i, add3(alone.diffuse, alone.specular));
    }
}
#undef TAKE

static void gather(const float *from, const uint32_t *at, int stride, float *const out[3], int count)
{
    for (int i = 0; i < count; i += LANES) {
        num columns[3];
        gather3(from, at + i, stride, columns);
        for (int k = 0; k < 3; k++)
            num_store(out[k] + i, columns[k]);
    }
}

extern const struct width WIDTH_NAME;

#define TEXT(x)  TEXT_(x)
#define TEXT_(x) #x
const struct width WIDTH_NAME = {TEXT(WIDTH_NAME), WIDTH_FEATURES, apply, light, environment, gather};
