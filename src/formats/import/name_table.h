// name_table.h: maps names to numbers with a hash table (open addressing).
#ifndef NAME_TABLE_H
#define NAME_TABLE_H

#include "arena.h"

struct name_entry {
    const char *name; // NULL if free
    int32_t value;
};

// A table whose members are zero, except for `memory`, is empty.
struct name_table {
    struct arena *memory; // for the entries; the caller owns the names
    struct name_entry *entries;
    uint32_t capacity, count; // capacity: a power of two, or 0
};

// Returns the value of a name, or −1 if there is none.
int32_t name_table_find(const struct name_table *table, const char *name);

// Adds a name; duplicates are ignored. Returns false if memory runs out.
bool name_table_add(struct name_table *table, const char *name, int32_t value);

#endif
