// tangent_kernels.c: computes the flags of triangles and the sums of groups. The build defines ISA and LANES.
#include "tangent_steps.h"

#include "angle_series.h"
#include "double_lanes.h"
#include "linear.h"

#include <float.h>

// --- LANES triangles

typedef float axes[3][LANES];

struct triangles {
    uint32_t vertex[3][LANES]; // elements of the most recently fetched attribute
    axes position[3];          // the positions of the corners
    float s[3][LANES], t[3][LANES];
};

// Fetches the elements of an attribute at the corners of LANES triangles, starting with triangle `first`. After the end
// of the mesh, its last triangle is repeated.
static void fetch_elements(const lam_mesh *mesh, const uint32_t *own, uint32_t first, uint32_t vertex[3][LANES])
{
    uint32_t number[LANES];
    const uint32_t *indices = own ? own : mesh->indices;
    for (int i = 0; i < LANES; i++)
        number[i] = first + (uint32_t)i < mesh->triangle_count ? first + (uint32_t)i : mesh->triangle_count - 1;
    if (indices) {
        inum elements[3];
        igather3(indices, number, 3, elements);
        for (int k = 0; k < 3; k++)
            inum_store((int32_t *)vertex[k], elements[k]);
        return;
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < LANES; i++)
            vertex[k][i] = 3 * number[i] + (uint32_t)k;
}

static void fetch(const lam_mesh *mesh, uint32_t first, struct triangles *out)
{
    fetch_elements(mesh, NULL, first, out->vertex);
    for (int k = 0; k < 3; k++) {
        num p[3];
        gather3(mesh->positions, out->vertex[k], 3, p);
        for (int axis = 0; axis < 3; axis++)
            num_store(out->position[k][axis], p[axis]);
    }
    if (mesh->texcoord_indices)
        fetch_elements(mesh, mesh->texcoord_indices, first, out->vertex);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < LANES; i++) {
            const float *at = mesh->texcoords + 2 * (size_t)out->vertex[k][i];
            out->s[k][i] = at[0];
            out->t[k][i] = at[1];
        }
}

static void fetch_normals(const lam_mesh *mesh, uint32_t first, axes out[3])
{
    uint32_t vertex[3][LANES];
    fetch_elements(mesh, mesh->normal_indices, first, vertex);
    for (int k = 0; k < 3; k++) {
        num n[3];
        gather3(mesh->normals, vertex[k], 3, n);
        for (int axis = 0; axis < 3; axis++)
            num_store(out[k][axis], n[axis]);
    }
}

// --- directions

LANE_FN num length_of(const num v[3]) { return square_root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
LANE_FN mask is_not_zero(num x) { return absolute(x) > FLT_MIN; }

struct directions {
    num along[3]; // unit ∂p/∂s
    mask preserving, joins_any;
};

// Solves p = p0 + ∂p/∂s·Δs + ∂p/∂t·Δt for two edges. The derivatives are multiplied by the triangle's area in the
// texture.
LANE_FN struct directions directions_of(const struct triangles *from)
{
    num s0 = num_load(from->s[0]), t0 = num_load(from->t[0]);
    num s1 = num_load(from->s[1]) - s0, t1 = num_load(from->t[1]) - t0;
    num s2 = num_load(from->s[2]) - s0, t2 = num_load(from->t[2]) - t0;
    num area = s1 * t2 - t1 * s2, along[3], across[3];
    for (int i = 0; i < 3; i++) {
        num p = num_load(from->position[0][i]);
        num d1 = num_load(from->position[1][i]) - p, d2 = num_load(from->position[2][i]) - p;
        along[i] = t2 * d1 - t1 * d2;
        across[i] = s1 * d2 - s2 * d1;
    }
    num along_length = length_of(along), across_length = length_of(across);
    struct directions out = {.preserving = area > 0.0f};
    mask spans = both(is_not_zero(along_length / absolute(area)), is_not_zero(across_length / absolute(area)));
    out.joins_any = negate(both(is_not_zero(area), spans));
    num scale = pick(out.preserving, num_of(1.0f), num_of(-1.0f)) / along_length;
    for (int i = 0; i < 3; i++)
        out.along[i] = pick(is_not_zero(along_length), scale, num_of(0.0f)) * along[i];
    return out;
}

LANE_FN mask equal_positions(const axes a, const axes b)
{
    mask x = num_load(a[0]) == num_load(b[0]), y = num_load(a[1]) == num_load(b[1]);
    return both(both(x, y), num_load(a[2]) == num_load(b[2]));
}

static void look(const lam_mesh *mesh, uint32_t first, uint32_t end, uint8_t *flags)
{
    for (uint32_t at = first; at < end; at += LANES) {
        struct triangles block;
        fetch(mesh, at, &block);
        struct directions d = directions_of(&block);
        const axes *p = block.position;
        mask degenerate =
            either(either(equal_positions(p[0], p[1]), equal_positions(p[1], p[2])), equal_positions(p[2], p[0]));
        inum none = inum_of(0);
        inum_store_8(flags + at, ipick(d.preserving, inum_of(TRIANGLE_PRESERVING), none) |
                                     ipick(d.joins_any, inum_of(TRIANGLE_JOINS_ANY), none) |
                                     ipick(degenerate, inum_of(TRIANGLE_DEGENERATE), none));
    }
}

// --- summands of groups, in double, so that squares and products of floats cannot overflow or underflow

struct dvector {
    dnum x, y, z;
};

LANE_FN dnum ddot(struct dvector a, struct dvector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LANE_FN struct dvector dscale(struct dvector a, dnum s) { return (struct dvector){a.x * s, a.y * s, a.z * s}; }
LANE_FN struct dvector dsubtract(struct dvector a, struct dvector b)
{
    return (struct dvector){a.x - b.x, a.y - b.y, a.z - b.z};
}
LANE_FN struct dvector dload(const axes v, int part)
{
    return (struct dvector){dnum_load_float(v[0] + part), dnum_load_float(v[1] + part), dnum_load_float(v[2] + part)};
}

// Returns 1 / |v|, or 0 for the zero vector.
LANE_FN dnum inverse_length(struct dvector v)
{
    dnum square = ddot(v, v), none = dnum_of(0), one = dnum_of(1);
    return dpick(square > none, one / dsquare_root(dpick(square > none, square, one)), none);
}

// Returns the component of v perpendicular to the unit vector n.
LANE_FN struct dvector in_plane(struct dvector v, struct dvector n) { return dsubtract(v, dscale(n, ddot(n, v))); }

// Returns the angle between two vectors that are perpendicular to n. If either vector is zero, the result is a right
// angle.
LANE_FN dnum angle_between(struct dvector a, struct dvector b, struct dvector n)
{
    struct dvector cross = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    dnum dot = ddot(a, b), sine = dabsolute(ddot(n, cross)), cosine = dabsolute(dot), none = dnum_of(0);
    dmask steep = sine >= cosine;
    dnum larger = dpick(steep, sine, cosine);
    dnum t = dpick(steep, cosine, sine) / dpick(larger > none, larger, dnum_of(1)), z = t * t;
    dnum angle = ANGLE_SERIES(t, z);
    angle = dpick(steep, PI / 2 - angle, angle);
    return dpick(dot < none, PI - angle, angle);
}

static void add(const lam_mesh *mesh, uint32_t first, uint32_t end, const uint8_t *flags, const uint32_t *groups,
                float (*sums)[4])
{
    for (uint32_t at = first; at < end; at += LANES) {
        struct triangles block;
        axes normal[3], along;
        float share[3][4][LANES];
        fetch(mesh, at, &block);
        fetch_normals(mesh, at, normal);
        struct directions d = directions_of(&block);
        for (int i = 0; i < 3; i++)
            num_store(along[i], d.along[i]);
        for (int part = 0; part < LANES; part += DLANES)
            for (int k = 0; k < 3; k++) {
                struct dvector p = dload(block.position[k], part), n = dload(normal[k], part);
                n = dscale(n, inverse_length(n));
                struct dvector to = in_plane(dsubtract(dload(block.position[(k + 1) % 3], part), p), n);
                struct dvector from = in_plane(dsubtract(dload(block.position[(k + 2) % 3], part), p), n);
                struct dvector direction = in_plane(dload(along, part), n);
                dnum angle = angle_between(to, from, n);
                direction = dscale(direction, inverse_length(direction) * angle);
                dnum_store_float(share[k][0] + part, direction.x);
                dnum_store_float(share[k][1] + part, direction.y);
                dnum_store_float(share[k][2] + part, direction.z);
                dnum_store_float(share[k][3] + part, angle);
            }
        for (uint32_t i = 0; i < LANES && at + i < end; i++) {
            if (flags[at + i] & (TRIANGLE_JOINS_ANY | TRIANGLE_DEGENERATE))
                continue;
            for (uint32_t k = 0; k < 3; k++) {
                float *sum = sums[groups[3 * (size_t)(at + i) + k]];
                for (int j = 0; j < 4; j++)
                    sum[j] += share[k][j][i];
            }
        }
    }
}

const struct tangent_kernels FOR_ISA(tangent_kernels) = {look, add};
