// gltf_document.h: glTF files in memory, for tests.
#ifndef GLTF_DOCUMENT_H
#define GLTF_DOCUMENT_H

#include "loading.h"

// A file under construction: the JSON text, with %B for the buffer (a data URI, or the chunk of a .glb).
struct document {
    char text[16384];
    struct made data;
};

static inline void encode_base64(const uint8_t *bytes, size_t size, char *out)
{
    static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t three = (uint32_t)bytes[i] << 16 | (i + 1 < size ? (uint32_t)bytes[i + 1] << 8 : 0) |
                         (i + 2 < size ? bytes[i + 2] : 0);
        for (int c = 0; c < 4; c++)
            *out++ = i + (size_t)c > size ? '=' : alphabet[three >> (18 - 6 * c) & 63];
    }
    *out = 0;
}

// Replaces %B by the buffer, and writes the text.
static inline void finish_text(const char *json, const char *buffer, char out[16384])
{
    const char *mark = strstr(json, "%B");
    size_t before = mark ? (size_t)(mark - json) : strlen(json);
    memcpy(out, json, before);
    snprintf(out + before, 16384 - before, "%s%s", mark ? buffer : "", mark ? mark + 2 : "");
}

// Makes the file as .gltf with embedded data.
static inline void make_text(struct document *document, const char *json)
{
    char buffer[12000], data[11000];
    encode_base64(document->data.bytes, document->data.size, data);
    snprintf(buffer, sizeof buffer,
             "\"buffers\": [{\"byteLength\": %zu, \"uri\": \"data:application/octet-stream;base64,%s\"}]",
             document->data.size, data);
    finish_text(json, buffer, document->text);
}

// Makes the same file as .glb.
static inline void make_binary(const struct document *document, const char *json, struct made *file)
{
    char buffer[100], text[16384];
    snprintf(buffer, sizeof buffer, "\"buffers\": [{\"byteLength\": %zu}]", document->data.size);
    finish_text(json, buffer, text);
    uint32_t length = (uint32_t)(strlen(text) + 3) & ~3u, size = (uint32_t)(document->data.size + 3) & ~3u;
    *file = (struct made){0};
    put_text(file, "glTF");
    put_u32(file, 2);
    put_u32(file, 12 + 8 + length + 8 + size);
    put_u32(file, length);
    put_text(file, "JSON");
    put_text(file, text);
    while (file->size % 4)
        put_text(file, " ");
    put_u32(file, size);
    put(file, "BIN", 4);
    put(file, document->data.bytes, document->data.size);
    while (file->size % 4)
        put_u8(file, 0);
}

static inline lam_scene *load_document(struct document *document, const char *json)
{
    make_text(document, json);
    return load_text(document->text, "a.gltf");
}

static inline void put_floats(struct document *document, int count, const float *numbers)
{
    for (int i = 0; i < count; i++)
        put_f32(&document->data, numbers[i]);
}

#endif
