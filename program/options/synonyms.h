// synonyms.h: replaces the words of other programs in a command line by Lambent's own words.
#ifndef SYNONYMS_H
#define SYNONYMS_H

#include "command_table.h"

// A command line in Lambent's own words. The caller frees it with synonyms_free.
struct own_words {
    char **words; // ends with NULL
    int count;
    char **made; // the strings that `words` contains and the given command line does not
    int made_count;
};

// Replaces the synonyms that the rows of options and commands list (option.also, command.also): `--bg white` becomes
// `--background white`, `stats a.stl` becomes `info a.stl`, and `a.stl -o a.glb` becomes `convert a.stl a.glb`. `given`
// excludes the program's name. Fails only if memory runs out, with LAM_MACHINE, or with LAM_BAD_ARGUMENT for an option
// that Lambent lacks and for which it knows an answer.
bool synonyms_replace(int count, char **given, struct own_words *own, lam_error *error);
void synonyms_free(struct own_words *own);

// Finds the option that a synonym means, among the options that a command with these groups accepts. Sets `meaning` to
// the value that the synonym means: "" if the synonym only renames the option. Returns NULL if there is none.
enum { MEANING_SIZE = 40 };
const struct option *synonym_option(const char *name, uint64_t groups, char meaning[MEANING_SIZE]);
const struct command *synonym_command(const char *name); // NULL if the word is no synonym of a command

// The text before option.also in the help.
#define OTHER_NAMES "Other names (NAME=VALUE also sets the value): "

#endif
