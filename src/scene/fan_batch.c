// fan_batch.c: the normals at many positions at a time.
#include "fan_batch.h"

#include "cpu_features.h"
#include "linear.h"
#include "normals_fan.h"

#include <string.h>

extern const struct fan_lanes fan_lanes_plain;
#if defined(__x86_64__)
extern const struct fan_lanes fan_lanes_avx2, fan_lanes_avx512;
#endif

const struct fan_lanes *fan_lanes_of(int lanes)
{
#if defined(__x86_64__)
    unsigned have = cpu_features();
    if (lanes >= 16 && have & CPU_AVX512)
        return &fan_lanes_avx512;
    if (lanes >= 8 && have & CPU_AVX2)
        return &fan_lanes_avx2;
#endif
    (void)lanes;
    return &fan_lanes_plain;
}

void fan_batch_start(struct fan_batch *batch) { memset(batch, 0, sizeof *batch); }

void fan_batch_empty(struct fan_batch *batch) { batch->count = batch->places = 0; }

bool fan_batch_add(struct fan_batch *batch, const uint32_t *corners, uint32_t count)
{
    if (batch->count + count > FAN_CORNERS)
        return false;
    memcpy(batch->corner + batch->count, corners, count * sizeof *corners);
    batch->place[batch->places++] = (struct fan_place){(uint16_t)batch->count, (uint16_t)count, false};
    batch->count += count;
    return true;
}

// Fetches the corners' triangles. First all their vertices' numbers, so that memory has time to bring the
// positions.
static void gather(struct fan_batch *batch, const lam_mesh *mesh)
{
    for (uint32_t i = 0; i < batch->count; i++) {
        uint32_t corner = batch->corner[i], triangle = corner / 3, k = corner - 3 * triangle;
        uint32_t next = k == 2 ? corner - 2 : corner + 1, before = k == 0 ? corner + 2 : corner - 1;
        batch->vertex[0][i] = corner_vertex(mesh, corner);
        batch->vertex[1][i] = corner_vertex(mesh, next);
        batch->vertex[2][i] = corner_vertex(mesh, before);
        for (int v = 0; v < 3; v++)
            __builtin_prefetch(mesh->positions + 3 * (size_t)batch->vertex[v][i]);
        batch->group[i] = mesh->smoothing_groups ? mesh->smoothing_groups[triangle] : 1;
    }
    struct fan_corners *to = &batch->corners;
    for (uint32_t i = 0; i < batch->count; i++) {
        const float *here = mesh->positions + 3 * (size_t)batch->vertex[0][i],
                    *next = mesh->positions + 3 * (size_t)batch->vertex[1][i],
                    *before = mesh->positions + 3 * (size_t)batch->vertex[2][i];
        for (int a = 0; a < 3; a++) {
            to->here[a][i] = here[a];
            to->next[a][i] = next[a];
            to->before[a][i] = before[a];
        }
    }
}

static uint32_t root_of(const uint8_t *root, uint32_t i)
{
    while (root[i] != i)
        i = root[i];
    return i;
}

// Joins the corners of a place as join_few of normals_fan.c does: the lowest stands for all it is joined to.
// Returns how many groups are left.
static uint32_t join(const struct fan_batch *batch, const struct fan_place *place, double least_cosine,
                     uint8_t root[FAN_FEW])
{
    const struct fan_corners *c = &batch->corners;
    const uint32_t first = place->first, count = place->count, *group = batch->group + first;
    const uint32_t *before = c->before_key + first;
    uint32_t left = count;
    for (uint32_t i = 0; i < count; i++)
        root[i] = (uint8_t)i;
    for (uint32_t i = 0; i < count && left > 1; i++) {
        uint32_t next = c->next_key[first + i], equal = 0;
        for (uint32_t j = 0; j < count; j++)
            equal |= (uint32_t)(before[j] == next) << j;
        for (equal &= ~(1u << i); equal; equal &= equal - 1) {
            uint32_t j = (uint32_t)__builtin_ctz(equal), a = first + i, b = first + j;
            double cosine = c->normal[0][a] * c->normal[0][b] + c->normal[1][a] * c->normal[1][b] +
                            c->normal[2][a] * c->normal[2][b];
            // No coordinate is NaN: equal floats are equal bits, but for the sign of zero.
            if (c->next[0][a] != c->before[0][b] || c->next[1][a] != c->before[1][b] ||
                c->next[2][a] != c->before[2][b] || !(cosine >= least_cosine) || group[i] != group[j] ||
                group[i] == 0)
                continue;
            uint32_t x = root_of(root, i), y = root_of(root, j);
            root[x < y ? y : x] = (uint8_t)(x < y ? x : y);
            left -= x != y;
        }
    }
    return left;
}

// One fan for all corners, as on any smooth surface: the sum stays in registers.
static void sum_all(struct fan_batch *batch, const struct fan_place *place)
{
    double(*weighted)[FAN_CORNERS] = batch->corners.weighted;
    double x = 0, y = 0, z = 0;
    for (uint32_t i = place->first; i < (uint32_t)place->first + place->count; i++) {
        x += weighted[0][i];
        y += weighted[1][i];
        z += weighted[2][i];
        batch->fan[i] = (uint16_t)batch->fans;
    }
    batch->sums.sum[0][batch->fans] = x;
    batch->sums.sum[1][batch->fans] = y;
    batch->sums.sum[2][batch->fans] = z;
    batch->fans++;
}

// Numbers the fans in the order of their first corners, and sums up.
static void sum(struct fan_batch *batch, const struct fan_place *place, const uint8_t root[FAN_FEW])
{
    struct fan_sums *sums = &batch->sums;
    for (uint32_t i = 0; i < place->count; i++) {
        uint32_t at = place->first + i, lowest = root_of(root, i), fan;
        if (lowest == i) {
            fan = batch->fans++;
            for (int a = 0; a < 3; a++)
                sums->sum[a][fan] = 0;
        } else {
            fan = batch->fan[place->first + lowest];
        }
        batch->fan[at] = (uint16_t)fan;
        for (int a = 0; a < 3; a++)
            sums->sum[a][fan] += batch->corners.weighted[a][at];
    }
}

void fan_batch_make(struct fan_batch *batch, const lam_mesh *mesh, double least_cosine,
                    const struct fan_lanes *lanes)
{
    struct fan_sums *sums = &batch->sums;
    batch->fans = 0;
    gather(batch, mesh);
    lanes->look(&batch->corners, batch->count);
    for (uint32_t p = 0; p < batch->places; p++) {
        struct fan_place *place = &batch->place[p];
        uint32_t spanning = 0;
        for (uint32_t i = 0; i < place->count; i++)
            spanning += batch->corners.spans[place->first + i];
        place->done = spanning == place->count;
        if (!place->done)
            continue;
        uint8_t root[FAN_FEW];
        if (join(batch, place, least_cosine, root) == 1)
            sum_all(batch, place);
        else
            sum(batch, place, root);
    }
    lanes->unit(sums, batch->fans);
    for (uint32_t f = 0; f < batch->fans; f++) {
        if (sums->plain[f])
            continue;
        lam_vec3 unit = v3_unit(v3(sums->sum[0][f], sums->sum[1][f], sums->sum[2][f]));
        sums->unit[0][f] = (float)unit.x;
        sums->unit[1][f] = (float)unit.y;
        sums->unit[2][f] = (float)unit.z;
    }
}
