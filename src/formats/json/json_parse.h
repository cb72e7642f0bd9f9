// json_parse.h: parses JSON text into Jansson values.
#ifndef JSON_PARSE_H
#define JSON_PARSE_H

#include "call_control.h"

#include <jansson.h>

// Parses JSON (RFC 8259) whose top-level value is an object or a list. A byte order mark may precede the text. Whole
// numbers become integers if 64 bits can store them; all other numbers become the nearest double. Duplicate keys, zero
// characters in strings, and numbers outside the range of a double are errors. Messages use `file` as the file's name;
// `call` may be NULL. Returns NULL on failure: LAM_CANNOT_READ with "FILE:LINE: column C: sentence", LAM_LIMIT (nested
// deeper than lam_control.json_depth_limit), LAM_CANCELLED.
//
// Jansson's own parser is not used. If memory runs out, that parser ends the process with a failed assertion, or
// wrongly reports an invalid token in the file.
json_t *json_parse(const char *text, size_t size, const char *file, struct call_control *call, lam_error *error);

#endif
