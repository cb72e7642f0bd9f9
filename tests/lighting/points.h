// points.h: points to light, with one array for each input, as the tables of widths.h require.
#ifndef POINTS_H
#define POINTS_H

#include "random.h"
#include "widths.h"

enum { POINTS = 2048 };

struct points {
    float in[INPUTS][POINTS], out[OUTPUTS][POINTS];
};

// Points around the origin of a scene 4 units in front of the eye, lights at distances of 0.5 to 10, and all inputs of
// a program: normals and tangents of any length, and the exponents of the project's accuracy promise in rotation.
static inline void points_fill(struct points *p, uint64_t seed)
{
    static const float exponents[] = {0, 1, 27.8f, 50, 128, 500, 1000, 10000};
    struct random r = {seed}, own = {~seed};
    for (int i = 0; i < POINTS; i++) {
        float unit[4][3]; // directions: light, axis, up, and the point's position
        for (int k = 0; k < 4; k++) {
            float *u = unit[k], square;
            do {
                for (int c = 0; c < 3; c++)
                    u[c] = random_between(&r, -1, 1);
                square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
            } while (square > 1 || square < 0.01f);
            for (int c = 0; c < 3; c++)
                u[c] /= __builtin_sqrtf(square);
        }
        float distance = random_between(&r, 0.5f, 10), length = random_between(&r, 0.1f, 8);
        float toward_half = random_between(&r, 0, 1); // many normals lie near the highlight
        for (int c = 0; c < 3; c++) {
            p->in[IN_POINT + c][i] = unit[3][c] - (c == 2 ? 4.0f : 0.0f);
            p->in[IN_POSITION + c][i] = p->in[IN_POINT + c][i] + distance * unit[0][c];
            float halfway = unit[0][c] - p->in[IN_POINT + c][i] * 0.25f;
            float any = random_between(&r, -1, 1);
            p->in[IN_NORMAL + c][i] = length * (halfway + toward_half * toward_half * any + 1e-3f * any);
            p->in[IN_TANGENT + c][i] = random_between(&r, -2, 2);
            p->in[IN_UP + c][i] = unit[2][c];
            for (int at = IN_DIFFUSE; at <= IN_SPECULAR; at += 3)
                p->in[at + c][i] = random_between(&r, 0, 1);
            for (int at = IN_SKY; at <= IN_ENVIRONMENT; at += 3)
                p->in[at + c][i] = random_between(&r, 0, 1);
        }
        // Axes approximately towards the point, so that most points are in the cone.
        float axis[3], square = 0, spread = random_between(&r, 0, 1.5f);
        for (int c = 0; c < 3; c++) {
            axis[c] = -unit[0][c] + spread * unit[1][c] * 0.7f;
            square += axis[c] * axis[c];
        }
        for (int c = 0; c < 3; c++)
            p->in[IN_DIRECTION + c][i] = axis[c] / __builtin_sqrtf(square);
        p->in[IN_CONSTANT][i] = random_between(&r, 0, 2);
        p->in[IN_LINEAR][i] = random_between(&r, 0, 1);
        p->in[IN_QUADRATIC][i] = random_between(&r, 0.1f, 1);
        p->in[IN_INVERSE_RANGE][i] = 1 / random_between(&r, 2, 12);
        p->in[IN_COS_CUTOFF][i] = random_between(&r, 0, 0.99f);
        p->in[IN_EXPONENT][i] = i % 3 == 0 ? 0 : random_between(&r, 0, 64);
        p->in[IN_COS_OUTER][i] = random_between(&r, 0, 0.7f);
        p->in[IN_INVERSE_WIDTH][i] = 1 / random_between(&r, 0.1f, 0.3f);
        for (int k = IN_PARAMETERS; k < INPUTS; k++)
            p->in[k][i] = random_between(&own, 0, 1.5f);
        p->in[IN_SHININESS][i] = exponents[i % 8];
        p->in[IN_PARAMETERS + 5][i] = 1 + 3 * p->in[IN_PARAMETERS + 5][i]; // steps of toon shading
        for (int c = 0; i % 32 == 9 && c < 3; c++) // along the normal, within the precision of floats
            p->in[IN_TANGENT + c][i] = p->in[IN_NORMAL + c][i] * 0.7f;
    }
}

static inline void points_environment(struct points *p, const struct width *width, int viewer)
{
    const float *in[INPUTS];
    float *out[ENVIRONMENT_OUTPUTS];
    for (int k = 0; k < INPUTS; k++)
        in[k] = p->in[k];
    for (int k = 0; k < ENVIRONMENT_OUTPUTS; k++)
        out[k] = p->out[k];
    width->environment(viewer, in, out, POINTS);
}

static inline void points_light(struct points *p, const struct width *width, const struct modes *modes)
{
    const float *in[INPUTS];
    float *out[OUTPUTS];
    for (int k = 0; k < INPUTS; k++)
        in[k] = p->in[k];
    for (int k = 0; k < OUTPUTS; k++)
        out[k] = p->out[k];
    width->light(modes, in, out, POINTS);
}

#endif
