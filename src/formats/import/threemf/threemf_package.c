// threemf_package.c: reads the ZIP archive of a 3MF file with libzip, which is loaded on demand.
#include "fail.h"
#include "shown_name.h"
#include "threemf.h"

#ifdef HAVE_3MF

#include "dynamic_library.h"

#include <string.h>
#include <zip.h>

// The library's names in Debian 12 and in Debian 13. The functions used here are the same in both.
#define LIBRARY       "libzip.so.4"
#define NEWER_LIBRARY "libzip.so.5"

#define FUNCTIONS(each)                                                                                                \
    each(zip_source_buffer_create) each(zip_source_free) each(zip_open_from_source) each(zip_discard)                  \
        each(zip_error_init) each(zip_error_fini) each(zip_error_strerror) each(zip_error_code_zip)                    \
            each(zip_name_locate) each(zip_fopen_index) each(zip_fread) each(zip_fclose) each(zip_get_error)           \
                each(zip_file_get_error) each(zip_get_num_entries) each(zip_get_name)

struct zip_library {
    void *handle;
    FUNCTIONS(LIBRARY_MEMBER)
    zip_t *archive;
    size_t charged; // the bytes of libzip's list of entries, which count towards the memory limit
};

// --- checking the declared size before libzip allocates memory

enum { END_BYTES = 22, COMMENT_MAX = 65535, LOCATOR_BYTES = 20, END64_BYTES = 56, ENTRY_BYTES = 46 };
// The bytes that libzip uses for an entry of its list, without the entry's name.
enum { ENTRY_MEMORY = 512 };

static uint64_t little(const uint8_t *at, int bytes)
{
    uint64_t value = 0;
    for (int i = bytes - 1; i >= 0; i--)
        value = value << 8 | at[i];
    return value;
}

// Returns the number of entries declared by the end record at `end` in an archive.
static uint64_t entries_of(const uint8_t *bytes, size_t size, size_t end)
{
    uint64_t count = little(bytes + end + 10, 2);
    const uint8_t *locator = end >= LOCATOR_BYTES ? bytes + end - LOCATOR_BYTES : NULL;
    if (!locator || memcmp(locator, "PK\6\7", 4) != 0)
        return count;
    uint64_t at = little(locator + 8, 8);
    if (at > size || size - at < END64_BYTES || memcmp(bytes + at, "PK\6\6", 4) != 0)
        return count;
    uint64_t large = little(bytes + at + 32, 8);
    return count == 0xffff || large > count ? large : count; // 0xffff means that the ZIP64 record has the number
}

// Finds the largest number of entries that any end record declares, because libzip may use any of these records.
// Returns false if there is no end record.
static bool claimed_entries(const uint8_t *bytes, size_t size, uint64_t *out)
{
    bool found = false;
    *out = 0;
    if (size < END_BYTES)
        return false;
    size_t last = size - END_BYTES, first = last > COMMENT_MAX ? last - COMMENT_MAX : 0;
    for (size_t at = last + 1; at-- > first;) {
        if (memcmp(bytes + at, "PK\5\6", 4) != 0)
            continue;
        uint64_t count = entries_of(bytes, size, at);
        *out = count > *out ? count : *out;
        found = true;
    }
    return found;
}

static bool check_claims(struct threemf *file, uint64_t *entries)
{
    const struct import_source *source = file->source;
    if (!claimed_entries(source->bytes, source->size, entries))
        return fail(
            file->error, LAM_CANNOT_READ,
            source->size >= 2 && memcmp(source->bytes, "PK", 2) == 0
                ? "%s: the file is truncated: found %zu bytes of a ZIP archive, expected its list of entries at the end"
                : "%s: the file is not a ZIP archive, as a 3MF file is: found %zu bytes without a list of entries",
            source->name, source->size);
    return *entries <= source->size / ENTRY_BYTES ||
           fail(file->error, LAM_CANNOT_READ,
                "%s: its ZIP archive claims %llu entries, expected at most %zu in %zu bytes", source->name,
                (unsigned long long)*entries, source->size / ENTRY_BYTES, source->size);
}

// --- libzip

static bool open_library(struct threemf *file)
{
    struct zip_library *zip = arena_alloc_zeroed(file->scratch, sizeof *zip);
    if (!zip)
        return threemf_no_memory(file, sizeof *zip);
    static const char *const lacking = "lacks functions of libzip 1.7";
    const char *fault = library_open_functions(&zip->handle, NEWER_LIBRARY, true, LIBRARY_NAMES(FUNCTIONS), lacking);
    if (fault)
        fault = library_open_functions(&zip->handle, LIBRARY, true, LIBRARY_NAMES(FUNCTIONS), lacking);
    file->zip = fault ? NULL : zip;
    return !fault ||
           fail(file->error, LAM_UNSUPPORTED,
                "%s: reading 3MF needs " LIBRARY ", which %s (Debian's package libzip4, in Debian 13 libzip5)",
                file->source->name, fault);
}

static bool open_archive(struct threemf *file)
{
    struct zip_library *zip = file->zip;
    zip_error_t reason;
    zip->zip_error_init(&reason);
    zip_source_t *bytes = zip->zip_source_buffer_create(file->source->bytes, file->source->size, 0, &reason);
    zip->archive = bytes ? zip->zip_open_from_source(bytes, ZIP_RDONLY, &reason) : NULL;
    if (!zip->archive) {
        if (zip->zip_error_code_zip(&reason) == ZIP_ER_MEMORY)
            threemf_no_memory(file, 0);
        else
            fail(file->error, LAM_CANNOT_READ, "%s: the ZIP archive cannot be read: %s", file->source->name,
                 zip->zip_error_strerror(&reason));
        zip->zip_source_free(bytes);
    }
    zip->zip_error_fini(&reason);
    return zip->archive != NULL;
}

bool threemf_package_open(struct threemf *file)
{
    uint64_t entries;
    if (!check_claims(file, &entries) || !open_library(file))
        return false;
    size_t bytes = (size_t)entries * ENTRY_MEMORY;
    if (!call_charge(file->source->call, bytes))
        return threemf_no_memory(file, bytes);
    file->zip->charged = bytes;
    return open_archive(file);
}

void threemf_package_close(struct threemf *file)
{
    if (!file->zip)
        return;
    if (file->zip->archive)
        file->zip->zip_discard(file->zip->archive);
    call_refund(file->source->call, file->zip->charged);
    library_close(file->zip->handle);
}

// --- parts of the archive

static bool fail_part(struct threemf *file, const char *name, const char *why)
{
    char shown[SHOWN_NAME_SIZE];
    return fail(file->error, LAM_CANNOT_READ, "%s: its part %s cannot be read: %s", file->source->name,
                shown_name(name, shown), why);
}

// Returns the index of a part. Programs differ in the case of names, so a short list of entries is also searched
// case-insensitively. A long list is searched only by the hash of the exact name.
static zip_int64_t locate(const struct zip_library *zip, const char *name)
{
    enum { FEW = 1000 };
    zip_int64_t index = zip->zip_name_locate(zip->archive, name, ZIP_FL_ENC_GUESS);
    return index < 0 && zip->charged < (size_t)FEW * ENTRY_MEMORY
               ? zip->zip_name_locate(zip->archive, name, ZIP_FL_ENC_GUESS | ZIP_FL_NOCASE)
               : index;
}

const char *threemf_package_find(const struct threemf *file, const char *ending)
{
    zip_t *archive = file->zip->archive;
    const char *found = NULL;
    size_t tail = strlen(ending);
    for (zip_int64_t i = file->zip->zip_get_num_entries(archive, 0); i-- > 0;) {
        const char *name = file->zip->zip_get_name(archive, (zip_uint64_t)i, ZIP_FL_ENC_GUESS);
        size_t length = name ? strlen(name) : 0;
        if (length >= tail && strcmp(name + length - tail, ending) == 0 && (!found || strcmp(name, found) < 0))
            found = name;
    }
    return found;
}

static bool read_chunks(struct threemf *file, const char *name, zip_file_t *part, threemf_chunk_fn *take, void *user)
{
    // Parsing a byte of XML takes as long as decoding ten bytes of a picture.
    enum { CHUNK = THRESHOLD(128 << 10, 256), PARSING = 10 };
    const struct zip_library *zip = file->zip;
    struct call_control *call = file->source->call;
    uint8_t *chunk = arena_alloc(file->scratch, CHUNK);
    uint64_t size = 0;
    char shown[SHOWN_NAME_SIZE];
    if (!chunk)
        return threemf_no_memory(file, CHUNK);
    for (;;) {
        zip_int64_t got = zip->zip_fread(part, chunk, CHUNK);
        if (got < 0)
            return fail(file->error, LAM_CANNOT_READ, "%s: its part %s is damaged: %s", file->source->name,
                        shown_name(name, shown), zip->zip_error_strerror(zip->zip_file_get_error(part)));
        size += (uint64_t)got;
        if (file->part_limit && size > file->part_limit)
            return fail(file->error, LAM_CANNOT_READ, "%s: its part %s has more than %llu bytes", file->source->name,
                        shown_name(name, shown), (unsigned long long)file->part_limit);
        if (!call_unpack(call, PARSING * (uint64_t)got, file->error) ||
            (!call_should_continue(call) && !call_error(call, file->error)) ||
            !take(user, chunk, (size_t)got, got == 0))
            return false;
        if (got == 0)
            return true;
    }
}

bool threemf_package_read(struct threemf *file, const char *name, threemf_chunk_fn *take, void *user)
{
    const struct zip_library *zip = file->zip;
    name += *name == '/';
    zip_int64_t index = locate(zip, name);
    if (index < 0)
        return fail_part(file, name, "the archive has no part of this name");
    zip_file_t *part = zip->zip_fopen_index(zip->archive, (zip_uint64_t)index, 0);
    if (!part)
        return fail_part(file, name, zip->zip_error_strerror(zip->zip_get_error(zip->archive)));
    bool ok = read_chunks(file, name, part, take, user);
    zip->zip_fclose(part);
    return ok;
}

struct whole {
    struct threemf *file;
    struct threemf_rows bytes;
};

static bool keep_chunk(void *user, const void *bytes, size_t size, bool last)
{
    struct whole *whole = user;
    (void)last;
    if (!size)
        return true;
    struct threemf_rows *rows = &whole->bytes;
    if (!threemf_reserve(whole->file, rows, 1, rows->count + size))
        return false;
    memcpy((uint8_t *)rows->items + rows->count, bytes, size);
    rows->count += size;
    return true;
}

bool threemf_package_read_whole(struct threemf *file, const char *name, const uint8_t **bytes, size_t *size)
{
    struct whole whole = {.file = file};
    uint8_t *copy = NULL;
    bool ok = threemf_package_read(file, name, keep_chunk, &whole);
    if (ok) {
        copy = arena_alloc(file->scratch, whole.bytes.count);
        ok = copy || threemf_no_memory(file, whole.bytes.count);
    }
    if (ok && whole.bytes.count)
        memcpy(copy, whole.bytes.items, whole.bytes.count);
    *bytes = copy;
    *size = whole.bytes.count;
    threemf_rows_free(file, &whole.bytes);
    return ok;
}

#endif

// --- growing arrays that count towards the call's memory limit.

#ifdef HAVE_3MF

#include <stdlib.h>
#include <string.h>

bool threemf_no_memory(struct threemf *file, size_t bytes)
{
    return call_memory_error(file->source->call, bytes, file->error);
}

bool threemf_reserve(struct threemf *file, struct threemf_rows *rows, size_t size, size_t count)
{
    struct call_control *call = file->source->call;
    if (count <= rows->capacity)
        return true;
    size_t capacity = 2 * rows->capacity > count ? 2 * rows->capacity : count + 15, bytes;
    if (__builtin_mul_overflow(capacity, size, &bytes) || !call_charge(call, bytes))
        return threemf_no_memory(file, capacity);
    void *moved = realloc(rows->items, bytes);
    call_refund(call, moved ? rows->bytes : bytes);
    if (!moved)
        return threemf_no_memory(file, bytes);
    rows->items = moved;
    rows->capacity = capacity;
    rows->bytes = bytes;
    return true;
}

void *threemf_add(struct threemf *file, struct threemf_rows *rows, size_t size)
{
    if (!threemf_reserve(file, rows, size, rows->count + 1))
        return NULL;
    return memset((char *)rows->items + rows->count++ * size, 0, size);
}

void threemf_rows_free(struct threemf *file, struct threemf_rows *rows)
{
    call_refund(file->source->call, rows->bytes);
    free(rows->items);
    *rows = (struct threemf_rows){0};
}

#endif
