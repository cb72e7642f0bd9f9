// name_table.c: maps names to numbers with a hash table (open addressing).
#include "name_table.h"

#include <string.h>

static uint32_t hash(const char *name)
{
    uint32_t h = 2166136261u; // FNV-1a
    for (; *name; name++)
        h = (h ^ (uint8_t)*name) * 16777619u;
    return h;
}

// Returns the entry of a name or, if the name is missing, the free entry that can store it.
static struct name_entry *entry_of(const struct name_table *table, const char *name)
{
    for (uint32_t i = hash(name);; i++) {
        struct name_entry *entry = &table->entries[i & (table->capacity - 1)];
        if (!entry->name || strcmp(entry->name, name) == 0)
            return entry;
    }
}

int32_t name_table_find(const struct name_table *table, const char *name)
{
    if (table->capacity == 0)
        return -1;
    const struct name_entry *entry = entry_of(table, name);
    return entry->name ? entry->value : -1;
}

bool name_table_add(struct name_table *table, const char *name, int32_t value)
{
    if (2 * (table->count + 1) > table->capacity) {
        struct name_table larger = *table;
        larger.capacity = table->capacity ? 2 * table->capacity : 64;
        larger.entries = arena_alloc_zeroed(table->memory, larger.capacity * sizeof *larger.entries);
        if (!larger.entries)
            return false;
        for (uint32_t i = 0; i < table->capacity; i++) {
            if (table->entries[i].name)
                *entry_of(&larger, table->entries[i].name) = table->entries[i];
        }
        *table = larger;
    }
    struct name_entry *entry = entry_of(table, name);
    if (!entry->name) {
        *entry = (struct name_entry){name, value};
        table->count++;
    }
    return true;
}
