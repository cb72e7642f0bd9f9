// help_search.h: finds subjects, commands, options and keys whose texts contain given words.
#ifndef HELP_SEARCH_H
#define HELP_SEARCH_H

#include <stdbool.h>

// Prints the heading, and a row for each entry that contains all of the words in its name or summary, or else in any of
// its text. Returns false and prints nothing if there is none.
bool help_search(int count, char **words, const char *heading);

#endif
