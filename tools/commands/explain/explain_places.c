// explain_places.c: prints the transforms of a triangle from its mesh to the window: the matrices, and each point in
// each space.
#include "explain.h"

#include <stdio.h>

#include "explain_json.h"

static lam_vec3 unit(lam_vec3 v)
{
    double length = __builtin_sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return length > 0 ? (lam_vec3){v.x / length, v.y / length, v.z / length} : v;
}

static lam_vec3 to_eye(const lam_explained_matrices *m, lam_vec3 n)
{
    double out[3];
    for (int i = 0; i < 3; i++)
        out[i] = m->normal[i][0] * n.x + m->normal[i][1] * n.y + m->normal[i][2] * n.z;
    return unit((lam_vec3){out[0], out[1], out[2]});
}

static void print_matrix(const char *name, const double *numbers, int size, const char *remark)
{
    for (int row = 0; row < size; row++) {
        row_label(2, row ? "" : name);
        for (int column = 0; column < size; column++)
            printf("%13.7g%s", numbers[row * size + column] + 0.0, column + 1 < size ? " " : "");
        printf("%s%s\n", row || !*remark ? "" : "   ", row ? "" : remark);
    }
}

static void print_matrices(const lam_explained_matrices *m)
{
    printf("\n");
    print_matrix("model-view matrix", &m->model_view.m[0][0], 4, "object → eye");
    print_matrix("projection matrix", &m->projection.m[0][0], 4, "eye → clip");
    print_matrix("normal matrix", &m->normal[0][0], 3,
                 "normals: inverse transpose of the model-view matrix's 3×3 block");
}

// Prints the face normal (p1 − p0) × (p2 − p0), used for flat shading and for meshes without normals.
static void print_face_normal(const lam_explained_fragment *f)
{
    lam_vec3 first = f->places[0].mesh_position;
    lam_vec3 a = minus(f->places[1].mesh_position, first), b = minus(f->places[2].mesh_position, first);
    lam_vec3 product = cross(a, b);
    printf("  the triangle's normal\n");
    row_vector(4, "p1 − p0", a, "object; p0, p1, p2 are the corners");
    row_vector(4, "p2 − p0", b, "");
    row_vector(4, "cross product", product, "(p1 − p0) × (p2 − p0)");
    row_vector(4, "n", to_eye(f->matrices, product), "normal matrix · cross product, normalised");
}

static void print_place(const lam_explained_fragment *f, int i, int width, int height)
{
    const lam_explained_place *p = &f->places[i];
    char window[120];
    row_vector(4, "object", p->mesh_position, i == 3 ? "Σ weight · corner" : "");
    row_vector(4, "eye", p->eye_position, i ? "" : "model-view matrix · object");
    row_label(4, "clip");
    printf("%13.7g %13.7g %13.7g %13.7g%s\n", p->clip[0] + 0.0, p->clip[1] + 0.0, p->clip[2] + 0.0, p->clip[3] + 0.0,
           i ? "" : "   projection matrix · eye");
    if (p->clip[3] > 0) {
        snprintf(window, sizeof window,
                 "(x + 1) · %d/2, (y + 1) · %d/2, (z + 1)/2 of NDC: pixels from the lower left; depth", width, height);
        row_three(4, "NDC", p->ndc[0], p->ndc[1], p->ndc[2], i ? "" : "clip ÷ w");
        row_three(4, "window", p->window[0], p->window[1], p->window[2], i ? "" : window);
    } else {
        row_label(4, "NDC, window");
        printf("%13s   behind the eye: w ≤ 0\n", "none");
    }
    if (i == 3 || f->face_normal)
        return;
    row_vector(4, "normal", p->normal, i ? "" : "of the mesh, object");
    row_vector(4, "n", to_eye(f->matrices, p->normal), i ? "" : "normal matrix · normal, normalised");
}

void explain_places(const lam_explanation *e, const lam_explained_fragment *f)
{
    static const char *const names[] = {"corner 0", "corner 1", "corner 2", "the point"};
    if (!f->places || !f->matrices)
        return;
    print_matrices(f->matrices);
    printf("\n");
    row_label(2, "from the mesh to the window");
    printf("%13s %13s %13s %13s\n", "x", "y", "z", "w");
    for (int i = 0; i < 4; i++) {
        printf("  %s\n", names[i]);
        print_place(f, i, e->width, e->height);
    }
    double plane[4];
    explain_plane(f, plane);
    row_label(2, "plane a b c d");
    printf("%13.7g %13.7g %13.7g %13.7g   a x + b y + c z + d = 0, object; (a b c) is the face's unit normal\n",
           plane[0] + 0.0, plane[1] + 0.0, plane[2] + 0.0, plane[3] + 0.0);
    if (f->winding - f->winding == 0)
        row_number(2, "winding", f->winding,
                   f->winding > 0 ? "counter-clockwise; (x3−x2)(y1−y2) − (y3−y2)(x1−x2) in the window"
                                  : "clockwise; (x3−x2)(y1−y2) − (y3−y2)(x1−x2) in the window");
    if (f->face_normal)
        print_face_normal(f);
}
