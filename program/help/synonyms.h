// synonyms.h: replaces the words of other programs in a command line by Lambent's own words.
#ifndef SYNONYMS_H
#define SYNONYMS_H

#include "command_table.h"

// Replaces the synonyms that the rows of options and commands list (option.also, command.also): `--bg white` becomes
// `--background white`, `stats a.stl` becomes `info a.stl`, and `a.stl -o a.glb` becomes `convert a.stl a.glb`. `given`
// excludes the program's name. Returns the words, which end with NULL and which the caller frees with free(), and sets
// `count`. Returns NULL if memory runs out (LAM_MACHINE), or for an option that Lambent lacks and for which it knows an
// answer (LAM_BAD_ARGUMENT).
char **synonyms_replace(int *count, char **given, lam_error *error);

// Finds the option that a synonym means, among the options that a command with these groups accepts. Sets `meaning` to
// the value that the synonym means: "" if the synonym only renames the option. Returns NULL if there is none.
enum { MEANING_SIZE = 40 };
const struct option *synonym_option(const char *name, uint64_t groups, char meaning[MEANING_SIZE]);
const struct command *synonym_command(const char *name); // NULL if the word is no synonym of a command

// The text before option.also in the help.
#define OTHER_NAMES "Other names (NAME=VALUE also sets the value): "

#endif
