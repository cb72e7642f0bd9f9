// html.h: escapes text and addresses for HTML.
#ifndef HTML_H
#define HTML_H

#include <stdio.h>

// Writes escaped text, which is also safe inside quotes. Invisible characters (text_hidden) become "?". Does nothing
// for NULL.
void html_text(FILE *file, const char *text);

// Writes JSON so that a script element can contain it: escapes '<'.
void html_script(FILE *file, const char *json);

// Writes a path as an address: escapes every byte except letters, digits, slashes and a few punctuation marks.
void html_address(FILE *file, const char *path);

#endif
