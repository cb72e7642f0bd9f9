// utf8.c: checks UTF-8 text.
#include <lambent/text.h>

#include <stdio.h>
#include <string.h>

int lam_utf8_length(const void *bytes, size_t size)
{
    const uint8_t *at = bytes;
    if (size == 0)
        return 0;
    if (at[0] < 0x80)
        return 1;
    int length = at[0] >= 0xf0 ? 4 : at[0] >= 0xe0 ? 3 : 2;
    if (at[0] < 0xc2 || at[0] > 0xf4 || (size_t)length > size)
        return 0;
    for (int i = 1; i < length; i++)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (at[0] == 0xe0 && at[1] < 0xa0) || (at[0] == 0xf0 && at[1] < 0x90);
    bool surrogate = at[0] == 0xed && at[1] > 0x9f, beyond = at[0] == 0xf4 && at[1] > 0x8f;
    return overlong || surrogate || beyond ? 0 : length;
}

uint32_t lam_utf8_hidden(const void *bytes, size_t size)
{
    const uint8_t *at = bytes;
    int length = lam_utf8_length(bytes, size);
    if (length == 0 || at[0] == 0)
        return 0xfffd;
    uint32_t code = length == 1   ? at[0]
                    : length == 2 ? (at[0] & 0x1fu) << 6 | (at[1] & 0x3fu)
                    : length == 3 ? (at[0] & 0x0fu) << 12 | (at[1] & 0x3fu) << 6 | (at[2] & 0x3fu)
                                  : 0x10000;
    bool control = code < 0x20 || (code >= 0x7f && code < 0xa0), separator = code == 0x2028 || code == 0x2029;
    bool direction = code == 0x61c || code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
                     (code >= 0x2066 && code <= 0x2069);
    bool no_character = code == 0xfffe || code == 0xffff; // XML cannot contain them
    return control || separator || direction || no_character ? code : 0;
}

size_t lam_utf8_show(const char *text, char *out, size_t capacity)
{
    size_t used = 0, last = 0; // `last`: the longest length after which "…" fits
    while (*text) {
        int length = lam_utf8_length(text, strnlen(text, 4));
        uint32_t hidden = lam_utf8_hidden(text, strnlen(text, 4));
        char number[16] = "?";
        if (hidden > 0x9f && hidden != 0xfffd)
            snprintf(number, sizeof number, "<U+%04X>", (unsigned)hidden);
        size_t more = hidden ? strlen(number) : (size_t)length;
        last = used + sizeof "…" <= capacity ? used : last;
        if (used + more >= capacity) {
            memcpy(out + last, "…", sizeof "…");
            return last + sizeof "…" - 1;
        }
        memcpy(out + used, hidden ? number : text, more);
        used += more;
        text += length ? length : 1;
    }
    out[used] = 0;
    return used;
}
