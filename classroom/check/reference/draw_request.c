// draw_request.c: the request and its result as bytes. The same program writes and reads the bytes, so structs are
// copied unchanged. The result is validated nevertheless, because the process that writes the result has run untrusted
// shaders.
#include "draw_request.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

static const char request_magic[8] = "lamjob2", result_magic[8] = "lamdrn2";

struct request_header {
    char magic[8];
    int light_frame, size, lines[2];
    unsigned scenes;
    // the sizes of the contract, the vertex and the fragment shader, including the terminating zeros
    size_t text_sizes[3];
};

struct result_header {
    char magic[8];
    size_t floats;
    struct draw_result drawn;
};

bool draw_request_write(const struct draw_request *request, lam_bytes *out, lam_error *error)
{
    const char *const texts[] = {request->contract, request->vertex, request->fragment};
    struct request_header head = {
        .light_frame = request->light_frame, .size = request->size, .scenes = request->scenes};
    memcpy(head.lines, request->lines, sizeof head.lines);
    memcpy(head.magic, request_magic, sizeof request_magic);
    out->size = sizeof head;
    for (int i = 0; i < 3; i++)
        out->size += head.text_sizes[i] = strlen(texts[i]) + 1;
    char *data = out->data = malloc(out->size);
    if (!data)
        return fail_memory(error, out->size);
    memcpy(data, &head, sizeof head);
    data += sizeof head;
    for (int i = 0; i < 3; data += head.text_sizes[i++])
        memcpy(data, texts[i], head.text_sizes[i]);
    return true;
}

bool draw_request_read(const void *bytes, size_t size, struct draw_request *request, lam_error *error)
{
    struct request_header head;
    const char *data = bytes, *texts[3] = {NULL};
    if (size < sizeof head || memcmp(data, request_magic, sizeof request_magic) != 0)
        return fail(error, LAM_BAD_ARGUMENT, "check: the request is invalid: %zu bytes without its header", size);
    memcpy(&head, data, sizeof head);
    size_t at = sizeof head;
    bool ok =
        (head.size == READ_ONLY || (head.size >= 32 && head.size <= 1024)) && !(head.scenes >> reference_scene_count);
    for (int i = 0; ok && i < 3; at += head.text_sizes[i++]) {
        ok = head.text_sizes[i] >= 1 && head.text_sizes[i] <= size - at && !data[at + head.text_sizes[i] - 1];
        texts[i] = data + at;
    }
    if (!ok || at != size)
        return fail(error, LAM_BAD_ARGUMENT, "check: the request is invalid: its header does not match its %zu bytes",
                    size);
    *request = (struct draw_request){.contract = texts[0],
                                     .light_frame = head.light_frame,
                                     .size = head.size,
                                     .scenes = head.scenes,
                                     .vertex = texts[1],
                                     .fragment = texts[2],
                                     .lines = {head.lines[0], head.lines[1]}};
    return true;
}

bool draw_result_write(const struct draw_result *drawn, const float *pictures, size_t count, lam_bytes *out,
                       lam_error *error)
{
    struct result_header *head;
    out->size = sizeof *head + count * sizeof(float);
    head = calloc(1, out->size);
    out->data = head;
    if (!head)
        return fail_memory(error, out->size);
    memcpy(head->magic, result_magic, sizeof result_magic);
    head->floats = count;
    head->drawn = *drawn;
    head->drawn.pixels = NULL;
    if (count)
        memcpy(head + 1, pictures, count * sizeof(float));
    return true;
}

bool draw_result_read(const lam_bytes *bytes, int size, struct draw_result *drawn, lam_error *error)
{
    const struct result_header *head = bytes->data;
    if (bytes->size < sizeof *head || memcmp(head->magic, result_magic, sizeof result_magic) != 0)
        return fail(error, LAM_CANNOT_READ, "the drawing process returned %zu bytes without a result's header",
                    bytes->size);
    *drawn = head->drawn;
    size_t pictures = 0;
    for (int i = 0; i < reference_scene_count; i++)
        pictures += drawn->scenes >> i & 1;
    size_t expected = drawn->state == DRAWN_PICTURES ? pictures * (size_t)size * (size_t)size * 4 : 0;
    if (head->floats != expected || bytes->size != sizeof *head + expected * sizeof(float) || drawn->state < 0 ||
        drawn->state > DRAWN_SLOW || drawn->unknown_count < 0 || drawn->unknown_count > MAX_UNKNOWN_NAMES ||
        drawn->types_count < 0 || drawn->types_count > MAX_UNKNOWN_NAMES)
        return fail(error, LAM_CANNOT_READ, "the drawing process returned %zu bytes, expected %zu", bytes->size,
                    sizeof *head + expected * sizeof(float));
    drawn->driver[sizeof drawn->driver - 1] = drawn->log[sizeof drawn->log - 1] = 0;
    drawn->fragment_log[sizeof drawn->fragment_log - 1] = 0;
    for (int i = 0; i < MAX_UNKNOWN_NAMES; i++)
        drawn->unknown[i][sizeof drawn->unknown[i] - 1] = drawn->types[i][sizeof drawn->types[i] - 1] = 0;
    drawn->pixels = (const float *)(head + 1);
    return true;
}
