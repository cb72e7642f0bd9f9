// color_text.c: parses colours in the forms that users write.
#include "scene_internal.h"

#include "fail.h"
#include "number.h"
#include "spelling.h"
#include "srgb.h"

#include <string.h>

// The sixteen names of HTML 4, their common synonyms, and orange.
static const struct {
    const char *name;
    uint32_t rgb;
} names[] = {
    {"black", 0x000000},  {"silver", 0xc0c0c0}, {"gray", 0x808080},   {"grey", 0x808080},    {"white", 0xffffff},
    {"maroon", 0x800000}, {"red", 0xff0000},    {"purple", 0x800080}, {"fuchsia", 0xff00ff}, {"magenta", 0xff00ff},
    {"green", 0x008000},  {"lime", 0x00ff00},   {"olive", 0x808000},  {"yellow", 0xffff00},  {"navy", 0x000080},
    {"blue", 0x0000ff},   {"teal", 0x008080},   {"aqua", 0x00ffff},   {"cyan", 0x00ffff},    {"orange", 0xffa500},
};

static lam_rgba from_bytes(uint32_t rgba, lam_color_mode mode)
{
    double part[3];
    for (int i = 0; i < 3; i++) {
        double encoded = (double)(rgba >> (24 - 8 * i) & 255) / 255;
        part[i] = mode == LAM_COLOR_RAW ? encoded : srgb_linear(encoded);
    }
    return (lam_rgba){(float)part[0], (float)part[1], (float)part[2], (float)((double)(rgba & 255) / 255)};
}

// Parses "rgb", "rrggbb" or "rrggbbaa" after the '#'.
static bool read_hex(const char *text, uint32_t *rgba)
{
    size_t length = strlen(text);
    if (length != 3 && length != 6 && length != 8)
        return false;
    *rgba = 0;
    for (size_t i = 0; i < length; i++) {
        int digit = number_hex_digit(text[i]);
        if (digit < 0)
            return false;
        *rgba = *rgba << 4 | (uint32_t)digit;
        if (length == 3)
            *rgba = *rgba << 4 | (uint32_t)digit;
    }
    if (length != 8)
        *rgba = *rgba << 8 | 255;
    return true;
}

// Parses one number for all three channels, "r/g/b" or "r/g/b/a". The numbers must not be negative, and the alpha must
// be at most 1.
static bool read_numbers(const char *text, lam_rgba *color)
{
    float part[4] = {0, 0, 0, 1};
    const uint8_t *at = (const uint8_t *)text, *end = at + strlen(text);
    int count = 0;
    for (; count < 4; count++) {
        at = number_float(at, end, &part[count]);
        if (!at || !(part[count] >= 0 && part[count] - part[count] == 0))
            return false;
        if (at == end || *at++ != '/')
            break;
    }
    if (count == 0)
        part[1] = part[2] = part[0];
    *color = (lam_rgba){part[0], part[1], part[2], part[3]};
    return at == end && count != 1 && part[3] <= 1;
}

static bool same_word(const char *a, const char *b)
{
    for (; *a && *b; a++, b++)
        if ((*a >= 'A' && *a <= 'Z' ? *a + 32 : *a) != *b)
            return false;
    return *a == *b;
}

enum { NAMES = sizeof names / sizeof names[0] };

const char *lam_color_name(int index) { return index >= 0 && index < NAMES ? names[index].name : NULL; }

// Converts a colour in the notation of other programs ("ff8800", "0xff8800", "255,136,0" or "rgb(255, 136, 0)") to
// hexadecimal. Returns false if the text is in none of these notations.
static bool hex_of(const char *text, char hex[16])
{
    static const char digits[] = "0123456789abcdef";
    const char *at = strncmp(text, "0x", 2) == 0 ? text + 2 : text;
    uint32_t rgba;
    hex[0] = '#';
    if (strlen(at) >= 6 && read_hex(at, &rgba)) {
        strcpy(hex + 1, at);
        return true;
    }
    at = strncmp(text, "rgb(", 4) == 0 ? text + 4 : text;
    for (int channel = 0; channel < 3; channel++) {
        unsigned byte = 0;
        at += strspn(at, channel ? ", " : "");
        if (!(*at >= '0' && *at <= '9'))
            return false;
        for (; *at >= '0' && *at <= '9' && byte < 256; at++)
            byte = byte * 10 + (unsigned)(*at - '0');
        if (byte > 255)
            return false;
        hex[1 + 2 * channel] = digits[byte >> 4];
        hex[2 + 2 * channel] = digits[byte & 15];
    }
    hex[7] = 0;
    return *at == 0 || strcmp(at, ")") == 0;
}

bool lam_color_parse(const char *text, lam_color_mode mode, lam_rgba *color, lam_error *error)
{
    if (!text || !color)
        return fail(error, LAM_BAD_ARGUMENT, "lam_color_parse: %s is NULL", text ? "color" : "text");
    uint32_t rgba;
    if (text[0] == '#' && read_hex(text + 1, &rgba)) {
        *color = from_bytes(rgba, mode);
        return true;
    }
    if (same_word(text, "transparent")) {
        *color = (lam_rgba){0, 0, 0, 0};
        return true;
    }
    for (int i = 0; i < NAMES; i++)
        if (same_word(text, names[i].name)) {
            *color = from_bytes(names[i].rgb << 8 | 255, mode);
            return true;
        }
    lam_rgba numbers;
    if (read_numbers(text, &numbers)) {
        *color = numbers;
        return true;
    }
    // Users often forget the '#', or the shell treats it as the beginning of a comment.
    char hex[16];
    struct spelling spelling = spelling_of(text);
    for (int i = 0; i < NAMES; i++)
        spelling_try(&spelling, names[i].name);
    spelling_try(&spelling, "transparent");
    const char *nearest = hex_of(text, hex) ? hex : spelling.nearest;
    return fail(error, LAM_BAD_ARGUMENT,
                "found '%.60s', expected a colour: #rrggbb, #rrggbbaa, r/g/b, one number, transparent, or a name such "
                "as white%s%s%s",
                text, nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
}
