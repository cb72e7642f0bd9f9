// facets.c: computes facet normals, for one triangle or for some triangles of a mesh. Each triangle's normal is a
// separate element.
#include "facets.h"

#include "corner_fan.h"
#include "linear.h"
#include "loop_status.h"

void facet_normal(const lam_mesh *mesh, size_t triangle, float normal[3])
{
    lam_vec3 p[3];
    for (size_t k = 0; k < 3; k++) {
        const float *at = mesh->positions + 3 * (size_t)corner_vertex(mesh, 3 * triangle + k);
        p[k] = v3((double)at[0], (double)at[1], (double)at[2]);
    }
    lam_vec3 n = v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0]));
    double length = math_sqrt(v3_dot(n, n)), inverse = 1 / length; // in double, products of floats cannot overflow
    bool there = length > 0 && math_finite(length);
    normal[0] = there ? (float)(n.x * inverse) : 0;
    normal[1] = there ? (float)(n.y * inverse) : 0;
    normal[2] = there ? (float)(n.z * inverse) : 0;
}

enum { WORDS = 1 << 7 }; // words of the set per task

struct facet_loop {
    const lam_mesh *mesh;
    struct visible_normals *visible;
    struct loop_status loop;
    size_t first, end, first_word; // numbers in the set
    uint32_t before;               // number of members of the set that belong to earlier meshes
    uint32_t element;              // element of the first member that belongs to the mesh
};

static uint32_t members_below(const struct rank_bitset *set, size_t number)
{
    return number < set->size ? rank_bitset_rank(set, number) : set->count;
}

static void make_facets(void *user, size_t index, int thread)
{
    (void)thread;
    struct facet_loop *l = user;
    struct visible_normals *visible = l->visible;
    const struct rank_bitset *set = &visible->triangles;
    size_t from = (l->first_word + index * WORDS) * 64, to = from + (size_t)WORDS * 64;
    from = from > l->first ? from : l->first;
    to = to < l->end ? to : l->end;
    if (from >= to || !should_continue(&l->loop))
        return;
    uint32_t rank = members_below(set, from);
    for (size_t word = from / 64; word <= (to - 1) / 64; word++) {
        uint64_t bits = set->bits[word];
        if (word == from / 64)
            bits &= ~(uint64_t)0 << from % 64;
        if (word == to / 64)
            bits &= ((uint64_t)1 << to % 64) - 1;
        for (; bits; bits &= bits - 1, rank++) {
            size_t triangle = 64 * word + (size_t)__builtin_ctzll(bits) - l->first;
            uint32_t element = l->element + (rank - l->before);
            facet_normal(l->mesh, triangle, visible->normals[element]);
            if (visible->first_corners)
                visible->first_corners[element] = (uint32_t)(3 * triangle);
            for (size_t k = 0; k < 3; k++)
                visible->elements[3 * (size_t)rank + k] = element;
        }
    }
}

bool make_visible_facets(const lam_mesh *mesh, uint32_t first, struct visible_normals *visible, struct pool *pool,
                         struct call_control *call, lam_error *error)
{
    const struct rank_bitset *set = &visible->triangles;
    struct facet_loop l = {.mesh = mesh,
                           .visible = visible,
                           .loop = {.call = call},
                           .first = first,
                           .end = (size_t)first + mesh->triangle_count,
                           .first_word = first / 64,
                           .before = members_below(set, first),
                           .element = visible->used};
    visible->used += members_below(set, l.end) - l.before;
    pool_run(pool, (l.end / 64 - l.first_word) / WORDS + 1, make_facets, &l);
    return should_continue(&l.loop) || loop_error(&l.loop, 0, error);
}
