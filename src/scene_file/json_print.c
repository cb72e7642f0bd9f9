// json_print.c: JSON as text for people.
#include "scene_write.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

struct text {
    char *at;
    size_t size, room;
    bool ok;
};

static void add_bytes(struct text *text, const char *bytes, size_t size)
{
    if (text->ok && text->size + size > text->room) {
        size_t room = (text->size + size) * 2;
        char *larger = realloc(text->at, room);
        text->ok = larger != NULL;
        text->at = larger ? larger : text->at;
        text->room = larger ? room : text->room;
    }
    if (!text->ok)
        return;
    memcpy(text->at + text->size, bytes, size);
    text->size += size;
}

static void add(struct text *text, const char *string) { add_bytes(text, string, strlen(string)); }

static int take_chunk(const char *bytes, size_t size, void *user)
{
    struct text *text = user;
    add_bytes(text, bytes, size);
    return text->ok ? 0 : -1;
}

static size_t flags(int digits) { return JSON_ENCODE_ANY | JSON_REAL_PRECISION(digits); }

// On one line. Fifteen digits where they are enough for this value, else sixteen or seventeen: 0.1, not
// 0.10000000000000001.
static void add_line(struct text *text, const json_t *value)
{
    if (json_is_array(value)) {
        for (size_t i = 0; i < json_array_size(value); i++) {
            add(text, i ? ", " : "[");
            add_line(text, json_array_get(value, i));
        }
        add(text, json_array_size(value) ? "]" : "[]");
    } else if (json_is_object(value)) {
        const char *key;
        json_t *item;
        int count = 0;
        json_object_foreach((json_t *)(uintptr_t)value, key, item)
        {
            json_t *quoted = json_string(key);
            add(text, count++ ? ", " : "{ ");
            text->ok &= json_dump_callback(quoted, take_chunk, text, flags(17)) == 0;
            json_decref(quoted);
            add(text, ": ");
            add_line(text, item);
        }
        add(text, count ? " }" : "{}");
    } else {
        for (int digits = 15; digits <= 17 && text->ok; digits++) {
            size_t start = text->size;
            text->ok &= json_dump_callback(value, take_chunk, text, flags(digits)) == 0;
            json_t *back = text->ok && digits < 17 && json_is_real(value)
                               ? json_loadb(text->at + start, text->size - start, JSON_DECODE_ANY, NULL)
                               : NULL;
            bool same = digits == 17 || !json_is_real(value) || (back && json_equal(back, value));
            json_decref(back);
            if (same)
                return;
            text->size = start;
        }
    }
}

bool scene_print(const json_t *root, lam_bytes *out, lam_error *error)
{
    struct text text = {.ok = true};
    const char *key;
    json_t *value;
    int count = 0;
    json_object_foreach((json_t *)(uintptr_t)root, key, value)
    {
        add(&text, count++ ? ",\n  \"" : "{\n  \"");
        add(&text, key); // of this format's own, nothing to quote
        add(&text, "\": ");
        bool long_list = json_is_array(value) && json_is_object(json_array_get(value, 0));
        for (size_t i = 0; long_list && i < json_array_size(value); i++) {
            add(&text, i ? ",\n    " : "[\n    ");
            add_line(&text, json_array_get(value, i));
        }
        if (long_list)
            add(&text, "\n  ]");
        else
            add_line(&text, value);
    }
    add(&text, "\n}\n");
    if (!text.ok) {
        free(text.at);
        return fail_memory(error, text.size);
    }
    *out = (lam_bytes){text.at, text.size};
    return true;
}
