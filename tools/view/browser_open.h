// browser_open.h: opens an address in the user's browser.
#ifndef BROWSER_OPEN_H
#define BROWSER_OPEN_H

#include <stdbool.h>

// Returns whether the browser was started, which requires a display and xdg-open. Must be called before the sandbox is
// entered.
bool browser_open(const char *address);

#endif
