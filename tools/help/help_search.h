// help_search.h: finds subjects, commands, options and keys whose texts contain given words.
#ifndef HELP_SEARCH_H
#define HELP_SEARCH_H

#include <stdbool.h>

// Prints the heading, and a row for each entry whose name or summary contains all of the words. If there is no such
// entry, also searches details and prose. Returns false and prints nothing if this search finds nothing either.
bool help_search(int count, char **words, const char *heading);

#endif
