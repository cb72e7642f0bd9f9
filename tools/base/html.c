// html.c: escapes text and addresses for HTML.
#include "html.h"

#include <string.h>

#include "console.h"

void html_text(FILE *file, const char *text)
{
    for (const char *c = text ? text : ""; *c; c++) {
        size_t hidden = text_hidden(c);
        c += hidden ? hidden - 1 : 0;
        switch (hidden ? '?' : *c) {
        case '&':
            fputs("&amp;", file);
            break;
        case '<':
            fputs("&lt;", file);
            break;
        case '>':
            fputs("&gt;", file);
            break;
        case '"':
            fputs("&quot;", file);
            break;
        case '?':
            putc('?', file);
            break;
        default:
            putc(*c, file);
        }
    }
}

void html_script(FILE *file, const char *json)
{
    for (const char *c = json; *c; c++)
        if (*c == '<')
            fputs("\\u003c", file);
        else
            putc(*c, file);
}

void html_address(FILE *file, const char *path)
{
    for (const unsigned char *c = (const unsigned char *)path; *c; c++)
        if ((*c >= '0' && *c <= '9') || (*c >= 'A' && *c <= 'Z') || (*c >= 'a' && *c <= 'z') || strchr("-_.~/", *c))
            putc(*c, file);
        else
            fprintf(file, "%%%02X", *c);
}
