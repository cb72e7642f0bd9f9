// help_search.h: finds subjects, commands, options and keys whose texts contain given words.
#ifndef HELP_SEARCH_H
#define HELP_SEARCH_H

#include <stdbool.h>

// Prints the heading, and a row for each entry whose name or summary contains all of the words. If no entry matches,
// searches the details of the entries too. If this search also finds nothing, prints nothing and returns false.
bool help_search(int count, char **words, const char *heading);

#endif
