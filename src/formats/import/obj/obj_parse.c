// obj_parse.c: pass two over an OBJ file: reads vertices and faces into their arrays.
#include "obj.h"

#include "number_scan.h"
#include "origin.h"
#include "parallel_rows.h"

#include <float.h>
#include <string.h>

bool obj_parse_chunk(struct obj *obj, struct obj_chunk *chunk, lam_error *error)
{
    struct obj_reader reader = {
        .obj = obj,
        .chunk = chunk,
        .end = obj->end,
        .next = chunk->before,
        .low = {__FLT_MAX__, __FLT_MAX__, __FLT_MAX__},
        .high = {-__FLT_MAX__, -__FLT_MAX__, -__FLT_MAX__},
        .error = error,
    };
    chunk->short_faces = chunk->nonfinite_numbers = 0;
    reader.limit = (struct obj_counts){
        .positions = chunk->before.positions + chunk->counts.positions,
        .texcoords = chunk->before.texcoords + chunk->counts.texcoords,
        .normals = chunk->before.normals + chunk->counts.normals,
        .triangles = chunk->before.triangles + chunk->counts.triangles,
        .polygons = chunk->before.polygons + chunk->counts.polygons,
        .others = chunk->before.others + chunk->counts.others,
    };
    const uint8_t *at = chunk->begin;
    while (at && at < chunk->end)
        at = obj_read_lines(&reader, at, chunk->end);
    memcpy(chunk->low, reader.low, sizeof chunk->low);
    memcpy(chunk->high, reader.high, sizeof chunk->high);
    if (obj->streamed)
        chunk->counts = reader.next; // a streamed chunk counts from 0, so `next` contains the counts
    return at != NULL;
}

static bool parse_chunk(void *user, size_t index, lam_error *error)
{
    struct obj *obj = user;
    return obj_parse_chunk(obj, &obj->chunks[index], error);
}

bool obj_parse(struct obj *obj, lam_error *error)
{
    return parallel_rows_run(obj->source, obj->chunk_count, parse_chunk, obj, error);
}

// --- positions far from zero are read again as doubles

// Calls `visit` for each position of the chunk, in order. The text has already been parsed without error.
static void each_position(struct obj *obj, struct obj_chunk *chunk,
                          void (*visit)(struct obj *, struct obj_chunk *, uint64_t, const double[3]))
{
    const uint8_t *at = chunk->begin, *end = obj->end;
    uint64_t index = chunk->before.positions, limit = index + chunk->counts.positions;
    while (at < chunk->end && index < limit) {
        while (obj_white(*at))
            at++;
        switch (obj_kind_of(at)) {
        case OBJ_POSITION: {
            double p[3] = {0, 0, 0};
            const uint8_t *number = at + 1;
            for (int i = 0; i < 3 && number; i++) {
                number = obj_next_word(number, end);
                number = number_double(number, end, &p[i]);
            }
            visit(obj, chunk, index++, p);
            at = obj_skip_line(at, end);
            break;
        }
        case OBJ_OTHER:
            at = obj_next_line(at, end);
            break;
        case OBJ_EMPTY:
            at = memchr(at, '\n', (size_t)(end - at));
            at = at ? at + 1 : end;
            break;
        default:
            at = obj_skip_line(at, end);
        }
    }
}

static void extend_box(struct obj *obj, struct obj_chunk *chunk, uint64_t index, const double p[3])
{
    for (int i = 0; i < 3 && obj_finite(obj->positions + 3 * index); i++) {
        if (p[i] < chunk->low_exact[i])
            chunk->low_exact[i] = p[i];
        if (p[i] > chunk->high_exact[i])
            chunk->high_exact[i] = p[i];
    }
}

static void store_relative(struct obj *obj, struct obj_chunk *chunk, uint64_t index, const double p[3])
{
    (void)chunk;
    for (int i = 0; i < 3 && obj_finite(obj->positions + 3 * index); i++)
        obj->positions[3 * index + (uint64_t)i] = (float)(p[i] - obj->origin[i]);
}

static bool box_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    struct obj *obj = user;
    struct obj_chunk *chunk = &obj->chunks[index];
    for (int i = 0; i < 3; i++) {
        chunk->low_exact[i] = DBL_MAX;
        chunk->high_exact[i] = -DBL_MAX;
    }
    each_position(obj, chunk, extend_box);
    return true;
}

static bool recenter_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    struct obj *obj = user;
    each_position(obj, &obj->chunks[index], store_relative);
    return true;
}

bool obj_find_origin(struct obj *obj, lam_error *error)
{
    double low[3], high[3];
    for (int pass = 0; pass < 2; pass++) {
        bool any = false;
        for (size_t c = 0; c < obj->chunk_count; c++) {
            const struct obj_chunk *chunk = &obj->chunks[c];
            if (chunk->counts.positions == 0)
                continue;
            for (int i = 0; i < 3; i++) {
                double l = pass ? chunk->low_exact[i] : (double)chunk->low[i];
                double h = pass ? chunk->high_exact[i] : (double)chunk->high[i];
                low[i] = !any || l < low[i] ? l : low[i];
                high[i] = !any || h > high[i] ? h : high[i];
            }
            any = true;
        }
        if (!any || !origin_choose(low, high, obj->origin))
            return true;
        if (pass == 0 && !parallel_rows_run(obj->source, obj->chunk_count, box_chunk, obj, error))
            return false;
    }
    return parallel_rows_run(obj->source, obj->chunk_count, recenter_chunk, obj, error);
}
