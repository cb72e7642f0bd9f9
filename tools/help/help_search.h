// help_search.h: finds subjects, commands, options and keys whose texts contain given words.
#ifndef HELP_SEARCH_H
#define HELP_SEARCH_H

#include <stdbool.h>

// Prints the heading, and a row for each entry whose name or summary contains all of the words. Searches the details of
// the entries if no entry matches. Prints nothing and returns false if this search also finds nothing.
bool help_search(int count, char **words, const char *heading);

#endif
