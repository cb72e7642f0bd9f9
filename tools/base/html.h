// html.h: text and addresses in HTML.
#ifndef HTML_H
#define HTML_H

#include <stdio.h>

// Text, also within quotes. NULL: nothing.
void html_text(FILE *file, const char *text);

// A path as an address: everything but letters, digits, slashes and a few signs is escaped, byte by byte.
void html_address(FILE *file, const char *path);

#endif
