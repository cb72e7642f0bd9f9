// draw_request.c: the job and its answer as bytes. Both ends are the same program, so structs go as they are; what is
// read is checked all the same, since the process between has run a stranger's shader.
#include "draw_request.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

static const char job_mark[8] = "lamjob1", drawn_mark[8] = "lamdrn1";

struct job_head {
    char mark[8];
    int contract, light_frame, size;
    unsigned scenes;
    size_t vertex_size, fragment_size; // with the closing zero
};

struct drawn_head {
    char mark[8];
    size_t floats;
    struct check_drawn drawn;
};

bool job_write(const struct draw_request *job, lam_bytes *out, lam_error *error)
{
    struct job_head head = {.contract = job->contract,
                            .light_frame = job->light_frame,
                            .size = job->size,
                            .scenes = job->scenes,
                            .vertex_size = strlen(job->vertex) + 1,
                            .fragment_size = strlen(job->fragment) + 1};
    memcpy(head.mark, job_mark, sizeof job_mark);
    out->size = sizeof head + head.vertex_size + head.fragment_size;
    char *data = out->data = malloc(out->size);
    if (!data)
        return fail_memory(error, out->size);
    memcpy(data, &head, sizeof head);
    memcpy(data + sizeof head, job->vertex, head.vertex_size);
    memcpy(data + sizeof head + head.vertex_size, job->fragment, head.fragment_size);
    return true;
}

bool job_read(const void *bytes, size_t size, struct draw_request *job, lam_error *error)
{
    struct job_head head;
    const char *data = bytes;
    if (size < sizeof head || memcmp(data, job_mark, sizeof job_mark) != 0)
        return fail(error, LAM_BAD_ARGUMENT, "the job of a check: found %zu other bytes", size);
    memcpy(&head, data, sizeof head);
    size_t rest = size - sizeof head;
    if (!contract_of((lam_check_contract)head.contract) || head.size < 32 || head.size > 1024 ||
        head.scenes >> reference_scene_count || head.vertex_size < 1 || head.vertex_size > rest ||
        head.fragment_size < 1 || head.fragment_size != rest - head.vertex_size ||
        data[sizeof head + head.vertex_size - 1] || data[size - 1])
        return fail(error, LAM_BAD_ARGUMENT, "the job of a check: its head does not fit its %zu bytes", size);
    *job = (struct draw_request){.contract = head.contract,
                                 .light_frame = head.light_frame,
                                 .size = head.size,
                                 .scenes = head.scenes,
                                 .vertex = data + sizeof head,
                                 .fragment = data + sizeof head + head.vertex_size};
    return true;
}

bool drawn_write(const struct check_drawn *drawn, const float *pictures, size_t count, lam_bytes *out, lam_error *error)
{
    struct drawn_head *head;
    out->size = sizeof *head + count * sizeof(float);
    head = calloc(1, out->size);
    out->data = head;
    if (!head)
        return fail_memory(error, out->size);
    memcpy(head->mark, drawn_mark, sizeof drawn_mark);
    head->floats = count;
    head->drawn = *drawn;
    head->drawn.pixels = NULL;
    if (count)
        memcpy(head + 1, pictures, count * sizeof(float));
    return true;
}

bool drawn_read(const lam_bytes *bytes, int size, struct check_drawn *drawn, lam_error *error)
{
    const struct drawn_head *head = bytes->data;
    if (bytes->size < sizeof *head || memcmp(head->mark, drawn_mark, sizeof drawn_mark) != 0)
        return fail(error, LAM_CANNOT_READ, "the process that drew the shader answered %zu bytes that are no answer",
                    bytes->size);
    *drawn = head->drawn;
    size_t pictures = 0;
    for (int i = 0; i < reference_scene_count; i++)
        pictures += drawn->scenes >> i & 1;
    size_t expected = drawn->state == DRAWN_PICTURES ? pictures * (size_t)size * (size_t)size * 4 : 0;
    if (head->floats != expected || bytes->size != sizeof *head + expected * sizeof(float) || drawn->state < 0 ||
        drawn->state > DRAWN_SLOW || drawn->unknown_count < 0 || drawn->unknown_count > DRAWN_UNKNOWN_MOST ||
        drawn->types_count < 0 || drawn->types_count > DRAWN_UNKNOWN_MOST)
        return fail(error, LAM_CANNOT_READ, "the process that drew the shader answered %zu bytes, expected %zu",
                    bytes->size, sizeof *head + expected * sizeof(float));
    drawn->driver[sizeof drawn->driver - 1] = drawn->log[sizeof drawn->log - 1] = 0;
    for (int i = 0; i < DRAWN_UNKNOWN_MOST; i++)
        drawn->unknown[i][sizeof drawn->unknown[i] - 1] = drawn->types[i][sizeof drawn->types[i] - 1] = 0;
    drawn->pixels = (const float *)(head + 1);
    return true;
}
