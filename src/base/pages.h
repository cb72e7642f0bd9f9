// pages.h: large blocks straight from the system, in huge pages where it gives them.
#ifndef PAGES_H
#define PAGES_H

#include <stddef.h>

// Whether memory is taken only when it is touched, so that much more may be asked for than will be used.
#if defined(__wasm__)
enum { PAGES_WHEN_TOUCHED = 0 };
#else
enum { PAGES_WHEN_TOUCHED = 1 };
#endif

// Fresh zeroed memory, page-aligned. `held` gets the size to give back. NULL when there is none.
void *pages_get(size_t bytes, size_t *held);
// The same in small pages: where perhaps little will be touched.
void *pages_get_sparse(size_t bytes, size_t *held);
void pages_free(void *pages, size_t held);
// Gives back what lies behind the first `bytes`, where that can be done.
void pages_trim(void *pages, size_t *held, size_t bytes);

// Bytes of memory that the machine has; SIZE_MAX where it does not tell. The system lends more than there is and kills
// the process that uses it: what asks for a lot asks this first.
size_t pages_of_machine(void);

#endif
