// base64.h: encodes and decodes base64 (RFC 4648, section 4), with padding and without line breaks.
#ifndef BASE64_H
#define BASE64_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Decodes base64 to *size bytes from malloc. Returns NULL if memory runs out, or if `text` is invalid; *at is then the
// position of the error.
uint8_t *base64_decode(const char *text, size_t length, size_t *size, size_t *at);

// Encodes bytes to *length characters from malloc, with a final zero. Returns NULL if memory runs out.
char *base64_encode(const uint8_t *bytes, size_t size, size_t *length);

#endif
