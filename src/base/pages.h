// pages.h: large blocks straight from the system, in huge pages where it gives them.
#ifndef PAGES_H
#define PAGES_H

#include <stddef.h>

// Fresh zeroed memory, page-aligned. `held` gets the size to give back. NULL when there is none.
void *pages_get(size_t bytes, size_t *held);
void pages_free(void *pages, size_t held);

#endif
