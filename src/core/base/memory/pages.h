// pages.h: large blocks from the operating system, in huge pages if they are available.
#ifndef PAGES_H
#define PAGES_H

#include <stddef.h>

// Whether the system provides memory only on first access. If so, a caller may reserve much more memory than it uses.
#if defined(__wasm__)
enum { PAGES_WHEN_TOUCHED = 0 };
#else
enum { PAGES_WHEN_TOUCHED = 1 };
#endif

// Allocates zeroed, page-aligned memory. *held receives the size to pass to pages_free. Returns NULL if memory runs
// out.
void *pages_get(size_t bytes, size_t *held);
// Allocates small pages, for sparsely used blocks.
void *pages_get_sparse(size_t bytes, size_t *held);
void pages_free(void *pages, size_t held);
// Allocates memory that free() releases. Large blocks use huge pages. After free(), the C library may keep the memory
// for later allocations. The system then need not clear new memory.
void *pages_malloc(size_t bytes);
// With one system call, prepares the pages that contain `bytes` bytes at `at` for writing. Preparing each page at its
// first access would take three times as long. Some systems ignore the call.
void pages_prepare(void *at, size_t bytes);
// Releases the pages after the first `bytes` bytes, if the system supports this.
void pages_trim(void *pages, size_t *held, size_t bytes);

// Returns the size of the machine's memory in bytes, or SIZE_MAX if it is unknown. The system grants more memory than
// the machine has, and kills processes that use too much, so check this size before a large allocation.
size_t pages_of_machine(void);

#endif
