// base64.c: encodes and decodes base64 (RFC 4648, section 4).
#include "base64.h"

#include <stdlib.h>

static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Returns the value of a character (0..63), or −1 if the character is outside the alphabet.
static int value_of(char letter)
{
    return letter >= 'A' && letter <= 'Z'   ? letter - 'A'
           : letter >= 'a' && letter <= 'z' ? letter - 'a' + 26
           : letter >= '0' && letter <= '9' ? letter - '0' + 52
           : letter == '+'                  ? 62
           : letter == '/'                  ? 63
                                            : -1;
}

uint8_t *base64_decode(const char *text, size_t length, size_t *size, size_t *at)
{
    size_t padding = 0, bad = length;
    while (padding < 2 && padding < length && text[length - 1 - padding] == '=')
        padding++;
    uint8_t *bytes = malloc(length / 4 * 3 + 3), *to = bytes;
    uint32_t bits = 0;
    *at = SIZE_MAX;
    for (size_t i = 0; bytes && i < length - padding && bad == length; i++) {
        int value = value_of(text[i]);
        if (value < 0) {
            bad = i;
            break;
        }
        bits = bits << 6 | (uint32_t)value;
        if (i % 4 == 3) {
            *to++ = (uint8_t)(bits >> 16);
            *to++ = (uint8_t)(bits >> 8);
            *to++ = (uint8_t)bits;
        }
    }
    if (!bytes)
        return NULL;
    // With padding, the last group contains 2 or 3 characters, and the unused bits of the last character must be 0.
    bool whole = length % 4 == 0 && (padding == 0 || (bits & (padding == 2 ? 0xF : 0x3)) == 0);
    if (bad < length || !whole) {
        *at = bad;
        free(bytes);
        return NULL;
    }
    if (padding == 2) {
        *to++ = (uint8_t)(bits >> 4);
    } else if (padding == 1) {
        *to++ = (uint8_t)(bits >> 10);
        *to++ = (uint8_t)(bits >> 2);
    }
    *size = (size_t)(to - bytes);
    return bytes;
}

char *base64_encode(const uint8_t *bytes, size_t size, size_t *length)
{
    char *text = malloc((size + 2) / 3 * 4 + 1), *to = text;
    for (size_t i = 0; text && i < size; i += 3) {
        size_t left = size - i;
        uint32_t bits =
            (uint32_t)bytes[i] << 16 | (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
        *to++ = letters[bits >> 18];
        *to++ = letters[bits >> 12 & 63];
        *to++ = left > 1 ? letters[bits >> 6 & 63] : '=';
        *to++ = left > 2 ? letters[bits & 63] : '=';
    }
    if (text) {
        *to = 0;
        *length = (size_t)(to - text);
    }
    return text;
}
