// mesh_edges.c: finds the edges of a mesh. Corners are welded into vertices by position. For each vertex, the edges to
// vertices with higher numbers are sorted by their other end, so that equal edges are adjacent.
#include "mesh_edges.h"

#include "tangent_steps.h"
#include "edge_keys.h"

enum { CHECK_INTERVAL = 1 << 14 }; // number of edge ends between two checks for cancellation

static bool is_inner(const lam_mesh *mesh, uint32_t corner)
{
    return mesh->inner_edges && mesh->inner_edges[corner / 3] >> (corner % 3) & 1;
}

// Returns the third vertex of the triangle whose edge starts at a corner.
static uint32_t apex_of(const struct corner_weld *weld, uint32_t corner)
{
    return weld->of[corner - corner % 3 + (corner % 3 + 2) % 3];
}

// Returns the edge that begins at each of these `count` corners. Triangles with the same three vertices are one face,
// because files may contain each face twice, once for each side. If the second face of an edge occurs twice, the
// function uses the copy that traverses the edge in the opposite direction to the first face.
static struct mesh_edge edge_of(const lam_mesh *mesh, const struct corner_weld *weld, const uint64_t *keys,
                                uint32_t count)
{
    struct mesh_edge edge = {.corner = (uint32_t)keys[0], .other = (uint32_t)keys[0]};
    uint32_t apexes[2] = {apex_of(weld, edge.corner), UINT32_MAX}, faces = 1;
    bool inner = true, cut = false;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t corner = (uint32_t)keys[i], apex = apex_of(weld, corner);
        inner &= is_inner(mesh, corner);
        cut |= mesh->inner_edges && mesh->inner_edges[corner / 3] & 8;
        if (apex == apexes[0])
            continue;
        if (faces == 1 || (apex == apexes[1] && weld->of[corner] != weld->of[edge.corner]))
            edge.other = corner;
        if (faces == 1 || apex != apexes[1])
            apexes[1] = faces++ == 1 ? apex : apexes[1];
    }
    edge.kind = (inner ? EDGE_INNER : 0) | (faces == 1 ? EDGE_OPEN : 0) | (faces > 2 ? EDGE_SHARED : 0);
    edge.kind |= cut && !inner ? EDGE_CUT : 0;
    if (faces == 2 && weld->of[edge.corner] == weld->of[edge.other])
        edge.kind |= EDGE_ALIKE;
    return edge;
}

// Gets the ends of the edge that starts at a corner, the lower vertex first. Returns false if the triangle has equal
// corners.
static bool ends_of(const struct corner_weld *weld, uint32_t corner, uint32_t *low, uint32_t *high)
{
    uint32_t first = corner - corner % 3;
    uint32_t v[3] = {weld->of[first], weld->of[first + (size_t)1], weld->of[first + (size_t)2]};
    uint32_t a = v[corner % 3], b = v[(corner + 1) % 3];
    *low = a < b ? a : b;
    *high = a < b ? b : a;
    return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

static uint32_t list_edges(const lam_mesh *mesh, struct mesh_edge *edges, struct arena *memory,
                           struct call_control *call, bool *failed, lam_error *error)
{
    struct corner_weld weld;
    lam_mesh positions = {.positions = mesh->positions,
                          .vertex_count = mesh->vertex_count,
                          .indices = mesh->indices,
                          .triangle_count = mesh->triangle_count};
    size_t corners = 3 * (size_t)mesh->triangle_count;
    *failed = true;
    if (!corner_weld(&weld, &positions, memory, call, error))
        return 0;
    uint32_t *starts = arena_alloc_zeroed(memory, ((size_t)weld.items + 1) * sizeof *starts), low, high, count = 0;
    uint64_t *keys = arena_array(memory, corners, sizeof *keys);
    if (!starts || !keys)
        return call_memory_error(call, corners * (sizeof *keys + sizeof *starts), error), 0;
    for (uint32_t c = 0; c < corners; c++)
        if (ends_of(&weld, c, &low, &high))
            starts[low + 1]++;
    for (size_t v = 0; v < weld.items; v++)
        starts[v + 1] += starts[v];
    for (uint32_t c = 0; c < corners; c++) // each start advances to the end of its list
        if (ends_of(&weld, c, &low, &high))
            keys[starts[low]++] = edge_key(high, c);
    for (uint32_t v = 0, from = 0; v < weld.items; v++) {
        uint32_t to = starts[v];
        if (v % CHECK_INTERVAL == 0 && !call_should_continue(call))
            return call_error(call, error), 0;
        sort_edge_keys(keys + from, to - from);
        for (uint32_t next; from < to; from = next) {
            for (next = from + 1; next < to && keys[next] >> 32 == keys[from] >> 32; next++)
                ;
            edges[count++] = edge_of(mesh, &weld, keys + from, next - from);
        }
    }
    *failed = false;
    return count;
}

uint32_t mesh_edges(const lam_mesh *mesh, struct mesh_edge *edges, struct call_control *call, bool *failed,
                    lam_error *error)
{
    struct arena memory;
    arena_start(&memory, call);
    uint32_t count = list_edges(mesh, edges, &memory, call, failed, error);
    arena_free(&memory);
    return count;
}
