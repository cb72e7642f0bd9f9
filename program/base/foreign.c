// foreign.c: prints text that others wrote.
#include "foreign.h"

#include <lambent/text.h>

#include <string.h>

// The replacements of ASCII characters in each form.
static const struct {
    enum foreign_form form;
    char character;
    const char *text;
} replacements[] = {
    {FOREIGN_TERMINAL, '\n', "\\n"}, {FOREIGN_TERMINAL, '\r', "\\r"}, {FOREIGN_TERMINAL, '\\', "\\\\"},
    {FOREIGN_COMMENT, '\\', "?"},    {FOREIGN_HTML, '&', "&amp;"},    {FOREIGN_HTML, '<', "&lt;"},
    {FOREIGN_HTML, '>', "&gt;"},     {FOREIGN_HTML, '"', "&quot;"},   {FOREIGN_CSV, '"', "\"\""},
    {FOREIGN_JSON, '"', "\\\""},     {FOREIGN_JSON, '\\', "\\\\"},
};

static const char *replacement(enum foreign_form form, char c)
{
    for (size_t i = 0; i < sizeof replacements / sizeof *replacements; i++)
        if (replacements[i].form == form && replacements[i].character == c)
            return replacements[i].text;
    return NULL;
}

// Returns whether a character changes the order of the text around it (see lam_utf8_hidden).
static bool is_order(uint32_t hidden) { return hidden > 0x9f && hidden < 0xfffd && (hidden & ~1u) != 0x2028; }

static bool changes_order(const char *text)
{
    for (; *text; text++)
        if (is_order(lam_utf8_hidden(text, strnlen(text, 4))))
            return true;
    return false;
}

static void print_hidden(FILE *file, enum foreign_form form, uint32_t hidden)
{
    bool html = form == FOREIGN_HTML, isolate = hidden >= 0x2066 && hidden <= 0x2069;
    if (form == FOREIGN_JSON)
        fprintf(file, "\\u%04x", (unsigned)hidden);
    else if (html && is_order(hidden) && !isolate)
        fprintf(file, "&#x%x;", (unsigned)hidden);
    else if (html && hidden == 0xfffd)
        fputs("\ufffd", file);
    else if (hidden > 0x9f && hidden != 0xfffd)
        fprintf(file, html ? "&lt;U+%04X&gt;" : "<U+%04X>", (unsigned)hidden);
    else
        putc('?', file);
}

// Returns whether a spreadsheet may evaluate a field as a formula. Spreadsheets skip blanks, and read the full-width
// forms of the characters too.
static bool is_formula(const char *text)
{
    static const char *const starts[] = {"=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠"};
    while (*text == ' ' || strncmp(text, "\u00a0", 2) == 0 || strncmp(text, "\u3000", 3) == 0)
        text += *text == ' ' ? 1 : lam_utf8_length(text, 3);
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (strncmp(text, starts[i], strlen(starts[i])) == 0)
            return true;
    return false;
}

void print_foreign(FILE *file, enum foreign_form form, struct foreign value)
{
    const char *text = value.text ? value.text : "";
    bool formula = form == FOREIGN_CSV && is_formula(text), isolated = form == FOREIGN_HTML && changes_order(text);
    bool quoted = form == FOREIGN_JSON || formula || (form == FOREIGN_CSV && strpbrk(text, ",\"\r\n"));
    fputs(quoted ? "\"" : isolated ? "&#x2068;" : "", file);
    fputs(formula ? "'" : "", file);
    bool ends = false; // in a comment, a slash now would end the comment or complete the trigraph of a backslash
    while (*text) {
        int length = lam_utf8_length(text, strnlen(text, 4));
        const char *other = replacement(form, *text);
        uint32_t hidden = lam_utf8_hidden(text, strnlen(text, 4));
        if (form == FOREIGN_COMMENT && ends && *text == '/')
            putc(' ', file);
        if (other)
            fputs(other, file);
        else if (hidden)
            print_hidden(file, form, hidden);
        else
            fwrite(text, 1, (size_t)length, file);
        ends = other || hidden || *text == '*' || *text == '?';
        text += length ? length : 1;
    }
    fputs(quoted ? "\"" : isolated ? "&#x2069;" : "", file);
}

const char *foreign_text(struct foreign value, char out[FOREIGN_SIZE])
{
    lam_utf8_show(value.text ? value.text : "", out, FOREIGN_SIZE);
    return out;
}

// --- pages

void html_text(FILE *file, struct foreign text) { print_foreign(file, FOREIGN_HTML, text); }

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
