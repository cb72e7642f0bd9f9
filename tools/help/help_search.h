// help_search.h: searches for subjects, commands, options and keys whose texts contain given words.
#ifndef HELP_SEARCH_H
#define HELP_SEARCH_H

#include <stdbool.h>

// Prints the heading, and a row for each that contains all of the words: by names and summaries, else by any of its text. False:
// none does, and nothing is printed.
bool help_search(int count, char **words, const char *heading);

#endif
