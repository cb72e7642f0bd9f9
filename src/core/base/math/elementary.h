// elementary.h: exponentials, logarithms, powers and related functions in double, bit-identical on every machine.
//
// These functions evaluate formulas that users write (src/formats/shapes/formula.h). As in linear.h, the order of operations is
// fixed and libm is not used. tests/unit/test_formula.c measures the errors by comparison with libm. All errors are
// relative to the result unless stated otherwise. Outside a function's domain, the result is NaN.
#ifndef ELEMENTARY_H
#define ELEMENTARY_H

double math_exp(double x);           // error within 1e-15; the result is 0 below −745 and infinite above 710
double math_log(double x);           // natural logarithm; error within 1e-15 relative and 2e-16 absolute
double math_pow(double a, double b); // error within 1e-14; a may be below 0 only if b is a whole number; 0⁰ = 1
double math_sinh(double x);          // within 2e-15
double math_cosh(double x);          // within 2e-15
double math_tanh(double x);          // within 2e-15
double math_asin(double x);          // within 1e-15
double math_atan(double x);          // within 1e-15
double math_floor(double x);         // exact

#endif
