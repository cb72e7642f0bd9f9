// number.h: parses numbers in text with correct rounding, independently of the locale.
#ifndef NUMBER_H
#define NUMBER_H

#include <stdbool.h>
#include <stdint.h>

// Parses a decimal number (sign, digits, '.', exponent; also inf and nan, as in C) at `at`, without reading at or past
// `end`. Returns the position after the number, or NULL if there is none. The result is the double nearest to the text,
// with ties to even.
const uint8_t *number_double(const uint8_t *at, const uint8_t *end, double *out);

// Parses a decimal number and rounds it once, to the nearest float (not via double).
const uint8_t *number_float(const uint8_t *at, const uint8_t *end, float *out);

// Parses a decimal integer with an optional sign. Returns NULL if there is no number, or if the number does not fit
// into 64 bits.
const uint8_t *number_int(const uint8_t *at, const uint8_t *end, int64_t *out);

// Returns the value of a hexadecimal digit, or −1 for another character.
int number_hex_digit(char c);

#endif
