// help_search.c: searches the help for subjects, commands, options and keys.
#include "help_texts.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include <lambent/fields.h>

enum { TEXTS_MAX = 40 };

// The texts of one entry.
struct texts_of {
    const char *items[TEXTS_MAX];
    int count;
};

struct search {
    char **words;
    int count;
    const char *heading;
    bool whole; // whether to search details and prose in addition to names and summaries
    int found;
};

static void add(struct texts_of *texts, const char *text)
{
    if (text && texts->count < TEXTS_MAX)
        texts->items[texts->count++] = text;
}

// Returns whether a word of the text begins with the given word, ignoring case.
static bool begins_word(const char *text, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = text; *at; at++)
        if ((at == text || !isalnum((unsigned char)at[-1])) && strncasecmp(at, word, length) == 0)
            return true;
    return false;
}

static bool matches(const struct search *search, const struct texts_of *texts)
{
    int found = 0;
    for (int i = 0; i < search->count; i++) {
        bool any = false;
        for (int k = 0; k < texts->count; k++)
            any |= begins_word(texts->items[k], search->words[i]);
        found += any;
    }
    return found == search->count;
}

// Prints a row if the entry's texts match. Prints a heading before the first row of each kind.
static void try_row(struct search *search, const struct texts_of *texts, const char *heading, int *of_kind,
                    const char *name, const char *summary)
{
    char left[64];
    if (!matches(search, texts))
        return;
    if (!search->found++)
        printf("%s\n", search->heading);
    if (!(*of_kind)++)
        printf("\n%s\n", heading);
    snprintf(left, sizeof left, "  %s", name);
    help_row(left, HELP_COLUMN, HELP_WIDTH, summary);
}

static void search_options(struct search *search)
{
    int count = 0;
    for (const struct option *o = option_table; o->name; o++) {
        struct texts_of texts = {0};
        char name[40];
        if (o->now)
            continue;
        add(&texts, o->name);
        add(&texts, o->alias);
        add(&texts, o->others);
        add(&texts, o->also);
        add(&texts, o->summary);
        for (const struct choice *w = o->words; w && w->name; w++) {
            add(&texts, w->name);
            add(&texts, search->whole ? w->summary : NULL);
        }
        add(&texts, search->whole ? o->details : NULL);
        snprintf(name, sizeof name, "--%s", o->name);
        try_row(search, &texts, "Options:", &count, name, o->summary);
    }
}

static void search_keys(struct search *search, const lam_field *(*row)(int), const char *heading)
{
    int count = 0;
    for (int i = 0; row(i); i++) {
        struct texts_of texts = {0};
        add(&texts, row(i)->key);
        add(&texts, row(i)->summary);
        try_row(search, &texts, heading, &count, row(i)->key, row(i)->summary);
    }
}

static void search_commands(struct search *search)
{
    int count = 0;
    for (const struct command *c = command_table; c->name; c++) {
        struct texts_of texts = {0};
        add(&texts, c->name);
        add(&texts, c->operands);
        add(&texts, c->summary);
        try_row(search, &texts, "Commands:", &count, c->name, c->summary);
    }
}

static void search_topics(struct search *search)
{
    int count = 0;
    for (const struct topic *t = topics; t->name; t++) {
        struct texts_of texts = {0};
        add(&texts, t->name);
        add(&texts, t->title);
        add(&texts, search->whole ? t->text : NULL);
        try_row(search, &texts, "Subjects:", &count, t->name, t->title);
    }
}

bool help_search(int count, char **words, const char *heading)
{
    struct search search = {.words = words, .count = count, .heading = heading};
    for (int pass = 0; pass < 2 && !search.found; pass++) {
        search.whole = pass;
        search_topics(&search);
        search_commands(&search);
        search_options(&search);
        search_keys(&search, lam_light_field, "Keys of lights (lambent help lights):");
        search_keys(&search, lam_material_field, "Keys of materials (lambent help materials):");
    }
    if (search.found)
        printf("\nMore: lambent help NAME\n");
    return search.found;
}
