// threemf_package.c: reads the ZIP archive of a 3MF file. zlib unpacks its parts.
#include "fail.h"
#include "shown_name.h"
#include "threemf.h"

#ifdef HAVE_3MF

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>

enum { END_BYTES = 22, COMMENT_MAX = 65535, LOCATOR_BYTES = 20, END64_BYTES = 56, ENTRY_BYTES = 46, LOCAL_BYTES = 30 };
enum { STORED = 0, DEFLATED = 8 }; // methods
enum { ENCRYPTED = 1 };            // flag

// A part: `at` is the position of its local header in the file.
struct entry {
    const char *name;
    uint64_t at, packed, size;
    uint32_t crc;
    uint16_t method, flags;
};

// The list of entries at the end of the archive. `shift` is the number of bytes before the archive, which its positions
// do not count.
struct directory {
    uint64_t count, at, size, shift;
};

static uint64_t little(const uint8_t *at, int bytes)
{
    uint64_t value = 0;
    for (int i = bytes - 1; i >= 0; i--)
        value = value << 8 | at[i];
    return value;
}

// --- the list of entries

// Reads the end record at `end`, and the ZIP64 record before it. Returns false if the list does not lie before them.
static bool directory_at(const uint8_t *bytes, size_t size, size_t end, struct directory *out)
{
    uint64_t count = little(bytes + end + 10, 2), length = little(bytes + end + 12, 4),
             at = little(bytes + end + 16, 4);
    uint64_t stop = end;
    const uint8_t *locator = end >= LOCATOR_BYTES ? bytes + end - LOCATOR_BYTES : NULL;
    if (locator && memcmp(locator, "PK\6\7", 4) == 0) {
        uint64_t record = little(locator + 8, 8);
        if (record > end || end - record < LOCATOR_BYTES + END64_BYTES || memcmp(bytes + record, "PK\6\6", 4) != 0)
            return false;
        count = little(bytes + record + 32, 8);
        length = little(bytes + record + 40, 8);
        at = little(bytes + record + 48, 8);
        stop = record;
    }
    *out = (struct directory){count, at, length, 0};
    if (length > stop || at > stop)
        return false;
    if (count && stop - length >= at && size - (stop - length) >= 4 &&
        memcmp(bytes + (stop - length), "PK\1\2", 4) == 0) {
        out->at = stop - length;
        out->shift = out->at - at;
    }
    return length <= stop - out->at;
}

// Finds the last end record that fits. `claimed` receives the largest number of entries that an end record declares.
static bool find_directory(struct threemf *file, struct directory *out)
{
    const struct import_source *source = file->source;
    const uint8_t *bytes = source->bytes;
    const size_t size = source->size, last = size < END_BYTES ? 0 : size - END_BYTES;
    const size_t first = last > COMMENT_MAX ? last - COMMENT_MAX : 0;
    bool found = false;
    for (size_t at = last + 1; size >= END_BYTES && at-- > first;) {
        if (memcmp(bytes + at, "PK\5\6", 4) != 0)
            continue;
        found = true;
        if (directory_at(bytes, size, at, out))
            return out->count <= size / ENTRY_BYTES ||
                   fail(file->error, LAM_CANNOT_READ,
                        "%s: its ZIP archive claims %llu entries, expected at most %zu in %zu bytes", source->name,
                        (unsigned long long)out->count, size / ENTRY_BYTES, size);
    }
    if (found)
        return fail(file->error, LAM_CANNOT_READ,
                    "%s: the ZIP archive cannot be read: found its end, but its list of entries is not before it",
                    source->name);
    return fail(
        file->error, LAM_CANNOT_READ,
        size >= 2 && memcmp(bytes, "PK", 2) == 0
            ? "%s: the file is truncated: found %zu bytes of a ZIP archive, expected its list of entries at the end"
            : "%s: the file is not a ZIP archive, as a 3MF file is: found %zu bytes without a list of entries",
        source->name, size);
}

// Numbers that do not fit into 32 bits stand in the ZIP64 field of the extra data.
static void read_large(struct entry *e, const uint8_t *extra, size_t size)
{
    uint64_t *const members[] = {&e->size, &e->packed, &e->at};
    while (size >= 4) {
        size_t length = (size_t)little(extra + 2, 2);
        if (length > size - 4)
            return;
        if (little(extra, 2) == 1) {
            const uint8_t *at = extra + 4;
            for (size_t i = 0; i < 3; i++)
                if (*members[i] == UINT32_MAX && at + 8 <= extra + 4 + length) {
                    *members[i] = little(at, 8);
                    at += 8;
                }
            return;
        }
        extra += 4 + length;
        size -= 4 + length;
    }
}

static bool add_entry(struct threemf *file, const uint8_t *record, size_t name, size_t extra, uint64_t shift)
{
    struct entry *e = threemf_add(file, &file->entries, sizeof *e);
    char *copy = e ? arena_alloc(file->scratch, name + 1) : NULL;
    if (!copy)
        return threemf_no_memory(file, name + 1);
    memcpy(copy, record + ENTRY_BYTES, name);
    copy[name] = 0;
    *e = (struct entry){.name = copy,
                        .flags = (uint16_t)little(record + 8, 2),
                        .method = (uint16_t)little(record + 10, 2),
                        .crc = (uint32_t)little(record + 16, 4),
                        .packed = little(record + 20, 4),
                        .size = little(record + 24, 4),
                        .at = little(record + 42, 4)};
    read_large(e, record + ENTRY_BYTES + name, extra);
    e->at += shift;
    return name_table_add(&file->entry_names, copy, (int32_t)file->entries.count - 1) || threemf_no_memory(file, 0);
}

bool threemf_package_open(struct threemf *file)
{
    struct directory list = {0};
    if (!find_directory(file, &list))
        return false;
    const uint8_t *at = file->source->bytes + list.at;
    size_t left = (size_t)list.size;
    for (uint64_t i = 0; i < list.count; i++) {
        size_t name = left < ENTRY_BYTES ? 0 : (size_t)little(at + 28, 2);
        size_t extra = left < ENTRY_BYTES ? 0 : (size_t)little(at + 30, 2);
        size_t length = ENTRY_BYTES + name + extra + (left < ENTRY_BYTES ? 0 : (size_t)little(at + 32, 2));
        if (length > left || memcmp(at, "PK\1\2", 4) != 0)
            return fail(file->error, LAM_CANNOT_READ,
                        "%s: the ZIP archive cannot be read: its list of entries is damaged after %llu of %llu entries",
                        file->source->name, (unsigned long long)i, (unsigned long long)list.count);
        if (!add_entry(file, at, name, extra, list.shift))
            return false;
        at += length;
        left -= length;
    }
    return true;
}

void threemf_package_close(struct threemf *file) { threemf_rows_free(file, &file->entries); }

// --- parts of the archive

static bool fail_part(struct threemf *file, const char *name, const char *why)
{
    char shown[SHOWN_NAME_SIZE];
    return fail(file->error, LAM_CANNOT_READ, "%s: its part %s cannot be read: %s", file->source->name,
                shown_name(name, shown), why);
}

// Returns a part, or NULL. Programs differ in the case of names, so a short list of entries is also searched
// case-insensitively. A long list is searched only by the hash of the exact name.
static const struct entry *locate(const struct threemf *file, const char *name)
{
    enum { FEW = 1000 };
    const struct entry *entries = file->entries.items;
    int32_t index = name_table_find(&file->entry_names, name);
    for (size_t i = 0; index < 0 && file->entries.count < FEW && i < file->entries.count; i++)
        index = strcasecmp(entries[i].name, name) == 0 ? (int32_t)i : -1;
    return index < 0 ? NULL : &entries[index];
}

const char *threemf_package_find(const struct threemf *file, const char *ending)
{
    const struct entry *entries = file->entries.items;
    const char *found = NULL;
    size_t tail = strlen(ending);
    for (size_t i = file->entries.count; i-- > 0;) {
        const char *name = entries[i].name;
        size_t length = strlen(name);
        if (length >= tail && strcmp(name + length - tail, ending) == 0 && (!found || strcmp(name, found) < 0))
            found = name;
    }
    return found;
}

// A part that is being unpacked.
struct unpacking {
    const uint8_t *at;
    uint64_t left, made; // bytes: packed and not read yet, and unpacked
    uint32_t crc;
    z_stream inflate;
    const char *why; // why the part is damaged, or NULL
};

// Unpacks up to `size` bytes, and returns their number; 0 at the end.
static size_t unpack(struct unpacking *u, const struct entry *e, uint8_t *out, size_t size)
{
    size_t got = 0;
    int state = Z_OK;
    while (got < size && !u->why && state == Z_OK) {
        uInt some = u->left < UINT16_MAX ? (uInt)u->left : UINT16_MAX;
        if (e->method == STORED) {
            some = some < size - got ? some : (uInt)(size - got);
            memcpy(out + got, u->at, some);
            got += some;
            state = some == u->left ? Z_STREAM_END : Z_OK;
        } else {
            u->inflate.next_in = (Bytef *)(uintptr_t)u->at;
            u->inflate.avail_in = some;
            u->inflate.next_out = out + got;
            u->inflate.avail_out = (uInt)(size - got);
            state = inflate(&u->inflate, Z_NO_FLUSH);
            got = size - u->inflate.avail_out;
            if (state == Z_BUF_ERROR && !u->left)
                u->why = "its data ends too early";
            else if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
                u->why = u->inflate.msg ? u->inflate.msg : "its data is not in the format deflate";
            some -= u->inflate.avail_in;
        }
        u->at += some;
        u->left -= some;
    }
    u->made += got;
    u->crc = (uint32_t)crc32(u->crc, out, (uInt)got);
    if (!got && !u->why && (u->made != e->size || u->crc != e->crc))
        u->why = u->made != e->size ? "its size differs from the list of entries" : "its checksum (CRC) is wrong";
    return got;
}

static bool read_chunks(struct threemf *file, const struct entry *e, struct unpacking *u, threemf_chunk_fn *take,
                        void *user)
{
    // Parsing a byte of XML takes as long as decoding ten bytes of a picture.
    enum { CHUNK = THRESHOLD(128 << 10, 256), PARSING = 10 };
    struct call_control *call = file->source->call;
    uint8_t *chunk = arena_alloc(file->scratch, CHUNK);
    char shown[SHOWN_NAME_SIZE];
    if (!chunk)
        return threemf_no_memory(file, CHUNK);
    for (;;) {
        size_t got = unpack(u, e, chunk, CHUNK);
        if (u->why)
            return fail(file->error, LAM_CANNOT_READ, "%s: its part %s is damaged: %s", file->source->name,
                        shown_name(e->name, shown), u->why);
        if (file->part_limit && u->made > file->part_limit)
            return fail(file->error, LAM_CANNOT_READ, "%s: its part %s has more than %llu bytes", file->source->name,
                        shown_name(e->name, shown), (unsigned long long)file->part_limit);
        if (!call_unpack(call, PARSING * (uint64_t)got, file->error) ||
            (!call_should_continue(call) && !call_error(call, file->error)) || !take(user, chunk, got, got == 0))
            return false;
        if (got == 0)
            return true;
    }
}

bool threemf_package_read(struct threemf *file, const char *name, threemf_chunk_fn *take, void *user)
{
    const struct import_source *source = file->source;
    name += *name == '/';
    const struct entry *e = locate(file, name);
    if (!e)
        return fail_part(file, name, "the archive has no part of this name");
    if (e->flags & ENCRYPTED)
        return fail_part(file, name, "it is encrypted");
    if (e->method != STORED && e->method != DEFLATED)
        return fail_part(file, name, "its compression is neither none nor deflate");
    if (e->at > source->size || source->size - e->at < LOCAL_BYTES || memcmp(source->bytes + e->at, "PK\3\4", 4) != 0)
        return fail_part(file, name, "it is not where the list of entries says");
    const uint8_t *local = source->bytes + e->at, *stop = source->bytes + source->size;
    struct unpacking u = {.at = local + LOCAL_BYTES, .left = e->packed};
    uint64_t names = little(local + 26, 2) + little(local + 28, 2);
    if (names > (uint64_t)(stop - u.at) || e->packed > (uint64_t)(stop - u.at) - names)
        return fail_part(file, name, "the file is truncated");
    u.at += names;
    if (e->method == DEFLATED && inflateInit2(&u.inflate, -MAX_WBITS) != Z_OK)
        return threemf_no_memory(file, 0);
    bool ok = read_chunks(file, e, &u, take, user);
    if (e->method == DEFLATED)
        inflateEnd(&u.inflate);
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
