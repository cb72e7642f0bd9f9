// base64.h: encodes and decodes base64 (RFC 4648, section 4), with padding and without line breaks.
#ifndef BASE64_H
#define BASE64_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Decodes base64 into memory allocated with malloc, and sets *size to the number of bytes. Returns NULL if memory runs
// out or `text` is invalid. Sets *at to the position of the error in `text`, or to SIZE_MAX if there is none.
uint8_t *base64_decode(const char *text, size_t length, size_t *size, size_t *at);

// Encodes bytes as base64. The text is allocated with malloc and ends in a zero byte, which *length does not count.
// Returns NULL if memory runs out.
char *base64_encode(const uint8_t *bytes, size_t size, size_t *length);

#endif
