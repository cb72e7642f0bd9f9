// failing_memory.c: allocations and reads that fail on request. All counters are atomic: threads allocate too.
#include "failing_memory.h"

#include <errno.h>
#include <link.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

static long fail_number = -1, requests, blocks, mapped;
static int fail_onwards, failed;
static uintptr_t spared_from, spared_to;
static size_t read_most;
static long read_end = -1;
static int read_error, read_ended;

void memory_fail_at(long number, bool onwards)
{
    __atomic_store_n(&fail_number, -1, __ATOMIC_SEQ_CST);
    __atomic_store_n(&fail_onwards, onwards, __ATOMIC_SEQ_CST);
    __atomic_store_n(&requests, 0, __ATOMIC_SEQ_CST);
    __atomic_store_n(&failed, 0, __ATOMIC_SEQ_CST);
    __atomic_store_n(&fail_number, number, __ATOMIC_SEQ_CST);
}

long memory_requests(void) { return __atomic_load_n(&requests, __ATOMIC_SEQ_CST); }
bool memory_failed(void) { return __atomic_load_n(&failed, __ATOMIC_SEQ_CST); }

struct memory_held memory_held(void)
{
#ifdef WRAPPED
    return (struct memory_held){0, __atomic_load_n(&mapped, __ATOMIC_SEQ_CST)};
#else
    return (struct memory_held){__atomic_load_n(&blocks, __ATOMIC_SEQ_CST), __atomic_load_n(&mapped, __ATOMIC_SEQ_CST)};
#endif
}

static int find_library(struct dl_phdr_info *library, size_t size, void *user)
{
    (void)size;
    if (!strstr(library->dlpi_name, user))
        return 0;
    spared_from = spared_to = library->dlpi_addr;
    for (int i = 0; i < library->dlpi_phnum; i++) {
        uintptr_t end = library->dlpi_addr + library->dlpi_phdr[i].p_vaddr + library->dlpi_phdr[i].p_memsz;
        if (library->dlpi_phdr[i].p_type == PT_LOAD && end > spared_to)
            spared_to = end;
    }
    return 1;
}

void memory_spare(const char *library) { dl_iterate_phdr(find_library, (void *)(uintptr_t)library); }

// A function for a debugger's breakpoint.
__attribute__((noinline)) static void request_fails(void)
{
    __atomic_store_n(&failed, 1, __ATOMIC_SEQ_CST);
    errno = ENOMEM;
}

// Whether this request fails. `caller`: the code that it returns to.
static bool refuse(const void *caller)
{
    if ((uintptr_t)caller >= spared_from && (uintptr_t)caller < spared_to)
        return false;
    long number = __atomic_fetch_add(&requests, 1, __ATOMIC_SEQ_CST),
         wanted = __atomic_load_n(&fail_number, __ATOMIC_SEQ_CST);
    if (wanted < 0 || (number != wanted && !(number > wanted && __atomic_load_n(&fail_onwards, __ATOMIC_SEQ_CST))))
        return false;
    request_fails();
    return true;
}

static void *count(void *block)
{
    if (block)
        __atomic_fetch_add(&blocks, 1, __ATOMIC_SEQ_CST);
    return block;
}

#ifdef WRAPPED // by the linker's --wrap
#define NAME(function) __wrap_##function
#define REAL(function) __real_##function
void *__real_malloc(size_t size);
void *__real_calloc(size_t number, size_t size);
void *__real_realloc(void *block, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *block);
#define real_memalign __real_aligned_alloc
#else // the names themselves, which replace glibc's
#define NAME(function) function
#define REAL(function) __libc_##function
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t number, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *block);
#define real_memalign  __libc_memalign
#endif

#pragma GCC visibility push(default) // libraries get them too
void *NAME(malloc)(size_t size);
void *NAME(calloc)(size_t number, size_t size);
void *NAME(realloc)(void *block, size_t size);
void *NAME(aligned_alloc)(size_t alignment, size_t size);
int NAME(posix_memalign)(void **block, size_t alignment, size_t size);
void NAME(free)(void *block);
void *NAME(mmap)(void *at, size_t size, int protection, int flags, int file, off_t offset);
int NAME(munmap)(void *at, size_t size);
ssize_t NAME(read)(int file, void *to, size_t size);
ssize_t NAME(pread)(int file, void *to, size_t size, off_t offset);
#pragma GCC visibility pop

void *NAME(malloc)(size_t size) { return refuse(__builtin_return_address(0)) ? NULL : count(REAL(malloc)(size)); }

void *NAME(calloc)(size_t number, size_t size)
{
    return refuse(__builtin_return_address(0)) ? NULL : count(REAL(calloc)(number, size));
}

void *NAME(realloc)(void *block, size_t size)
{
    if (refuse(__builtin_return_address(0)))
        return NULL;
    void *larger = REAL(realloc)(block, size);
    if (!block)
        return count(larger);
    if (!larger && size == 0)
        __atomic_fetch_sub(&blocks, 1, __ATOMIC_SEQ_CST);
    return larger;
}

void *NAME(aligned_alloc)(size_t alignment, size_t size)
{
    return refuse(__builtin_return_address(0)) ? NULL : count(real_memalign(alignment, size));
}

int NAME(posix_memalign)(void **block, size_t alignment, size_t size)
{
    if (refuse(__builtin_return_address(0)))
        return ENOMEM;
    *block = count(real_memalign(alignment, size));
    return *block ? 0 : ENOMEM;
}

void NAME(free)(void *block)
{
    if (block)
        __atomic_fetch_sub(&blocks, 1, __ATOMIC_SEQ_CST);
    REAL(free)(block);
}

void *NAME(mmap)(void *at, size_t size, int protection, int flags, int file, off_t offset)
{
    if (refuse(__builtin_return_address(0)))
        return MAP_FAILED;
    void *pages = (void *)syscall(SYS_mmap, at, size, protection, flags, file, offset); // NOLINT: the kernel's pointer
    if (pages != MAP_FAILED)
        __atomic_fetch_add(&mapped, (long)size, __ATOMIC_SEQ_CST);
    return pages;
}

int NAME(munmap)(void *at, size_t size)
{
    __atomic_fetch_sub(&mapped, (long)size, __ATOMIC_SEQ_CST);
    return (int)syscall(SYS_munmap, at, size);
}

// --- reads

void reads_return_at_most(size_t bytes) { read_most = bytes; }

void reads_end_at(long offset, bool error)
{
    read_end = offset;
    read_error = error;
    read_ended = 0;
}

bool reads_ended(void) { return read_ended; }

// The number of bytes that a read at an offset may return; −1 means an error with errno, and 0 means the end.
static ssize_t allowed(size_t size, off_t offset)
{
    if (read_end >= 0 && offset + (off_t)size > read_end) {
        if (offset >= read_end) {
            read_ended = 1;
            errno = EIO;
            return read_error ? -1 : 0;
        }
        size = (size_t)(read_end - offset);
    }
    return (ssize_t)(read_most && size > read_most ? read_most : size);
}

ssize_t NAME(pread)(int file, void *to, size_t size, off_t offset)
{
    ssize_t most = size ? allowed(size, offset) : 0;
    return most <= 0 ? most : syscall(SYS_pread64, file, to, (size_t)most, offset);
}

ssize_t NAME(read)(int file, void *to, size_t size)
{
    off_t offset = lseek(file, 0, SEEK_CUR);
    ssize_t most = size ? allowed(size, offset < 0 ? 0 : offset) : 0; // a pipe has no offset
    return most <= 0 ? most : syscall(SYS_read, file, to, (size_t)most);
}

#ifdef WRAPPED // the names that headers give to two of them if offsets have 64 bits

void *__wrap_mmap64(void *at, size_t size, int protection, int flags, int file, off_t offset);
ssize_t __wrap_pread64(int file, void *to, size_t size, off_t offset);

void *__wrap_mmap64(void *at, size_t size, int protection, int flags, int file, off_t offset)
{
    return __wrap_mmap(at, size, protection, flags, file, offset);
}

ssize_t __wrap_pread64(int file, void *to, size_t size, off_t offset) { return __wrap_pread(file, to, size, offset); }

#endif
