// pages.c: large blocks from the operating system, in huge pages if they are available.
#include "pages.h"

#include <stdint.h>
#include <stdlib.h>

#if defined(__wasm__)

void *pages_get(size_t bytes, size_t *held)
{
    *held = bytes;
    return calloc(1, bytes ? bytes : 1);
}

void *pages_get_sparse(size_t bytes, size_t *held) { return pages_get(bytes, held); }

void *pages_malloc(size_t bytes) { return aligned_alloc(64, (bytes + 63) / 64 * 64); }

void pages_free(void *pages, size_t held)
{
    (void)held;
    free(pages);
}

void pages_prepare(void *at, size_t bytes)
{
    (void)at;
    (void)bytes;
}

void pages_trim(void *pages, size_t *held, size_t bytes)
{
    (void)pages;
    (void)held;
    (void)bytes;
}

size_t pages_of_machine(void) { return SIZE_MAX; }

#else

#include <sys/mman.h>
#include <unistd.h>

enum { PAGE = 4096, HUGE_PAGE = 2 << 20 };

static void *map(size_t size)
{
    void *pages = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return pages == MAP_FAILED ? NULL : pages;
}

static size_t whole_pages(size_t bytes) { return bytes ? (bytes + PAGE - 1) / PAGE * PAGE : PAGE; }

void *pages_get_sparse(size_t bytes, size_t *held)
{
    if (bytes > SIZE_MAX / 2)
        return NULL;
    *held = whole_pages(bytes);
    return map(*held);
}

// A block of at least one huge page is aligned to the size of huge pages. The kernel then uses huge pages from the
// first access. The first accesses therefore take a third of the time that they take with small pages. The size is
// rounded up to whole huge pages if this wastes at most a sixteenth of the memory, because a program accesses one huge
// page faster than hundreds of small pages.
void *pages_get(size_t bytes, size_t *held)
{
    if (bytes > SIZE_MAX / 2)
        return NULL;
    size_t size = whole_pages(bytes), slack = size >= HUGE_PAGE ? HUGE_PAGE : 0, rest = size % HUGE_PAGE;
    if (slack && rest && HUGE_PAGE - rest <= size / 16)
        size += HUGE_PAGE - rest;
    uint8_t *pages = map(size + slack);
    if (!pages)
        return NULL;
    if (slack) {
        size_t before = (HUGE_PAGE - (uintptr_t)pages % HUGE_PAGE) % HUGE_PAGE;
        if (before)
            munmap(pages, before);
        if (slack - before)
            munmap(pages + before + size, slack - before);
        pages += before;
#ifdef MADV_HUGEPAGE
        madvise(pages, size, MADV_HUGEPAGE);
#endif
    }
    *held = size;
    return pages;
}

void *pages_malloc(size_t bytes)
{
    if (bytes < HUGE_PAGE || bytes > SIZE_MAX - HUGE_PAGE)
        return malloc(bytes);
    size_t rounded = (bytes + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
    void *pages = aligned_alloc(HUGE_PAGE, rounded);
#ifdef MADV_HUGEPAGE
    // The last page becomes a huge page only if this wastes at most a sixteenth of the memory. If the system does not
    // follow this advice, only the speed is affected.
    if (pages)
        madvise(pages, rounded - bytes <= bytes / 16 ? rounded : rounded - HUGE_PAGE, MADV_HUGEPAGE);
#endif
    return pages;
}

void pages_free(void *pages, size_t held)
{
    if (pages)
        munmap(pages, held);
}

void pages_prepare(void *at, size_t bytes)
{
#ifdef MADV_POPULATE_WRITE
    const size_t before = (uintptr_t)at % PAGE;
    if (bytes > PAGE)
        madvise((uint8_t *)at - before, before + bytes, MADV_POPULATE_WRITE);
#else
    (void)at;
    (void)bytes;
#endif
}

void pages_trim(void *pages, size_t *held, size_t bytes)
{
    size_t kept = whole_pages(bytes);
    if (kept >= *held)
        return;
    munmap((uint8_t *)pages + kept, *held - kept);
    *held = kept;
}

size_t pages_of_machine(void)
{
    long count = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return count > 0 && size > 0 ? (size_t)count * (size_t)size : SIZE_MAX;
}

#endif
