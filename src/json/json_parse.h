// json_parse.h: JSON text as a tree of Jansson's.
#ifndef JSON_PARSE_H
#define JSON_PARSE_H

#include "call_control.h"

#include <jansson.h>

// Parses JSON (RFC 8259) with an object or a list at the top; a byte order mark may precede it. Whole numbers are
// integers if 64 bits can store them, all others the nearest double. Also refused: keys given twice, zero characters in
// texts, numbers outside a double's range. Messages use `file` for the file; `call` may be NULL. NULL: LAM_CANNOT_READ
// with "FILE:LINE: column C: sentence", LAM_LIMIT (nested deeper than lam_control.json_depth_limit), LAM_CANCELLED.
//
// Jansson's own parser is not used: without memory it calls an assertion, which ends the process, or reports an invalid
// token of the file.
json_t *json_parse(const char *text, size_t size, const char *file, struct call_control *call, lam_error *error);

#endif
