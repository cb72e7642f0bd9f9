// json_print.c: prints JSON for human readers.
#include "write.h"

#include "fail.h"
#include "number.h"
#include "text_builder.h"

#include <stdlib.h>

static size_t flags(int digits) { return JSON_ENCODE_ANY | JSON_REAL_PRECISION(digits); }

// Prints a value on one line. Numbers are printed with fifteen digits if these identify the double, otherwise with
// sixteen or seventeen. The double 0.1 is therefore printed as 0.1, not as 0.10000000000000001.
static void add_line(struct text *text, const json_t *value)
{
    if (json_is_array(value)) {
        for (size_t i = 0; i < json_array_size(value); i++) {
            text_add(text, i ? ", " : "[");
            add_line(text, json_array_get(value, i));
        }
        text_add(text, json_array_size(value) ? "]" : "[]");
    } else if (json_is_object(value)) {
        const char *key;
        json_t *item;
        int count = 0;
        json_object_foreach((json_t *)(uintptr_t)value, key, item)
        {
            json_t *quoted = json_string(key);
            text_add(text, count++ ? ", " : "{ ");
            text->failed |= json_dump_callback(quoted, text_add_chunk, text, flags(17)) != 0;
            json_decref(quoted);
            text_add(text, ": ");
            add_line(text, item);
        }
        text_add(text, count ? " }" : "{}");
    } else {
        for (int digits = 15; digits <= 17 && !text->failed; digits++) {
            size_t start = text->length;
            text->failed |= json_dump_callback(value, text_add_chunk, text, flags(digits)) != 0;
            const uint8_t *begin = (const uint8_t *)text->bytes;
            double back = 0;
            if (digits == 17 || !json_is_real(value) || text->failed)
                return;
            number_double(begin + start, begin + text->length, &back);
            if (back == json_real_value(value))
                return;
            text->length = start;
        }
    }
}

bool scene_print(const json_t *root, lam_bytes *out, lam_error *error)
{
    struct text text = {0};
    const char *key;
    json_t *value;
    int count = 0;
    json_object_foreach((json_t *)(uintptr_t)root, key, value)
    {
        text_add(&text, count++ ? ",\n  \"" : "{\n  \"");
        text_add(&text, key); // a key of this format, which needs no escapes
        text_add(&text, "\": ");
        bool long_list = json_is_array(value) && json_is_object(json_array_get(value, 0));
        for (size_t i = 0; long_list && i < json_array_size(value); i++) {
            text_add(&text, i ? ",\n    " : "[\n    ");
            add_line(&text, json_array_get(value, i));
        }
        if (long_list)
            text_add(&text, "\n  ]");
        else
            add_line(&text, value);
    }
    text_add(&text, "\n}\n");
    if (text.failed) {
        free(text.bytes);
        return fail_memory(error, text.length);
    }
    *out = (lam_bytes){text.bytes, text.length};
    return true;
}
