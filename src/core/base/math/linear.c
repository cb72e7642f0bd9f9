// linear.c: vectors, matrices and angles in double, in one fixed order of operations.
#include "linear.h"

#include "float_state.h"

#include <string.h>

bool math_finite(double x) { return x - x == 0; }

double math_sqrt(double x) { return x > 0 ? __builtin_sqrt(x) : 0; }

double math_radians(double degrees) { return degrees * (PI / 180); }
double math_degrees(double radians) { return radians * (180 / PI); }

// π/2 as the sum of three numbers. The first two numbers have 33 significant bits, so that multiplying each of them by
// the number of quarter turns is exact.
#define HALF_PI_1 1.57079632673412561417e+00
#define HALF_PI_2 6.07710050630396597660e-11
#define HALF_PI_3 2.02226624879595063154e-21

// Splits x into quarter·π/2 + rest with |rest| ≤ π/4 (slightly more because of rounding). The split is accurate enough
// for |x| ≤ 1e6. Larger angles are not reduced: they do not occur in practice, and the result stays finite.
static double reduce(double x, int *quarter)
{
    if (!(x > -1e9 && x < 1e9)) {
        *quarter = 0;
        return 0;
    }
    double q = x * (2 / PI);
    long long n = (long long)(q + (q >= 0 ? 0.5 : -0.5));
    *quarter = (int)(n & 3);
    double k = (double)n;
    return ((x - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3;
}

// Sums the Taylor series of the sine. For |x| ≤ π/4, the first omitted term is below 2⁻⁵³ of the result.
static double sine_series(double x)
{
    double z = x * x;
    double s = 1.0 / 355687428096000.0; // 1/17!
    s = s * z - 1.0 / 1307674368000.0;  // 15!
    s = s * z + 1.0 / 6227020800.0;     // 13!
    s = s * z - 1.0 / 39916800.0;       // 11!
    s = s * z + 1.0 / 362880.0;         // 9!
    s = s * z - 1.0 / 5040.0;
    s = s * z + 1.0 / 120.0;
    s = s * z - 1.0 / 6.0;
    return x + x * (z * s);
}

static double cosine_series(double x)
{
    double z = x * x;
    double c = -1.0 / 6402373705728000.0; // 1/18!
    c = c * z + 1.0 / 20922789888000.0;   // 16!
    c = c * z - 1.0 / 87178291200.0;      // 14!
    c = c * z + 1.0 / 479001600.0;        // 12!
    c = c * z - 1.0 / 3628800.0;          // 10!
    c = c * z + 1.0 / 40320.0;
    c = c * z - 1.0 / 720.0;
    c = c * z + 1.0 / 24.0;
    double half = 0.5 * z;
    double rest = 1.0 - half;
    return rest + (((1.0 - rest) - half) + z * z * c);
}

double math_sin(double x)
{
    int quarter;
    double r = reduce(x, &quarter);
    double s = quarter & 1 ? cosine_series(r) : sine_series(r);
    return quarter & 2 ? -s : s;
}

double math_cos(double x)
{
    int quarter;
    double r = reduce(x, &quarter);
    double c = quarter & 1 ? sine_series(r) : cosine_series(r);
    return (quarter + 1) & 2 ? -c : c;
}

double math_tan(double x) { return math_sin(x) / math_cos(x); }

// Computes atan t for t in [0, 1]. The angle is halved twice, with atan t = 2 atan(t / (1 + √(1 + t²))). The series is
// then used for t ≤ tan(π/16).
static double arctangent(double t)
{
    for (int i = 0; i < 2; i++)
        t = t / (1 + math_sqrt(1 + t * t));
    double z = t * t;
    double s = 0;
    for (int k = 12; k >= 1; k--)
        s = (1.0 / (2 * k + 1) - s) * z;
    return 4 * (t - t * s);
}

double math_atan2(double y, double x)
{
    double ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
    double angle;
    if (ax == 0 && ay == 0)
        angle = 0;
    else if (ay <= ax)
        angle = arctangent(ay / ax);
    else
        angle = PI / 2 - arctangent(ax / ay);
    if (x < 0)
        angle = PI - angle;
    return y < 0 ? -angle : angle;
}

double math_acos(double x)
{
    if (!(x < 1))
        return 0;
    if (x < -1)
        x = -1;
    return math_atan2(math_sqrt((1 - x) * (1 + x)), x);
}

// The integer part of x determines how often the result is doubled or halved. For the rest of x, at most ½, the series
// of e^(x ln 2) is used.
double math_exp2(double x)
{
    int whole = (int)(x < 0 ? x - 0.5 : x + 0.5);
    double y = (x - whole) * 0.69314718055994530942, sum = 1;
    for (int k = 18; k >= 1; k--)
        sum = 1 + sum * y / k;
    for (; whole > 0; whole--)
        sum *= 2;
    for (; whole < 0; whole++)
        sum *= 0.5;
    return sum;
}

bool v3_finite(lam_vec3 a) { return math_finite(a.x) && math_finite(a.y) && math_finite(a.z); }

static double magnitude(lam_vec3 a)
{
    double x = a.x < 0 ? -a.x : a.x, y = a.y < 0 ? -a.y : a.y, z = a.z < 0 ? -a.z : a.z;
    double m = x > y ? x : y;
    return m > z ? m : z;
}

double v3_length(lam_vec3 a)
{
    double m = magnitude(a);
    if (!(m > 0) || !math_finite(m))
        return m > 0 ? m : 0;
    if (m > 1e-140 && m < 1e140)
        return math_sqrt(v3_dot(a, a));
    lam_vec3 b = v3(a.x / m, a.y / m, a.z / m);
    return m * math_sqrt(v3_dot(b, b));
}

lam_vec3 v3_unit(lam_vec3 a)
{
    double m = magnitude(a);
    if (!(m > 0) || !math_finite(m))
        return v3(0, 0, 0);
    if (m < 1e-140 || m > 1e140)
        a = v3(a.x / m, a.y / m, a.z / m);
    double length = math_sqrt(v3_dot(a, a));
    return v3(a.x / length, a.y / length, a.z / length);
}

lam_mat4 lam_mat4_identity(void) { return (lam_mat4){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}; }

bool mat4_is_identity(const lam_mat4 *m)
{
    lam_mat4 identity = lam_mat4_identity();
    return memcmp(m, &identity, sizeof identity) == 0;
}

lam_mat4 mat4_mul(const lam_mat4 *a, const lam_mat4 *b)
{
    lam_mat4 c;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            c.m[i][j] = ((a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j]) + a->m[i][2] * b->m[2][j]) +
                        a->m[i][3] * b->m[3][j];
    return c;
}

lam_vec3 mat4_point(const lam_mat4 *m, lam_vec3 p)
{
    lam_vec3 r = mat4_vector(m, p);
    return v3(r.x + m->m[0][3], r.y + m->m[1][3], r.z + m->m[2][3]);
}

lam_vec3 mat4_vector(const lam_mat4 *m, lam_vec3 v)
{
    return v3((m->m[0][0] * v.x + m->m[0][1] * v.y) + m->m[0][2] * v.z,
              (m->m[1][0] * v.x + m->m[1][1] * v.y) + m->m[1][2] * v.z,
              (m->m[2][0] * v.x + m->m[2][1] * v.y) + m->m[2][2] * v.z);
}

void mat4_normal_matrix(const lam_mat4 *m, double out[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            out[i][j] = m->m[i1][j1] * m->m[i2][j2] - m->m[i1][j2] * m->m[i2][j1];
        }
}

double mat4_determinant3(const lam_mat4 *m)
{
    double c[3][3];
    mat4_normal_matrix(m, c);
    return (m->m[0][0] * c[0][0] + m->m[0][1] * c[0][1]) + m->m[0][2] * c[0][2];
}

bool mat4_inverse_affine(const lam_mat4 *m, lam_mat4 *out)
{
    double c[3][3], d = mat4_determinant3(m);
    mat4_normal_matrix(m, c);
    if (!(d != 0) || !math_finite(d))
        return false;
    *out = lam_mat4_identity();
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out->m[i][j] = c[j][i] / d;
    lam_vec3 t = mat4_vector(out, v3(m->m[0][3], m->m[1][3], m->m[2][3]));
    out->m[0][3] = -t.x;
    out->m[1][3] = -t.y;
    out->m[2][3] = -t.z;
    return true;
}

lam_mat4 mat4_translate(double x, double y, double z)
{
    lam_mat4 m = lam_mat4_identity();
    m.m[0][3] = x;
    m.m[1][3] = y;
    m.m[2][3] = z;
    return m;
}

lam_mat4 mat4_scale(double x, double y, double z)
{
    lam_mat4 m = lam_mat4_identity();
    m.m[0][0] = x;
    m.m[1][1] = y;
    m.m[2][2] = z;
    return m;
}

// Uses Rodrigues' rotation formula.
lam_mat4 mat4_rotate(double radians, lam_vec3 axis)
{
    lam_vec3 k = v3_unit(axis);
    double s = math_sin(radians), c = math_cos(radians), d = 1 - c;
    lam_mat4 m = lam_mat4_identity();
    m.m[0][0] = c + k.x * k.x * d;
    m.m[0][1] = k.x * k.y * d - k.z * s;
    m.m[0][2] = k.x * k.z * d + k.y * s;
    m.m[1][0] = k.y * k.x * d + k.z * s;
    m.m[1][1] = c + k.y * k.y * d;
    m.m[1][2] = k.y * k.z * d - k.x * s;
    m.m[2][0] = k.z * k.x * d - k.y * s;
    m.m[2][1] = k.z * k.y * d + k.x * s;
    m.m[2][2] = c + k.z * k.z * d;
    return m;
}

lam_mat4 lam_mat4_rotation(lam_vec3 axis, double angle_rad)
{
    uint64_t state = float_state_enter();
    lam_mat4 m = mat4_rotate(angle_rad, axis);
    float_state_leave(state);
    return m;
}

lam_mat4 mat4_look_at(lam_vec3 eye, lam_vec3 target, lam_vec3 up)
{
    lam_vec3 back = v3_unit(v3_sub(eye, target));
    if (v3_dot(back, back) == 0)
        back = v3(0, 0, 1);
    lam_vec3 side = v3_cross(v3_unit(up), back);
    if (v3_dot(side, side) < 1e-20) { // `up` is parallel to the view: use another axis
        up = back.z * back.z < 0.5 ? v3(0, 0, 1) : v3(0, 1, 0);
        side = v3_cross(up, back);
    }
    lam_vec3 right = v3_unit(side), above = v3_cross(back, right);
    lam_mat4 m = {{{right.x, right.y, right.z, -v3_dot(right, eye)},
                   {above.x, above.y, above.z, -v3_dot(above, eye)},
                   {back.x, back.y, back.z, -v3_dot(back, eye)},
                   {0, 0, 0, 1}}};
    return m;
}

lam_mat4 mat4_perspective(double fovy_rad, double aspect, double near_plane, double far_plane)
{
    double f = 1 / math_tan(fovy_rad / 2);
    lam_mat4 m = {0};
    m.m[0][0] = f / aspect;
    m.m[1][1] = f;
    m.m[2][2] = (far_plane + near_plane) / (near_plane - far_plane);
    m.m[2][3] = 2 * far_plane * near_plane / (near_plane - far_plane);
    m.m[3][2] = -1;
    return m;
}

lam_mat4 mat4_orthographic(double half_height, double aspect, double near_plane, double far_plane)
{
    lam_mat4 m = {0};
    m.m[0][0] = 1 / (half_height * aspect);
    m.m[1][1] = 1 / half_height;
    m.m[2][2] = 2 / (near_plane - far_plane);
    m.m[2][3] = (far_plane + near_plane) / (near_plane - far_plane);
    m.m[3][3] = 1;
    return m;
}

double math_round_down(double x)
{
    double power = 1;
    for (; power > x && power > 1e-300; power /= 10)
        ;
    for (; power * 10 <= x; power *= 10)
        ;
    return power * 5 <= x ? power * 5 : power * 2 <= x ? power * 2 : power;
}
