// foreign.h: prints text that others wrote: names in models, paths, values of journals, submissions.
//
// A struct foreign cannot be passed to printf, so the compiler finds text that is printed without these functions.
#ifndef FOREIGN_H
#define FOREIGN_H

#include <stdio.h>

struct foreign {
    const char *text; // NULL is printed as ""
};
#define FOREIGN(t) ((struct foreign){t})

// In all forms but JSON, control characters become "?" and line separators "<U+2028>". So do bidirectional controls,
// except in HTML, which isolates their effect from the text around the value.
enum foreign_form {
    FOREIGN_TERMINAL, // one line: "\n" for a line end, "\r" for a carriage return, "\\" for a backslash
    FOREIGN_COMMENT,  // a comment of C or GLSL: the text cannot end the comment or continue it on the next line
    FOREIGN_HTML,     // also for attributes in double quotes, and for XML
    FOREIGN_CSV,      // a field (RFC 4180), which a spreadsheet does not evaluate as a formula
    FOREIGN_JSON,     // a string with its quotes; invalid UTF-8 becomes U+FFFD
};
void print_foreign(FILE *file, enum foreign_form form, struct foreign value);

// Writes a value for a terminal to `out` (lam_utf8_show), and returns `out`.
enum { FOREIGN_SIZE = 400 };
const char *foreign_text(struct foreign value, char out[FOREIGN_SIZE]);

// --- pages

// The first lines of each page that the program writes. The page contains no scripts, and loads only pictures beside it.
#define HTML_POLICY                                                                                                    \
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file: data:; "          \
    "style-src "                                                                                                       \
    "'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"

// Writes escaped text (FOREIGN_HTML).
void html_text(FILE *file, struct foreign text);

// Writes JSON so that a script element can contain it: escapes '<'.
void html_script(FILE *file, const char *json);

// Writes a path as an address: escapes every byte except letters, digits, slashes and a few punctuation marks.
void html_address(FILE *file, const char *path);

#endif
