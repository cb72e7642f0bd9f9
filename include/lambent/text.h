// lambent/text.h: prints text from files on terminals and in pages (UTF-8).
#ifndef LAMBENT_TEXT_H
#define LAMBENT_TEXT_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

// Returns the code point of the UTF-8 character that begins at `bytes` if it must not be printed unchanged: a control
// character (U+0001..U+001F, U+007F..U+009F), a line separator (U+2028, U+2029), a control of the text direction
// (U+061C, U+200E, U+200F, U+202A..U+202E, U+2066..U+2069), or one that XML cannot contain (U+FFFE, U+FFFF). Returns
// U+FFFD for invalid bytes and for a zero byte, and 0 for other characters. The call reads at most `size` bytes.
LAM_API uint32_t lam_utf8_hidden(const void *bytes, size_t size);

// Copies a text for a terminal: control characters and invalid bytes become "?", line separators and controls of the
// text direction become "<U+2028>". A text that does not fit into `capacity` bytes, at least 4, ends in "…". Returns
// the length of the copy.
LAM_API size_t lam_utf8_show(const char *text, char *out, size_t capacity);

#ifdef __cplusplus
}
#endif
#endif
