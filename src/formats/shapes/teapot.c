// teapot.c: the Utah teapot from its Bézier patches.
//
// Adjacent patches form one parametric surface. u runs around the cross-section: over 4 patches on the body and the
// lid, and over 2 patches on the handle and the spout. On the body, v runs from the centre of the bottom to the rim. On
// the lid, v runs from the edge to the top. On the handle and the spout, v runs away from the body. All joints are
// smooth in the data and share positions and normals. As published, the pot is open: the lid is inside the rim without
// touching it, and the handle and the spout end inside the body's wall.
#include "fail.h"
#include "linear.h"
#include "shapes.h"

// Converts Newell's coordinates to Y up, centred and scaled to a width of 2. Newell's teapot extends from −3 (handle)
// to 3.434075 (spout).
#define TEAPOT_MIDDLE_X   0.2170375625
#define TEAPOT_MIDDLE_Z   1.575
#define TEAPOT_HALF_WIDTH 3.2170375625

static lam_vec3 place(double x, double y, double z)
{
    return v3((x - TEAPOT_MIDDLE_X) / TEAPOT_HALF_WIDTH, (z - TEAPOT_MIDDLE_Z) / TEAPOT_HALF_WIDTH,
              -y / TEAPOT_HALF_WIDTH);
}

enum { PATCHES_AROUND_MAX = 4, BANDS_MAX = 4 };

struct patches {
    lam_vec3 control[BANDS_MAX][PATCHES_AROUND_MAX][4][4]; // [band][patch around][along v][along u]
    int bands, around;
    int u_steps, v_steps; // segments of one patch
};

// Computes the cubic Bernstein polynomials and their derivatives, exact at 0 and 1.
static void bernstein(double t, double b[4], double d[4])
{
    double s = 1 - t;
    b[0] = s * s * s;
    b[1] = 3 * t * s * s;
    b[2] = 3 * t * t * s;
    b[3] = t * t * t;
    d[0] = -3 * s * s;
    d[1] = 3 * s * s - 6 * t * s;
    d[2] = 6 * t * s - 3 * t * t;
    d[3] = 3 * t * t;
}

// Returns the index of the patch that contains a parameter, and sets *within to the parameter in this patch. A
// parameter at a joint belongs to the next patch.
static int patch_of(double x, int steps, int count, double *within)
{
    int patch = (int)(x / steps);
    if (patch >= count)
        patch = count - 1;
    *within = (x - (double)patch * steps) / steps;
    return patch;
}

static void patch_point(void *user, double u, double v, lam_surface_point *out)
{
    const struct patches *patches = user;
    double tu, tv, bu[4], du[4], bv[4], dv[4];
    int column = patch_of(u, patches->u_steps, patches->around, &tu);
    int band = patch_of(v, patches->v_steps, patches->bands, &tv);
    bernstein(tu, bu, du);
    bernstein(tv, bv, dv);
    *out = (lam_surface_point){0};
    for (int j = 0; j < 4; j++) {
        const lam_vec3 *c = patches->control[band][column][j];
        lam_vec3 row = v3(0, 0, 0), row_du = v3(0, 0, 0);
        for (int i = 0; i < 4; i++) {
            row = v3_add(row, v3_scale(c[i], bu[i]));
            row_du = v3_add(row_du, v3_scale(c[i], du[i]));
        }
        out->p = v3_add(out->p, v3_scale(row, bv[j]));
        out->dp_du = v3_add(out->dp_du, v3_scale(row_du, bv[j]));
        out->dp_dv = v3_add(out->dp_dv, v3_scale(row, dv[j]));
    }
}

// Makes four quarters, from the back (+y) to the left, the front and the right: ∂p/∂u × ∂p/∂v points outward.
static void revolve(struct patches *patches, const struct teapot_ring (*bands)[4], int count)
{
    static const double axes[5][2] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}, {0, 1}};
    patches->bands = count;
    patches->around = 4;
    for (int band = 0; band < count; band++)
        for (int quarter = 0; quarter < 4; quarter++)
            for (int j = 0; j < 4; j++) {
                struct teapot_ring r = bands[band][j];
                const double *a = axes[quarter], *b = axes[quarter + 1];
                lam_vec3 *row = patches->control[band][quarter][j];
                row[0] = place(a[0] * r.radius, a[1] * r.radius, r.height);
                row[1] = place(a[0] * r.radius + b[0] * r.step, a[1] * r.radius + b[1] * r.step, r.height);
                row[2] = place(a[0] * r.step + b[0] * r.radius, a[1] * r.step + b[1] * r.radius, r.height);
                row[3] = place(b[0] * r.radius, b[1] * r.radius, r.height);
            }
}

// Makes two halves: from a to b on the viewer's side (−y), and back on the other side.
static void mirror(struct patches *patches, const struct teapot_section (*bands)[4], int count)
{
    patches->bands = count;
    patches->around = 2;
    for (int band = 0; band < count; band++)
        for (int j = 0; j < 4; j++) {
            struct teapot_section s = bands[band][j];
            lam_vec3 *front = patches->control[band][0][j], *back = patches->control[band][1][j];
            front[0] = back[3] = place(s.ax, 0, s.az);
            front[1] = place(s.ax, -s.width, s.az);
            front[2] = place(s.bx, -s.width, s.bz);
            front[3] = back[0] = place(s.bx, 0, s.bz);
            back[1] = place(s.bx, s.width, s.bz);
            back[2] = place(s.ax, s.width, s.az);
        }
}

bool teapot_build(const struct shape_request *request, lam_mesh *mesh)
{
    if (request->stacks > 16384 / BANDS_MAX)
        return fail(request->error, LAM_BAD_ARGUMENT,
                    "shape 'teapot': stacks is %d, expected at most %d along each patch", request->stacks,
                    16384 / BANDS_MAX);
    struct patches parts[4];
    revolve(&parts[0], teapot_body, 4);
    revolve(&parts[1], teapot_lid, 2);
    mirror(&parts[2], teapot_handle, 2);
    mirror(&parts[3], teapot_spout, 2);
    int slices = request->slices ? request->slices : 128;
    lam_parametric surfaces[4];
    for (int i = 0; i < 4; i++) {
        struct patches *part = &parts[i];
        part->u_steps = (slices + 3) / 4;
        // With one segment, half of the handle or spout would be flat, and both halves would coincide.
        if (part->around == 2 && part->u_steps < 2)
            part->u_steps = 2;
        part->v_steps = request->stacks ? request->stacks : 32;
        int u = part->u_steps * part->around, v = part->v_steps * part->bands;
        surfaces[i] = (lam_parametric){.surface = patch_point,
                                       .user = part,
                                       .u_max = u,
                                       .v_max = v,
                                       .u_segments = u,
                                       .v_segments = v,
                                       .u_closed = true};
    }
    return tessellate_parametric(surfaces, 4, request, mesh);
}

// --- martin Newell's teapot (University of Utah, 1975), the control points of its 32 bicubic Bézier patches.
//
// The published list contains 306 points, most of which are rotated or mirrored copies. The body, the rim, the lid and
// the bottom consist of four quarters around the vertical axis. The handle and the spout consist of two mirrored
// halves. This file lists each point once, with the published numbers: z is up, the spout points along +x, the pot
// touches z = 0. The bottom's four patches were added later to Newell's 28 patches.

// A quarter around the axis from direction a to direction b has the control points ra, ra + kb, ka + rb, rb. The factor
// k is 0.56 r, close to a circle's 0.5523 r. For the lid's knob, with r = 0.8, Newell chose 0.45.
const struct teapot_ring teapot_body[4][4] = {
    // the bottom, starting at its centre
    {{0, 0, 0}, {1.425, 0.798, 0}, {1.5, 0.84, 0.075}, {1.5, 0.84, 0.15}},
    // lower body
    {{1.5, 0.84, 0.15}, {1.5, 0.84, 0.225}, {2, 1.12, 0.45}, {2, 1.12, 0.9}},
    // upper body
    {{2, 1.12, 0.9}, {2, 1.12, 1.35}, {1.75, 0.98, 1.875}, {1.5, 0.84, 2.4}},
    // the rim, up to its inside
    {{1.5, 0.84, 2.4}, {1.4375, 0.805, 2.53125}, {1.3375, 0.749, 2.53125}, {1.4, 0.784, 2.4}},
};

const struct teapot_ring teapot_lid[2][4] = {
    // the lid, starting at its edge
    {{1.3, 0.728, 2.4}, {1.3, 0.728, 2.55}, {0.4, 0.224, 2.55}, {0.2, 0.112, 2.7}},
    // the knob, up to its top
    {{0.2, 0.112, 2.7}, {0, 0, 2.85}, {0.8, 0.45, 3.15}, {0, 0, 3.15}},
};

// A half of a cross-section has the control points (ax, 0, az), (ax, ∓width, az), (bx, ∓width, bz), (bx, 0, bz).
const struct teapot_section teapot_handle[2][4] = {
    // upper half, from the body
    {{-1.6, 2.025, -1.5, 2.25, 0.3},
     {-2.3, 2.025, -2.5, 2.25, 0.3},
     {-2.7, 2.025, -3.0, 2.25, 0.3},
     {-2.7, 1.8, -3.0, 1.8, 0.3}},
    // lower half, back to the body
    {{-2.7, 1.8, -3.0, 1.8, 0.3},
     {-2.7, 1.575, -3.0, 1.35, 0.3},
     {-2.5, 1.125, -2.65, 0.9375, 0.3},
     {-2.0, 0.9, -1.9, 0.6, 0.3}},
};

const struct teapot_section teapot_spout[2][4] = {
    // from the body up
    {{1.7, 1.425, 1.7, 0.6, 0.66},
     {2.6, 1.425, 3.1, 0.825, 0.66},
     {2.3, 2.1, 2.4, 2.025, 0.25},
     {2.7, 2.4, 3.3, 2.4, 0.25}},
    // the tip and its inside
    {{2.7, 2.4, 3.3, 2.4, 0.25},
     {2.8, 2.475, 3.525, 2.49375, 0.25},
     {2.9, 2.475, 3.45, 2.5125, 0.15},
     {2.8, 2.4, 3.2, 2.4, 0.15}},
};
