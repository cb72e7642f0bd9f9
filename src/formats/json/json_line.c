// json_line.c: finds the line of a value in JSON text. The text has been parsed before, so it is well formed.
#include "json_reader.h"

#include <string.h>

enum { MAX_NESTED = 16 };

struct cursor {
    const char *at, *end;
};

static void skip_space(struct cursor *c)
{
    while (c->at < c->end && strchr(" \t\r\n,:", *c->at) && *c->at)
        c->at++;
}

// Skips a string; its opening quote is at the cursor.
static void skip_text(struct cursor *c)
{
    for (c->at++; c->at < c->end && *c->at != '"'; c->at++)
        c->at += *c->at == '\\';
    c->at += c->at < c->end;
}

static void skip_value(struct cursor *c)
{
    int depth = 0;
    do {
        skip_space(c);
        if (c->at >= c->end)
            return;
        if (*c->at == '"') {
            skip_text(c);
            continue;
        }
        bool opens = *c->at == '{' || *c->at == '[', closes = *c->at == '}' || *c->at == ']';
        depth += opens - closes;
        if (opens || closes)
            c->at++;
        else
            while (c->at < c->end && !strchr(" \t\r\n,:{}[]\"", *c->at))
                c->at++;
    } while (depth > 0);
}

// Moves the cursor from an object or a list to one of its members. In an object, the cursor is then at the member's
// key. Returns false if the member does not exist.
static bool enter(struct cursor *c, const struct place *step, const char **found)
{
    skip_space(c);
    if (c->at >= c->end || *c->at != (step->key ? '{' : '['))
        return false;
    c->at++;
    for (size_t i = 0;; i++) {
        skip_space(c);
        if (c->at >= c->end || *c->at == '}' || *c->at == ']')
            return false;
        *found = c->at;
        if (step->key) {
            size_t length = strlen(step->key);
            const char *name = c->at + 1;
            skip_text(c);
            skip_space(c);
            if ((size_t)(c->end - name) > length && strncmp(name, step->key, length) == 0 && name[length] == '"')
                return true;
        } else if (i == step->index) {
            return true;
        }
        skip_value(c);
    }
}

int json_line_of(const char *text, size_t size, const struct place *place)
{
    const struct place *steps[MAX_NESTED];
    int count = 0, line = 1;
    for (; place && count < MAX_NESTED; place = place->within)
        steps[count++] = place;
    struct cursor c = {text, text + size};
    const char *found = NULL;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        c.at += 3;
    if (place || count == 0)
        return 0;
    while (count > 0 && enter(&c, steps[count - 1], &found))
        count--;
    for (const char *at = text; found && at < found; at++)
        line += *at == '\n';
    return found ? line : 0;
}
