// environment_light.c: computes and stores the irradiance, and the environment prefiltered for each roughness.
//
// A texel is a sum over samples. The GGX lobe around the texel's direction is divided into rings, and the rings are
// divided into cells that are about as wide as high. For each cell, the environment is read from one of the copies of
// the cube: the copy with texels about as large as the cell. The cells of a level are the same for all texels.
#include "environment.h"

#include "call_control.h"
#include "cpu_features.h"
#include "environment_kernels.h"
#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "lock.h"
#include "pages.h"
#include "pool.h"

#include <stdlib.h>
#include <string.h>

// --- the cells of a lobe

// Returns the roughness of a level. The fourth roots of the roughnesses are equally spaced.
static double prefiltered_roughness(int level)
{
    double start = math_sqrt(math_sqrt(0.045)), root = start + (1 - start) * level / (ENVIRONMENT_LEVELS - 1);
    return root * root * (root * root);
}

// The levels: the texels per side of a face, and the rings of microfacet normals h around the axis. Rings are measured
// by the tangent of the angle of h. The innermost ring is `core` · alpha wide; the outer radius of each further ring is
// `growth` times its inner radius. Lobes without rings are so wide that they are summed over a small copy of the cube.
static const struct {
    int size;
    double core, growth;
} levels[ENVIRONMENT_LEVELS] = {
    {0},          {96, 1.0, 2.6}, {112, 0.8, 1.8}, {80, 0.8, 1.8}, {56, 0.35, 1.6}, {40, 0.35, 1.4},
    {.size = 32}, {.size = 24},   {.size = 16},    {.size = 16},   {.size = 16},    {.size = 16}};

// The sum over the far cells of a lobe varies slowly with the lobe's direction, so a cube of a quarter of the size
// stores the sum. A cell is far if its distance from the axis exceeds FAR_TEXELS texels of the smaller cube.
enum { FAR_SHRINK = 4 };
#define FAR_TEXELS 1.5
static int far_size(int level) { return levels[level].growth > 0 ? levels[level].size / FAR_SHRINK : 0; }

int prefiltered_size(int level) { return levels[level].size; }

// Returns the fraction of the GGX microfacets, weighted by D(h) (h.n), whose angle has a tangent below `tangent`.
static double ggx_share(double tangent, double alpha)
{
    double square = tangent * tangent;
    return square / (square + alpha * alpha);
}

static void add_ring(struct lobe_cells *cells, double alpha, double inner, double outer, int number,
                     const struct cube_chain *chain, double *total)
{
    // The angle of l from the axis is twice the angle of h: cos = (1 − t²) / (1 + t²), sin = 2 t / (1 + t²).
    double share = ggx_share(outer, alpha) - ggx_share(inner, alpha);
    double middle = ggx_share(inner, alpha) + share / 2, t = alpha * math_sqrt(middle / (1 - middle));
    double z = (1 - t * t) / (1 + t * t), r = 2 * t / (1 + t * t);
    double cos_inner = (1 - inner * inner) / (1 + inner * inner), cos_outer = (1 - outer * outer) / (1 + outer * outer);
    double width = math_acos(cos_outer) - math_acos(cos_inner);
    int count = (int)(2 * PI * r / width + 0.5);
    count = count < 5 ? 5 : count > 64 ? 64 : count;
    double solid_angle = 2 * PI * (cos_inner - cos_outer) / count;
    const struct lam_environment *cube = cube_chain_near(chain, 1.5 * math_sqrt(4 * PI / LAM_FACE_COUNT / solid_angle));
    for (int i = 0; i < count && cells->count < CELLS_MAX; i++) {
        double angle = 2 * PI * (i + (number % 2 ? 0.5 : 0.0)) / count;
        cells->cell[cells->count++] = (struct cell){(float)(r * math_cos(angle)), (float)(r * math_sin(angle)),
                                                    (float)z, (float)(share * z / count), cube};
        *total += share * z / count;
    }
}

static void cut_lobe(struct lobe_cells *cells, int level, const struct cube_chain *chain)
{
    double roughness = prefiltered_roughness(level), alpha = roughness * roughness, total = 0;
    double growth = levels[level].growth, inner = 0, outer = levels[level].core * alpha;
    double far_l = FAR_TEXELS * PI / 2 / far_size(level); // radians
    cells->near = cells->count = 0;
    for (int ring = 0; inner < 1; ring++) {
        if (outer * growth > 1) // for h beyond 45°, the reflected directions are below the horizon
            outer = 1;
        add_ring(cells, alpha, inner, outer, ring, chain, &total);
        if (2 * inner < far_l)
            cells->near = cells->count;
        inner = outer;
        outer = inner * growth;
    }
    for (int i = 0; i < cells->count; i++)
        cells->cell[i].weight = (float)((double)cells->cell[i].weight / total);
}

// --- making all parts

struct making {
    struct environment_light *light;
    unsigned parts; // the parts to make (environment_light.made)
    struct lobe_cells cells[ENVIRONMENT_LEVELS];
    struct lam_environment far[ENVIRONMENT_LEVELS];
    float *far_texels;
    struct cube_sums *sums;
    const struct environment_kernels *kernels;
    struct call_control *call;
};

// Returns how many rows of a level's faces must be computed. size(level) is the number of texels per side.
static size_t rows_of(const struct making *work, int level, int (*size)(int level))
{
    return work->parts >> level & 1 ? (size_t)size(level) * LAM_FACE_COUNT : 0;
}

// Finds the level and the row of a task index.
static int level_of(const struct making *work, size_t *index, int (*size)(int level))
{
    int level = 1;
    for (; level < ENVIRONMENT_LEVELS; level++) {
        size_t rows = rows_of(work, level, size);
        if (*index < rows)
            break;
        *index -= rows;
    }
    return level;
}

static void make_far_row(void *user, size_t index, int thread)
{
    (void)thread;
    struct making *work = user;
    if (work->call && !call_should_continue(work->call))
        return;
    int level = level_of(work, &index, far_size);
    struct lam_environment *cube = &work->far[level];
    const struct lobe_cells *cells = &work->cells[level];
    work->kernels->prefilter_row(cells, cells->near, cells->count, NULL, cube, (int)index / cube->size,
                                 (int)index % cube->size);
}

static void make_row(void *user, size_t index, int thread)
{
    (void)thread;
    struct making *work = user;
    if (work->call && !call_should_continue(work->call))
        return;
    int level = level_of(work, &index, prefiltered_size);
    struct lam_environment *cube = level < ENVIRONMENT_LEVELS ? &work->light->level[level] : &work->light->irradiance;
    int face = (int)index / cube->size, t = (int)index % cube->size;
    double roughness = level < ENVIRONMENT_LEVELS ? prefiltered_roughness(level) : 0;
    if (level < ENVIRONMENT_LEVELS && far_size(level))
        work->kernels->prefilter_row(&work->cells[level], 0, work->cells[level].near, &work->far[level], cube, face, t);
    else if (face % 2 == 0) // this also computes the rows of the opposite face
        work->kernels->cube_sums_row(work->sums, level < ENVIRONMENT_LEVELS ? roughness * roughness : -1, cube, face,
                                     t);
}

// Makes the cells of the levels that have rings, and the cubes for their far cells.
static bool set_up(struct making *work, const struct cube_chain *chain, lam_error *error)
{
    size_t bytes = CUBE_TEXELS_AFTER;
    for (int i = 1; i < ENVIRONMENT_LEVELS; i++)
        bytes += far_size(i) ? cube_bytes(far_size(i)) : 0;
    if (!(work->far_texels = malloc(bytes)))
        return fail_memory(error, bytes);
    float *at = work->far_texels;
    for (int i = 1; i < ENVIRONMENT_LEVELS; i++) {
        if (!rows_of(work, i, far_size))
            continue;
        cut_lobe(&work->cells[i], i, chain);
        work->far[i] = (struct lam_environment){.size = far_size(i), .texels = at};
        at += cube_bytes(far_size(i)) / sizeof *at;
    }
    work->sums = cube_sums_make(chain, error);
    return work->sums != NULL;
}

static bool run(struct making *work, struct pool *pool, int (*size)(int level), size_t more, pool_task *task,
                lam_error *error)
{
    size_t rows = more;
    for (int i = 1; i < ENVIRONMENT_LEVELS; i++)
        rows += rows_of(work, i, size);
    pool_run(pool, rows, task, work);
    return !work->call || call_should_continue(work->call) || call_error(work->call, error);
}

static bool fill(struct environment_light *light, unsigned parts, struct pool *pool, struct call_control *call,
                 lam_error *error)
{
    struct cube_chain chain;
    struct making *work = calloc(1, sizeof *work);
    if (!work)
        return fail_memory(error, sizeof *work);
    work->light = light;
    work->parts = parts;
    work->call = call;
    work->kernels = CPU_WIDEST(16, environment_kernels);
    bool ok = cube_chain_make(&chain, &light->level[0], pool, call, error) && set_up(work, &chain, error) &&
              run(work, pool, far_size, 0, make_far_row, error);
    for (int i = 1; ok && i < ENVIRONMENT_LEVELS; i++)
        if (rows_of(work, i, far_size))
            cube_close(&work->far[i]);
    bool irradiance = parts >> ENVIRONMENT_LEVELS & 1;
    ok = ok && run(work, pool, prefiltered_size, irradiance ? IRRADIANCE_SIZE * LAM_FACE_COUNT : 0, make_row, error);
    for (int i = 1; ok && i < ENVIRONMENT_LEVELS; i++)
        if (parts >> i & 1)
            cube_close(&light->level[i]);
    if (ok && irradiance)
        cube_close(&light->irradiance);
    free(work->far_texels);
    free(work->sums);
    free(work);
    cube_chain_free(&chain);
    return ok;
}

void environment_light_free(struct environment_light *light)
{
    if (light) {
        pages_free(light->texels, light->held);
        free(light->lamp);
        environment_light_free(light->without_lamp);
    }
    free(light);
}

int environment_light_first(int level)
{
    size_t bytes = 0;
    for (int i = 1; i < level; i++)
        bytes += cube_bytes(prefiltered_size(i));
    return (int)(bytes / (3 * sizeof(float)));
}

int environment_light_rows(void)
{
    int texels = environment_light_first(ENVIRONMENT_LEVELS) + (int)(cube_bytes(IRRADIANCE_SIZE) / (3 * sizeof(float)));
    return (texels + ENVIRONMENT_LIGHT_WIDTH - 1) / ENVIRONMENT_LIGHT_WIDTH;
}

// Allocates the struct environment_light, which at first contains only level 0.
static struct environment_light *start(const struct lam_environment *cube, lam_error *error)
{
    struct environment_light *light = calloc(1, sizeof *light);
    size_t bytes = (size_t)environment_light_rows() * ENVIRONMENT_LIGHT_WIDTH * 3 * sizeof(float) + CUBE_TEXELS_AFTER;
    float *at = light ? pages_get(bytes, &light->held) : NULL;
    if (!at) {
        free(light);
        fail_memory(error, bytes);
        return NULL;
    }
    light->texels = at;
    light->made = 1;
    light->level[0] = *cube;
    for (int i = 1; i < ENVIRONMENT_LEVELS; i++) {
        light->level[i] = (struct lam_environment){.size = prefiltered_size(i), .texels = at};
        at += cube_bytes(prefiltered_size(i)) / sizeof *at;
    }
    light->irradiance = (struct lam_environment){.size = IRRADIANCE_SIZE, .texels = at};
    return light;
}

// Returns the lower of the two levels between which prefiltered_look interpolates.
static int lower_level(float level) { return level < ENVIRONMENT_LEVELS - 2 ? (int)level : ENVIRONMENT_LEVELS - 2; }

unsigned environment_light_parts(float first, float last)
{
    unsigned from = 1u << lower_level(first), end = 4u << lower_level(last);
    return (end - from) | 1u << ENVIRONMENT_LEVELS;
}

static bool is_made(const struct environment_light *light, unsigned needed)
{
    return light && (needed & ~__atomic_load_n(&light->made, __ATOMIC_ACQUIRE)) == 0;
}

const struct environment_light *environment_light(const struct lam_environment *cube, unsigned needed,
                                                  struct pool *pool, struct call_control *call, lam_error *error)
{
    static lock one_maker = LOCK_INITIALIZER;
    struct environment_light **kept = (struct environment_light **)(uintptr_t)&cube->light;
    struct environment_light *light = __atomic_load_n(kept, __ATOMIC_ACQUIRE);
    if (is_made(light, needed))
        return light;
    lock_take(&one_maker);
    light = __atomic_load_n(kept, __ATOMIC_ACQUIRE);
    if (!light && (light = start(cube, error)))
        __atomic_store_n(kept, light, __ATOMIC_RELEASE);
    if (light && !is_made(light, needed)) {
        struct pool *own = pool ? NULL : pool_make(0);
        unsigned missing = needed & ~light->made;
        if (fill(light, missing, pool ? pool : own, call, error))
            __atomic_or_fetch(&light->made, missing, __ATOMIC_RELEASE);
        else
            light = NULL;
        pool_free(own);
    }
    lock_give(&one_maker);
    return light;
}

bool lam_environment_light_image(const lam_environment *cube, lam_image *image, const lam_control *control,
                                 lam_error *error)
{
    if (!cube || !image)
        return fail(error, LAM_BAD_ARGUMENT, "lam_environment_light_image: %s is NULL", cube ? "image" : "environment");
    struct call_control call;
    call_start(&call, control);
    uint64_t state = float_state_enter();
    const struct environment_light *light = environment_light(cube, ENVIRONMENT_LIGHT_ALL, NULL, &call, error);
    float_state_leave(state);
    int rows = environment_light_rows();
    if (!light || !lam_image_make(image, ENVIRONMENT_LIGHT_WIDTH, rows, LAM_RGBA32F, error))
        return false;
    float *out = image->pixels;
    const float *from = light->texels;
    for (size_t i = 0; i < (size_t)rows * ENVIRONMENT_LIGHT_WIDTH; i++, out += 4, from += 3) {
        memcpy(out, from, 3 * sizeof *out);
        out[3] = 1;
    }
    return true;
}

CPU_VERSIONS(const struct environment_lookups, environment_lookups);

const struct environment_lookups *environment_lookups_of(int lanes)
{
    return CPU_WIDEST_OF_ALL(lanes, environment_lookups);
}
