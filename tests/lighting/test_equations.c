// test_equations.c: compares src/core/lighting with the textbook version in double (textbook.c): random points, then every
// degenerate case in the conventions.
//
// The promise: each term is within 2e-6 + 4e-7·α of its largest value. If a light's own law amplifies the last digits
// of its cosine (a spot's exponent, a narrow cone), that factor is added, as described in docs/lighting.md.

#include "test.h"
#include "points.h"
#include "textbook.h"

#define LANES 1
#include "lighting.h"

#include <lambent/device.h>

static const struct width *plain(void)
{
    const struct width *widths[1];
    assert_int_equal(widths_usable(widths, 1), 1);
    return widths[0];
}

static void point_inputs(const struct points *p, int i, float in[INPUTS])
{
    for (int k = 0; k < INPUTS; k++)
        in[k] = p->in[k][i];
}

// The largest error of each output, relative to the allowed error.
static double worst[OUTPUTS];

static void compare(const struct points *p, const struct modes *m, int i)
{
    float in[INPUTS];
    point_inputs(p, i, in);
    struct textbook t = textbook_light(m, in);
    double alpha = (double)in[IN_SHININESS], lobe = 2e-6 + 4e-7 * alpha, matt = 2e-6, base = 2e-6;
    // If one last digit decides between everything and nothing, either is right. For tangents nearly along the normal,
    // rounding determines the direction; tangents exactly along it have none.
    if (m->model != LAM_REFLECTION_LAMBERT && fabs(t.out[OUT_N_DOT_L]) < 1e-6)
        return;
    if (m->kind == LIGHT_SPOT_CUTOFF && fabs(t.cone_cosine - (double)in[IN_COS_CUTOFF]) < 1e-6)
        return;
    if (lam_reflection_describe((lam_reflection)m->model)->tangents && t.tangent_sine < 0.3 && t.tangent_sine > 0.99e-4)
        return;
    if (m->model == LAM_REFLECTION_TOON && t.step < 1e-4)
        return;
    if ((m->model == LAM_REFLECTION_BLINN_PHONG || m->model == LAM_REFLECTION_TOON) &&
        t.half_length < 0.1) {       // light from straight behind: the remainder of l + v
        lobe *= 0.1 / t.half_length; // consists of the rounding errors of l and v
        base *= 0.1 / t.half_length;
    }

    // S of microfacets has no upper bound, so its relative error counts. Its peak is as narrow as alpha = roughness².
    double S = 1, roughness = fmax((double)in[IN_PARAMETERS + 3], 0.045);
    if (lam_reflection_describe((lam_reflection)m->model)->microfacet) {
        S = fmax(t.out[OUT_S], 1);
        lobe = base = S * (1e-5 + 4e-6 / (roughness * roughness));
    }

    double spot = 0;
    if (m->kind == LIGHT_SPOT_CUTOFF || m->kind == LIGHT_SPOT_EXPONENT)
        spot = 2e-6 + 4e-7 * (double)in[IN_EXPONENT];
    if (m->kind == LIGHT_SPOT_CONES)
        spot = 2e-6 + 8e-7 * (double)in[IN_INVERSE_WIDTH];

    double allowed[OUTPUTS];
    double arrives = t.out[OUT_ATTENUATION] * (1 + spot), window = m->falloff == FALLOFF_RANGE ? 2e-6 : 0;
    for (int k = 0; k < 3; k++) {
        allowed[OUT_L + k] = 4e-7;
        allowed[OUT_AMBIENT + k] = allowed[OUT_REFLECTION + k] = 2e-6;
        allowed[OUT_DIFFUSE + k] = ((matt + spot) * arrives + window) * (double)in[IN_DIFFUSE + k] + 1e-30;
        allowed[OUT_SPECULAR + k] = ((lobe + spot * S) * arrives + window * S) * (double)in[IN_SPECULAR + k] + 1e-30;
        allowed[OUT_SUM + k] = allowed[OUT_DIFFUSE + k] + allowed[OUT_SPECULAR + k] + 4e-6;
    }
    allowed[OUT_DISTANCE] = 4e-7 * t.out[OUT_DISTANCE];
    allowed[OUT_ATTENUATION] = 2e-6 * t.out[OUT_ATTENUATION] + window; // the window ends at 0
    allowed[OUT_SPOT] = spot;
    allowed[OUT_D] = allowed[OUT_N_DOT_L] = matt;
    allowed[OUT_S] = lobe;
    allowed[OUT_BASE] = base;

    for (int k = 0; k < OUTPUTS; k++) {
        double error = fabs((double)p->out[k][i] - t.out[k]);
        if (!(error <= allowed[k]))
            fail_msg("output %d of point %d, kind %d falloff %d model %d fibre %d alpha %g: %.9g, textbook "
                     "%.9g, allowed %g",
                     k, i, m->kind, m->falloff, m->model, m->fibre, alpha, (double)p->out[k][i], t.out[k], allowed[k]);
        if (allowed[k] > 0 && error / allowed[k] > worst[k])
            worst[k] = error / allowed[k];
    }
}

// Environment light: the split sum and the Fresnel factor, with the light between microfacets.
TEST(test_environment_light)
{
    struct points *p = malloc(sizeof *p);
    assert_non_null(p);
    double most = 0;
    for (int viewer = VIEWER_LOCAL; viewer <= VIEWER_INFINITE; viewer++)
        for (int turn = 0; turn < 10; turn++) {
            points_fill(p, 500 + (uint64_t)turn);
            points_environment(p, plain(), viewer);
            for (int i = 0; i < POINTS; i++) {
                float in[INPUTS];
                double out[ENVIRONMENT_OUTPUTS], n_dot_v;
                point_inputs(p, i, in);
                textbook_environment(viewer, in, out, &n_dot_v);
                // The tables are evenly spaced in the root of n.v, which has few digits if n.v is small.
                double allowed = 4e-6 + 2e-6 / sqrt(fmax(n_dot_v, 1e-5));
                for (int k = 0; k < ENVIRONMENT_OUTPUTS; k++) {
                    double error = fabs((double)p->out[k][i] - out[k]) / allowed;
                    if (!(error <= 1))
                        fail_msg("output %d of point %d: %.9g, textbook %.9g, n.v %g", k, i, (double)p->out[k][i],
                                 out[k], n_dot_v);
                    most = fmax(most, error);
                }
            }
        }
    print_message("environment light: at most %.2f of what is allowed\n", most);
    free(p);
}

TEST(test_random_points)
{
    struct points *p = malloc(sizeof *p);
    assert_non_null(p);
    int compared = 0;
    for (int kind = LIGHT_POINT; kind <= LIGHT_SPOT_CONES; kind++) {
        for (int falloff = FALLOFF_NONE; falloff <= FALLOFF_RANGE; falloff++) {
            for (int model = LAM_REFLECTION_NONE; model < LAM_REFLECTION_COUNT; model++) {
                for (int variant = 0; variant < 4; variant++) {
                    if (kind == LIGHT_DIRECTIONAL && falloff != FALLOFF_NONE)
                        continue;
                    struct modes m = {kind, falloff, model, variant & 1, variant >> 1};
                    points_fill(p, 1 + (uint64_t)(compared + 1) * 7919);
                    points_light(p, plain(), &m);
                    for (int i = 0; i < POINTS; i++)
                        compare(p, &m, i);
                    compared++;
                }
            }
        }
    }
    assert_int_equal(compared, 13 * (LAM_REFLECTION_COUNT - 1) * 4);
    for (int k = 0; k < OUTPUTS; k++)
        print_message("output %2d: largest error %.2f of what is allowed\n", k, worst[k]);
    free(p);
}

// One simple point: eye at the origin, point 4 in front, normal and light towards the eye, white.
static void plain_point(float in[INPUTS])
{
    for (int k = 0; k < INPUTS; k++)
        in[k] = 0;
    in[IN_POINT + 2] = -4;
    in[IN_NORMAL + 2] = 1;
    in[IN_TANGENT] = 1;
    in[IN_DIRECTION + 2] = -1;
    in[IN_CONSTANT] = 1;
    in[IN_SHININESS] = 10;
    for (int c = 0; c < 3; c++)
        in[IN_DIFFUSE + c] = in[IN_SPECULAR + c] = in[IN_TINT + c] = 1;
    in[IN_UP + 1] = 1;
}

static void light_one(const struct modes *m, const float in[INPUTS], float out[OUTPUTS])
{
    struct points *p = malloc(sizeof *p);
    assert_non_null(p);
    for (int k = 0; k < INPUTS; k++)
        for (int i = 0; i < POINTS; i++)
            p->in[k][i] = in[k];
    points_light(p, plain(), m);
    for (int k = 0; k < OUTPUTS; k++) {
        out[k] = p->out[k][0];
        assert_true(isfinite(out[k]));
    }
    free(p);
}

// A case that must add nothing, in every model except `none`, also at α = 0 (0⁰ = 1 must have no effect).
enum {
    SURFACES = 1,
    THREADS = 2,
    ALL = 3,
    GATED = 4
}; // models that read only the normal, or the tangent; not lit from behind
static void adds_nothing(const float in[INPUTS], int kind, int falloff, int which, int diffuse_too)
{
    for (int model = LAM_REFLECTION_LAMBERT; model < LAM_REFLECTION_COUNT; model++) {
        if (!(which & (lam_reflection_describe((lam_reflection)model)->tangents ? THREADS : SURFACES)))
            continue;
        if (which & GATED && lam_reflection_describe((lam_reflection)model)->toned)
            continue;
        for (int fibre = 0; fibre < 2; fibre++) {
            for (int zero = 0; zero < 2; zero++) {
                float own[INPUTS], out[OUTPUTS];
                memcpy(own, in, sizeof own);
                if (zero)
                    own[IN_SHININESS] = 0;
                light_one(&(struct modes){kind, falloff, model, fibre, VIEWER_LOCAL}, own, out);
                for (int c = 0; c < 3; c++) {
                    assert_true(!diffuse_too || out[OUT_DIFFUSE + c] == 0);
                    assert_true(out[OUT_SPECULAR + c] == 0);
                }
            }
        }
    }
}

TEST(test_degenerate_points)
{
    float in[INPUTS], out[OUTPUTS];

    plain_point(in); // the light exactly at the point
    memcpy(in + IN_POSITION, in + IN_POINT, 3 * sizeof(float));
    for (int kind = LIGHT_POINT; kind <= LIGHT_SPOT_CONES; kind++) {
        if (kind != LIGHT_DIRECTIONAL)
            for (int falloff = FALLOFF_NONE; falloff <= FALLOFF_RANGE; falloff++)
                adds_nothing(in, kind, falloff, ALL, 1);
    }
    in[IN_CONSTANT] = 0; // and the pure inverse square there
    in[IN_QUADRATIC] = 1;
    adds_nothing(in, LIGHT_POINT, FALLOFF_DISTANCE, ALL, 1);

    plain_point(in); // no normal
    in[IN_NORMAL + 2] = 0;
    in[IN_SKY] = in[IN_GROUND] = 1;
    adds_nothing(in, LIGHT_POINT, FALLOFF_NONE, SURFACES, 1);
    light_one(&(struct modes){LIGHT_POINT, 0, LAM_REFLECTION_BLINN_PHONG, 0, 0}, in, out);
    assert_true(out[OUT_AMBIENT] == 0);

    plain_point(in); // no tangent, and one along the normal
    in[IN_TANGENT] = 0;
    adds_nothing(in, LIGHT_POINT, FALLOFF_NONE, THREADS, 1);
    in[IN_TANGENT + 2] = 3;
    adds_nothing(in, LIGHT_POINT, FALLOFF_NONE, THREADS, 1);

    // A tilted tangent, of which rounding leaves a remainder. From 1e-4 on, there is a direction again.
    plain_point(in);
    static const float tilted[3] = {0.36f, 0.48f, 0.8f};
    static const struct {
        float sine;
        int there;
    } near[] = {{0, 0}, {1e-6f, 0}, {9e-5f, 0}, {1.1e-4f, 1}, {1e-3f, 1}};
    for (size_t i = 0; i < sizeof near / sizeof *near; i++)
        for (float length = 1e-6f; length < 2e6f; length *= 10) {
            for (int c = 0; c < 3; c++) {
                in[IN_NORMAL + c] = tilted[c];
                in[IN_TANGENT + c] = tilted[c] * length;
            }
            in[IN_TANGENT] -= 0.8f * near[i].sine * length; // along (-0.8, 0.6, 0), perpendicular to the normal
            in[IN_TANGENT + 1] += 0.6f * near[i].sine * length;
            if (!near[i].there)
                adds_nothing(in, LIGHT_POINT, FALLOFF_NONE, THREADS, 1);
            light_one(&(struct modes){LIGHT_POINT, 0, LAM_REFLECTION_KAJIYA_KAY, 0, 0}, in, out);
            assert_true((out[OUT_D] > 0.1f) == near[i].there);
        }

    plain_point(in); // the eye at the point: no highlight
    in[IN_POINT + 2] = 0;
    in[IN_POSITION + 2] = 5;
    adds_nothing(in, LIGHT_POINT, FALLOFF_NONE, ALL, 0);

    plain_point(in); // light from behind: gated, except for fibres and the lecture's form
    in[IN_POSITION] = 4;
    in[IN_POSITION + 2] = -4.5f;
    adds_nothing(in, LIGHT_POINT, FALLOFF_NONE, SURFACES | GATED, 1);
    for (int fibre = 0; fibre < 2; fibre++) {
        light_one(&(struct modes){LIGHT_POINT, 0, LAM_REFLECTION_KAJIYA_KAY, fibre, 0}, in, out);
        assert_true((out[OUT_DIFFUSE] > 0) == fibre);
        light_one(&(struct modes){LIGHT_POINT, 0, LAM_REFLECTION_KAJIYA_KAY_LECTURE, fibre, 0}, in, out);
        assert_true(out[OUT_DIFFUSE] > 0);
    }

    plain_point(in); // attenuation all zero
    in[IN_CONSTANT] = 0;
    adds_nothing(in, LIGHT_POINT, FALLOFF_DISTANCE, ALL, 1);

    plain_point(in); // beyond the range, far beyond, and exactly at it
    in[IN_INVERSE_RANGE] = 0.25f;
    for (float z = 0; z < 1e15f; z = z * 10 + 1) {
        in[IN_POSITION + 2] = z;
        adds_nothing(in, LIGHT_POINT, FALLOFF_RANGE, ALL, 1);
    }
}

// Lengths from 1e-15 to 1e15 give the same picture.
TEST(test_scale)
{
    float in[INPUTS], first[OUTPUTS], out[OUTPUTS];
    for (int model = LAM_REFLECTION_LAMBERT; model < LAM_REFLECTION_COUNT; model++) {
        plain_point(in);
        in[IN_POSITION + 1] = 3;
        struct modes m = {LIGHT_POINT, FALLOFF_NONE, model, 0, VIEWER_LOCAL};
        light_one(&m, in, first);
        assert_true(first[OUT_DIFFUSE] > 0.1f);
        for (int power = -14; power <= 14; power++) {
            float scale = (float)pow(10, power), scaled[INPUTS];
            memcpy(scaled, in, sizeof scaled);
            for (int c = 0; c < 3; c++) {
                scaled[IN_POINT + c] *= scale;
                scaled[IN_POSITION + c] *= scale;
                scaled[IN_NORMAL + c] *= scale;
                scaled[IN_TANGENT + c] /= scale;
            }
            light_one(&m, scaled, out);
            for (int k = OUT_D; k <= OUT_BASE; k++)
                assert_true(fabsf(out[k] - first[k]) < 4e-6f);
            assert_true(fabsf(out[OUT_DISTANCE] / (5 * scale) - 1) < 1e-6f);
        }
    }
}

// Numbers that can be checked by hand.
TEST(test_known_answers)
{
    float in[INPUTS], out[OUTPUTS];
    plain_point(in); // head on, light at the eye: all terms are 1
    for (int model = LAM_REFLECTION_PHONG; model <= LAM_REFLECTION_BLINN_PHONG; model++) {
        light_one(&(struct modes){LIGHT_POINT, FALLOFF_NONE, model, 0, 0}, in, out);
        assert_true(out[OUT_D] == 1 && out[OUT_S] == 1 && out[OUT_DISTANCE] == 4 && out[OUT_ATTENUATION] == 1);
    }
    in[IN_QUADRATIC] = 0.2f; // the lecture's 1, 0.54, 0.2 at distance 4: 1/(1 + 2.16 + 3.2)
    in[IN_LINEAR] = 0.54f;
    light_one(&(struct modes){LIGHT_POINT, FALLOFF_DISTANCE, LAM_REFLECTION_LAMBERT, 0, 0}, in, out);
    assert_true(fabsf(out[OUT_ATTENUATION] - 0.157232704f) < 1e-7f);
    in[IN_INVERSE_RANGE] = 0.125f; // half the range: 1 − 1/16
    light_one(&(struct modes){LIGHT_POINT, FALLOFF_RANGE, LAM_REFLECTION_LAMBERT, 0, 0}, in, out);
    assert_true(fabsf(out[OUT_ATTENUATION] - 0.157232704f * 0.9375f) < 1e-7f);

    // The light is 60° off the normal, and the eye is on it: D = ½; Phong (½)^10; Blinn–Phong cos(30°)^10 = (¾)^5.
    plain_point(in);
    in[IN_DIRECTION] = -0.8660254f;
    in[IN_DIRECTION + 2] = -0.5f;
    light_one(&(struct modes){LIGHT_DIRECTIONAL, 0, LAM_REFLECTION_PHONG, 0, 0}, in, out);
    assert_true(fabsf(out[OUT_D] - 0.5f) < 1e-6f && fabsf(out[OUT_S] - 0.0009765625f) < 1e-7f);
    light_one(&(struct modes){LIGHT_DIRECTIONAL, 0, LAM_REFLECTION_BLINN_PHONG, 0, 0}, in, out);
    assert_true(fabsf(out[OUT_S] - 0.2373046875f) < 2e-6f);
    // A thread across: t·l = sin 60°, t·v = 0, D = ½, and the base of the mirror cone is ½. For an upright thread, both
    // are 1.
    light_one(&(struct modes){LIGHT_DIRECTIONAL, 0, LAM_REFLECTION_KAJIYA_KAY, 0, 0}, in, out);
    assert_true(fabsf(out[OUT_D] - 0.5f) < 1e-6f && fabsf(out[OUT_BASE] - 0.5f) < 1e-6f);
    in[IN_TANGENT] = 0;
    in[IN_TANGENT + 1] = -7;
    light_one(&(struct modes){LIGHT_DIRECTIONAL, 0, LAM_REFLECTION_KAJIYA_KAY, 0, 0}, in, out);
    assert_true(fabsf(out[OUT_D] - 1) < 1e-6f && fabsf(out[OUT_S] - 1) < 1e-5f);

    // The mirror cone and the lecture's form differ in the sign: l and v are at 45° on either side of the normal.
    plain_point(in);
    in[IN_POINT] = -4;               // the eye is at 45° to the right of the normal
    in[IN_DIRECTION] = -0.70710678f; // and so is the light
    in[IN_DIRECTION + 2] = -0.70710678f;
    light_one(&(struct modes){LIGHT_DIRECTIONAL, 0, LAM_REFLECTION_KAJIYA_KAY, 0, 0}, in, out);
    assert_true(out[OUT_BASE] < 1e-6f);
    light_one(&(struct modes){LIGHT_DIRECTIONAL, 0, LAM_REFLECTION_KAJIYA_KAY_LECTURE, 0, 0}, in, out);
    assert_true(fabsf(out[OUT_BASE] - 1) < 1e-6f);
}

// The edge of a cone is lit for any rounding of the cosines; slightly outside, it is dark.
TEST(test_cone_edge)
{
    float in[INPUTS], out[OUTPUTS];
    struct modes m = {LIGHT_SPOT_CUTOFF, FALLOFF_NONE, LAM_REFLECTION_LAMBERT, 0, 0};
    struct random r = {99};
    for (int i = 0; i < 500; i++) {
        double angle = i == 0 ? acos(-1.0) / 2 : (double)random_between(&r, 0.01f, 1.57f), turn = i * 0.7;
        double reach = (double)random_between(&r, 0.5f, 20);
        for (int outside = 0; outside < 2; outside++) {
            double at = angle + (outside ? 1e-6 + 2e-6 / sin(angle) : 0);
            plain_point(in);
            in[IN_POINT] = (float)(reach * sin(at) * cos(turn));
            in[IN_POINT + 1] = (float)(reach * sin(at) * sin(turn));
            in[IN_POINT + 2] = (float)(-reach * cos(at));
            in[IN_EXPONENT] = i % 2 == 0 ? 0 : 3;
            in[IN_COS_CUTOFF] = (float)cos(angle);
            light_one(&m, in, out);
            double want = outside ? 0 : pow(fmax(cos(angle), 0), (double)in[IN_EXPONENT]);
            assert_true(fabs((double)out[OUT_SPOT] - want) < 3e-6);
        }
    }
    // Without a cutoff and with exponent 0, a spot is a point light: 0⁰ = 1, also behind the spot.
    plain_point(in);
    in[IN_DIRECTION + 2] = 1;
    light_one(&(struct modes){LIGHT_SPOT_EXPONENT, 0, LAM_REFLECTION_LAMBERT, 0, 0}, in, out);
    assert_true(out[OUT_SPOT] == 1);
    in[IN_EXPONENT] = 1;
    light_one(&(struct modes){LIGHT_SPOT_EXPONENT, 0, LAM_REFLECTION_LAMBERT, 0, 0}, in, out);
    assert_true(out[OUT_SPOT] == 0);
}

// Every model has a counterpart in textbook.c, a name and a summary; the properties agree with the formulas.
TEST(test_table)
{
    for (int model = 0; model < LAM_REFLECTION_COUNT; model++) {
        const lam_reflection_info *info = lam_reflection_describe((lam_reflection)model);
        assert_true(info && info->word && *info->word && info->summary && *info->summary);
        for (int other = 0; other < model; other++)
            assert_string_not_equal(info->word, lam_reflection_describe((lam_reflection)other)->word);
        assert_int_equal(info->diffuse != NULL, model >= LAM_REFLECTION_LAMBERT);
        assert_int_equal(info->base != NULL, (lobe_properties(model) & LOBE_HIGHLIGHT) != 0);
        if (model != LAM_REFLECTION_AUTO)
            assert_true(textbook_hash(model) != 0);
    }
    assert_null(lam_reflection_describe(LAM_REFLECTION_COUNT));
}
