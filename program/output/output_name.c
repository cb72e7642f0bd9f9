// output_name.c: expands the patterns for names of pictures.
#include "output_name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "joined_models.h"

static const struct {
    const char *name;
    unsigned bit; // 0 if the placeholder always has a value
} words[] = {
    {"stem", 0},         {"ext", 0},          {"dir", 0},           {"view", NAME_VIEW}, {"azimuth", NAME_VIEW},
    {"show", NAME_VIEW}, {"size", NAME_SIZE}, {"frame", NAME_FRAME}};

enum { WORDS = sizeof words / sizeof words[0] };

bool output_name_is_pattern(const char *name) { return name && strpbrk(name, "{}"); }

// A part of a pattern: literal text or a placeholder.
struct part {
    const char *text; // literal text, or a word's name
    int length;
    bool placeholder;
};

// Removes the next part from the start of a pattern. Returns false at the end of the pattern (*pattern is then "") or
// at an unmatched brace.
static bool next_part(const char **pattern, struct part *part)
{
    const char *at = *pattern;
    if ((at[0] == '{' || at[0] == '}') && at[1] == at[0]) {
        *part = (struct part){at, 1, false};
        *pattern = at + 2;
    } else if (at[0] == '{' && at[1 + strcspn(at + 1, "{}")] == '}') {
        *part = (struct part){at + 1, (int)strcspn(at + 1, "}"), true};
        *pattern = at + part->length + 2;
    } else if (at[0] && at[0] != '{' && at[0] != '}') {
        *part = (struct part){at, (int)strcspn(at, "{}"), false};
        *pattern = at + part->length;
    } else {
        return false;
    }
    return true;
}

static bool is_placeholder(const struct part *part, const char *name)
{
    return part->placeholder && (int)strlen(name) == part->length &&
           memcmp(part->text, name, (size_t)part->length) == 0;
}

bool output_name_has(const char *pattern, const char *placeholder)
{
    struct part part;
    while (next_part(&pattern, &part))
        if (is_placeholder(&part, placeholder))
            return true;
    return false;
}

bool output_name_check(const char *pattern, unsigned known, lam_error *error)
{
    struct part part;
    while (next_part(&pattern, &part)) {
        bool found = !part.placeholder;
        char list[100] = "";
        for (int i = 0; i < WORDS; i++) {
            if (words[i].bit && !(known & words[i].bit))
                continue;
            found |= is_placeholder(&part, words[i].name);
            size_t used = strlen(list);
            snprintf(list + used, sizeof list - used, "%s{%s}", used ? ", " : "", words[i].name);
        }
        if (!found)
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '--output': found '{%.*s}' in the name, expected one of %s; '{{' is a brace",
                            part.length < 60 ? part.length : 60, part.text, list);
    }
    return !*pattern ||
           complain(
               error, LAM_BAD_ARGUMENT,
               "option '--output': found '%.60s' in the name, an unmatched brace; write '%c%c' for a literal brace",
               pattern, *pattern, *pattern);
}

const char *output_stem(const char *model, int *length)
{
    const char *name = strcmp(model, "-") == 0 ? "model" : model;
    const char *next = joined_models_next(name);
    const char *end = next ? next - strlen(JOINED_MODELS) : name + strlen(name);
    while (end > name && end[-1] == '/') // if the model's path is a folder, loading the model reports the error
        end--;
    const char *start = end;
    while (start > name && start[-1] != '/')
        start--;
    const char *dot = end;
    while (dot > start && *dot != '.')
        dot--;
    *length = (int)((dot > start ? dot : end) - start);
    if (*length)
        return start;
    *length = (int)strlen("model");
    return "model";
}

// Prints the path of the model's folder, relative to the root and without ".", ".." and a leading "/".
static void print_folder(FILE *out, const struct output_words *w)
{
    size_t root = w->root ? strlen(w->root) : 0;
    const char *at = w->model, *slash = strrchr(at, '/');
    if (root && strncmp(at, w->root, root) == 0 && (at[root] == '/' || w->root[root - 1] == '/'))
        at += root;
    bool first = true;
    while (slash && at < slash) {
        size_t length = strcspn(at, "/");
        bool dots = (length == 1 || length == 2) && at[0] == '.' && at[length - 1] == '.';
        if (length && !dots) {
            fprintf(out, "%s%.*s", first ? "" : "/", (int)length, at);
            first = false;
        }
        at += length + 1;
    }
}

static void print_word(FILE *out, const struct part *part, const struct output_words *w)
{
    if (is_placeholder(part, "stem")) {
        int length;
        const char *stem = output_stem(w->model, &length);
        fwrite(stem, 1, (size_t)length, out);
    } else if (is_placeholder(part, "ext")) {
        int length;
        const char *end = output_stem(w->model, &length) + length;
        if (strcmp(w->model, "-") != 0 && *end == '.')
            fputs(end + 1, out);
    } else if (is_placeholder(part, "dir")) {
        print_folder(out, w);
    } else if (is_placeholder(part, "view")) {
        fputs(w->view ? w->view : "", out);
    } else if (is_placeholder(part, "show")) {
        fputs(w->show ? w->show : "", out);
    } else if (is_placeholder(part, "azimuth")) {
        fprintf(out, "%.6g", w->azimuth_deg);
    } else if (is_placeholder(part, "size") && w->width == w->height) {
        fprintf(out, "%d", w->width);
    } else if (is_placeholder(part, "size")) {
        fprintf(out, "%dx%d", w->width, w->height);
    } else if (is_placeholder(part, "frame") && w->frame == OUTPUT_FRAME_OPEN) {
        fputs("{frame}", out);
    } else if (is_placeholder(part, "frame")) {
        fprintf(out, "%0*d", w->digits > 0 ? w->digits : 1, w->frame);
    }
}

char *output_name_expand(const char *pattern, const struct output_words *w)
{
    char *name = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&name, &size);
    if (!out)
        return NULL;
    struct part part;
    while (next_part(&pattern, &part)) {
        long before = ftell(out);
        if (part.placeholder)
            print_word(out, &part, w);
        else
            fwrite(part.text, 1, (size_t)part.length, out);
        if (is_placeholder(&part, "dir") && ftell(out) == before && *pattern == '/')
            pattern++;
    }
    if (fclose(out) == 0)
        return name;
    free(name);
    return NULL;
}
