// browser_open.h: opens an address in the user's browser.
#ifndef BROWSER_OPEN_H
#define BROWSER_OPEN_H

#include <stdbool.h>

// Starting a browser needs a display and xdg-open. Returns whether the browser was started. Call this function before
// the sandbox is entered.
bool browser_open(const char *address);

#endif
