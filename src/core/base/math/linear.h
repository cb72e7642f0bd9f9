// linear.h: vectors, matrices and angles in double, in one fixed order of operations, for set-up work: cameras,
// rotations, transforms. Per-pixel code uses lanes.h. libm is not used, because its last bits differ between machines
// and versions.
#ifndef LINEAR_H
#define LINEAR_H

#include <lambent/base.h>

#define PI 3.14159265358979323846

static inline lam_vec3 v3(double x, double y, double z) { return (lam_vec3){x, y, z}; }
static inline lam_vec3 v3_add(lam_vec3 a, lam_vec3 b) { return v3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline lam_vec3 v3_sub(lam_vec3 a, lam_vec3 b) { return v3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline lam_vec3 v3_scale(lam_vec3 a, double s) { return v3(a.x * s, a.y * s, a.z * s); }
static inline double v3_dot(lam_vec3 a, lam_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline lam_vec3 v3_cross(lam_vec3 a, lam_vec3 b)
{
    return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
double v3_length(lam_vec3 a);
lam_vec3 v3_unit(lam_vec3 a); // zero stays zero; no overflow or underflow
bool v3_finite(lam_vec3 a);

// The result of math_sqrt is correctly rounded, because math_sqrt is a processor instruction. For |x| ≤ 1e6, the
// trigonometric functions are accurate to 2 units in the last place.
double math_sqrt(double x);
double math_sin(double x);
double math_cos(double x);
double math_tan(double x);
double math_acos(double x); // the argument is clamped to −1…1; the result is 0…π
double math_atan2(double y, double x);
double math_exp2(double x); // 2^x, |x| ≤ 1000; exact for whole numbers
// Returns the largest number that is at most x and equals 1, 2 or 5 times a power of ten. x must be above 0.
double math_round_down(double x);
double math_radians(double degrees);
double math_degrees(double radians);
bool math_finite(double x);

bool mat4_is_identity(const lam_mat4 *m);                   // compares bits, so −0 is not 0
lam_mat4 mat4_mul(const lam_mat4 *a, const lam_mat4 *b);    // a·b, which applies b first
lam_vec3 mat4_point(const lam_mat4 *m, lam_vec3 p);         // affine: w = 1, last row ignored
lam_vec3 mat4_vector(const lam_mat4 *m, lam_vec3 v);        // upper 3×3 only
double mat4_determinant3(const lam_mat4 *m);                // the determinant of the upper 3×3
bool mat4_inverse_affine(const lam_mat4 *m, lam_mat4 *out); // false if the upper 3×3 is singular
// Computes the cofactors of the upper 3×3, which are the inverse transpose times the determinant. Cofactors transform
// normals. The caller handles the sign of the determinant (a mirror reverses the winding, not the normal).
void mat4_normal_matrix(const lam_mat4 *m, double out[3][3]);

lam_mat4 mat4_translate(double x, double y, double z);
lam_mat4 mat4_scale(double x, double y, double z);
lam_mat4 mat4_rotate(double radians, lam_vec3 axis);               // right-handed; the axis may have any nonzero length
lam_mat4 mat4_look_at(lam_vec3 eye, lam_vec3 target, lam_vec3 up); // world to eye space
// The projection matrices of OpenGL: z is −1 at the near plane and 1 at the far plane. The distances of both planes are
// positive.
lam_mat4 mat4_perspective(double fovy_rad, double aspect, double near_plane, double far_plane);
lam_mat4 mat4_orthographic(double half_height, double aspect, double near_plane, double far_plane);

#endif
