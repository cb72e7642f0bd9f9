// look_option.c: implements --look: finds a look and reads its options.
#include "limit_options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "console.h"
#include "file_io.h"
#include "looks.inc"

static const struct {
    const char *name, *text;
} looks[] = {{"studio", text_studio_look},
             {"classic", text_classic_look},
             {"catalog", text_catalog_look},
             {"technical", text_technical_look}};

enum { LOOKS = sizeof looks / sizeof *looks, FILE_MAX = 1 << 16 };

const char *look_name(int look) { return look >= 0 && look < LOOKS ? looks[look].name : NULL; }
const char *look_text(int look) { return look >= 0 && look < LOOKS ? looks[look].text : NULL; }

const char *look_find(const char *name)
{
    for (int i = 0; i < LOOKS; i++)
        if (strcmp(looks[i].name, name) == 0)
            return looks[i].text;
    return NULL;
}

void look_summary(const char *text, char *out, size_t size)
{
    const char *from = text + strspn(text, "# ");
    snprintf(out, size, "%.*s", *text == '#' ? (int)strcspn(from, "\n") : 0, from);
}

// Returns a writable copy of a look's text, allocated with malloc.
static char *copy_of_look(const char *name, lam_error *error)
{
    const char *built_in = look_find(name);
    size_t room = built_in ? strlen(built_in) : FILE_MAX + 1; // one byte more than the size limit
    char *text = malloc(room + 1);
    uint64_t unused;
    int file = built_in ? -1 : open_regular(name, &unused);
    if (!text || (!built_in && file < 0)) {
        int reason = text ? errno : ENOMEM;
        struct suggestion nearest = suggest_start(name);
        for (int i = 0; i < LOOKS; i++)
            suggest_try(&nearest, looks[i].name);
        complain(error, LAM_BAD_ARGUMENT,
                 "found '%.100s', expected studio, classic, catalog, technical or a file (%s)%s%s%s", name,
                 reason ? strerror(reason) : "not a regular file", nearest.best ? "; did you mean '" : "",
                 nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
        if (file >= 0)
            close(file);
        free(text);
        return NULL;
    }
    size_t length = room;
    if (built_in)
        memcpy(text, built_in, room);
    bool whole = built_in || (read_up_to(file, text, room, &length) && length <= FILE_MAX);
    if (file >= 0)
        close(file);
    text[length] = 0;
    if (whole && strlen(text) == length)
        return text;
    free(text);
    complain(error, LAM_BAD_ARGUMENT, "%.200s: not a look: it cannot be read, is longer than 64 KiB, or is not text",
             name);
    return NULL;
}

bool look_read(const char *name, char **kept,
               bool (*take)(void *user, int line, char *option, char *value, lam_error *error), void *user,
               lam_error *error)
{
    char *text = *kept = copy_of_look(name, error);
    int number = 1;
    for (char *line = text, *next; line; line = next, number++) {
        next = strchr(line, '\n');
        if (next)
            *next++ = 0;
        char *option = line + strspn(line, " \t");
        size_t end = strlen(option);
        while (end && strchr(" \t\r", option[end - 1]))
            option[--end] = 0;
        if (!*option || *option == '#')
            continue;
        option += option[0] == '-' && option[1] == '-' ? 2 : 0;
        char *value = option + strcspn(option, " =");
        if (*value)
            *value++ = 0;
        value += strspn(value, " ");
        if (!take(user, number, option, value, error))
            return false;
    }
    return text != NULL;
}
