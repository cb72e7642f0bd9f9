// browser_open.h: opens an address in the user's browser.
#ifndef BROWSER_OPEN_H
#define BROWSER_OPEN_H

#include <stdbool.h>

// Returns whether a program runs that opens it: there is a display, and xdg-open. Before the sandbox.
bool browser_open(const char *address);

#endif
