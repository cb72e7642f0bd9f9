// gltf_buffers.c: reads buffers (section 3.6.1) on first use, and moves a buffer to the scene if arrays of the scene
// point into it.
#include "companion.h"
#include "fail.h"
#include "gltf_data.h"
#include "gltf_json.h"
#include "number.h"

#include <string.h>
#include <strings.h>

bool gltf_buffers_start(struct gltf *gltf)
{
    size_t buffers = gltf_list_size(gltf, "buffers"), views = gltf_list_size(gltf, "bufferViews");
    gltf->buffers = GLTF_ALLOC(gltf, buffers, struct gltf_buffer);
    gltf->views = GLTF_ALLOC(gltf, views, struct gltf_view);
    return (gltf->buffers && gltf->views) || gltf_no_memory(gltf, views * sizeof *gltf->views);
}

static bool read_buffer(struct gltf *gltf, int index)
{
    struct gltf_buffer *buffer = &gltf->buffers[index];
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "buffers"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "buffers", index);
    const char *uri = NULL;
    size_t length = 0;
    if (buffer->data)
        return true;
    if (!json_object_get(object, "byteLength") || json_is_null(json_object_get(object, "byteLength")))
        return json_fail(&gltf->json, place, "byteLength is missing");
    if (!gltf_take_whole(gltf, place, object, "byteLength", 1, 9e15, &length) ||
        (!json_is_null(json_object_get(object, "uri")) && !json_take_text(&gltf->json, place, object, "uri", &uri)))
        return false;
    const uint8_t *data = gltf->binary;
    size_t size = gltf->binary_size;
    if (uri) {
        if (!gltf_uri_read(gltf, KEY_OF(place, "uri"), uri, &buffer->file))
            return false;
        data = buffer->file.data;
        size = buffer->file.size;
    } else if (index != 0 || !data) {
        return json_fail(&gltf->json, place, "found no uri, %s",
                         index == 0 ? "and the file contains no binary chunk"
                                    : "but only the first buffer may be the file's binary chunk");
    }
    if (size < length)
        return json_fail(&gltf->json, KEY_OF(place, "byteLength"), "found %zu, but %s only %zu bytes", length,
                         uri ? "its data are" : "the binary chunk contains", size);
    buffer->data = data;
    buffer->size = length;
    return true;
}

bool gltf_buffer_bytes(struct gltf *gltf, const struct place *place, int index, size_t offset, size_t length,
                       const uint8_t **out)
{
    if (!read_buffer(gltf, index))
        return false;
    const struct gltf_buffer *buffer = &gltf->buffers[index];
    if (offset > buffer->size || length > buffer->size - offset)
        return json_fail(&gltf->json, place, "found bytes %zu to %zu, but buffer %d has only %zu", offset,
                         offset + length, index, buffer->size);
    *out = buffer->data + offset;
    return true;
}

void gltf_buffer_keep(struct gltf *gltf, int buffer)
{
    if (buffer < 0)
        return; // decoded bytes already belong to the scene
    gltf->buffers[buffer].kept = true;
    gltf->source_kept |= gltf->buffers[buffer].data == gltf->binary;
}

bool gltf_buffers_end(struct gltf *gltf)
{
    bool ok = true;
    for (size_t i = 0; gltf->buffers && i < gltf_list_size(gltf, "buffers"); i++) {
        struct gltf_buffer *buffer = &gltf->buffers[i];
        if (buffer->kept && ok)
            ok = file_move_to_arena(&buffer->file, &gltf->scene->arena) || gltf_no_memory(gltf, sizeof *buffer);
        file_release(&buffer->file);
    }
    if (gltf->source_kept && ok)
        ok = file_move_to_arena(gltf->source->file, &gltf->scene->arena) || gltf_no_memory(gltf, sizeof *gltf->buffers);
    return ok;
}

// --- decodes file names given as URIs (RFC 3986), and data URIs (RFC 2397).

bool gltf_is_data_uri(const char *uri) { return strncasecmp(uri, "data:", 5) == 0; }

// --- data URIs

// Decodes base64 (RFC 4648); `text` does not include the padding. Returns the position of the first invalid character,
// or `length` if there is none.
static size_t decode_base64(const char *text, size_t length, uint8_t *out)
{
    static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint8_t digit[256];
    memset(digit, 255, sizeof digit);
    for (uint8_t i = 0; i < 64; i++)
        digit[(uint8_t)alphabet[i]] = i;
    digit['-'] = 62; // the URL-safe alphabet
    digit['_'] = 63;
    const uint8_t *at = (const uint8_t *)text, *end = at + length;
    unsigned bad = 0;
    for (; end - at >= 4 && bad < 64; at += 4, out += 3) {
        unsigned a = digit[at[0]], b = digit[at[1]], c = digit[at[2]], d = digit[at[3]];
        bad = a | b | c | d;
        out[0] = (uint8_t)(a << 2 | b >> 4);
        out[1] = (uint8_t)(b << 4 | c >> 2);
        out[2] = (uint8_t)(c << 6 | d);
    }
    if (bad < 64 && end - at >= 2) {
        unsigned a = digit[at[0]], b = digit[at[1]], c = end - at == 3 ? digit[at[2]] : 0;
        bad = a | b | c;
        out[0] = (uint8_t)(a << 2 | b >> 4);
        if (end - at == 3)
            out[1] = (uint8_t)(b << 4 | c >> 2);
    }
    size_t good = length;
    if (bad >= 64)
        for (good = 0; digit[(uint8_t)text[good]] < 64;)
            good++;
    return good;
}

static size_t base64_bytes(size_t length) { return length / 4 * 3 + (length % 4 ? length % 4 - 1 : 0); }

// Decodes text that may contain %XX, and returns the number of bytes. `out` may be NULL.
static size_t decode_text(const char *text, uint8_t *out)
{
    size_t size = 0;
    for (; *text; size++) {
        int byte = companion_escaped(text);
        if (out)
            out[size] = byte >= 0 ? (uint8_t)byte : (uint8_t)*text;
        text += byte >= 0 ? 3 : 1;
    }
    return size;
}

static bool read_data(struct gltf *gltf, const struct place *place, const char *uri, struct file_bytes *out)
{
    static const char mark[] = ";base64";
    const char *comma = strchr(uri, ',');
    if (!comma)
        return json_fail(&gltf->json, place, "this data URI lacks the ',' before its data");
    const char *data = comma + 1;
    size_t kind = (size_t)(comma - uri), length = strlen(data);
    bool base64 = kind >= sizeof mark - 1 && strncasecmp(comma - (sizeof mark - 1), mark, sizeof mark - 1) == 0;
    if (base64 && strchr(data, '%')) { // "+", "/" and "=" may be written as "%2B", "%2F" and "%3D"
        length = decode_text(data, NULL);
        uint8_t *plain = arena_alloc(gltf->scratch, length + 1);
        if (!plain)
            return gltf_no_memory(gltf, length + 1);
        decode_text(data, plain);
        plain[length] = 0;
        data = (const char *)plain;
    }
    while (base64 && length && data[length - 1] == '=')
        length--;
    if (base64 && length % 4 == 1)
        return json_fail(&gltf->json, place, "the data URI is cut: its base64 has %zu characters", length);
    size_t size = base64 ? base64_bytes(length) : decode_text(data, NULL);
    if (!file_hold(size, gltf->source->call, out, gltf->json.error))
        return false;
    uint8_t *bytes = (uint8_t *)(uintptr_t)out->data;
    if (!base64) {
        decode_text(data, bytes);
        return true;
    }
    size_t good = decode_base64(data, length, bytes);
    if (good == length)
        return true;
    file_release(out);
    return json_fail(&gltf->json, place, "character %zu of the data URI is not of base64 (found '%c')", kind + 1 + good,
                     data[good]);
}

// --- files

bool gltf_uri_read(struct gltf *gltf, const struct place *place, const char *uri, struct file_bytes *out)
{
    if (gltf_is_data_uri(uri))
        return read_data(gltf, place, uri, out);
    char shown[SHOWN_NAME_SIZE];
    if (strstr(uri, "://"))
        return json_fail(&gltf->json, place, "found '%s', expected a file beside the model or a data URI",
                         shown_name(uri, shown));
    char *name = arena_string(gltf->scratch, uri);
    if (!name)
        return gltf_no_memory(gltf, strlen(uri));
    companion_unescape(uri, name);
    lam_error reason = {0};
    struct companion companion;
    if (gltf->source->open(gltf->source, name, gltf->scratch, &companion, &reason)) {
        *out = companion.file;
        return true;
    }
    if (reason.code == LAM_CANNOT_READ)
        return json_fail(&gltf->json, place, "%s", reason.text);
    if (gltf->json.error)
        *gltf->json.error = reason;
    return false;
}
