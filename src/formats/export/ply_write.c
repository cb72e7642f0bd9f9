// ply_write.c: writes triangles, or points, as binary PLY, with normals, texture coordinates and colours.
#include "export.h"

#include "fail.h"

static void put_vertex(struct exporting *e, const lam_mesh *m, size_t c)
{
    struct text *text = &e->text;
    export_floats(text, export_position(e, m, mesh_element(NULL, m, c)));
    if (m->normals)
        export_floats(text, export_normal(e, m, mesh_element(m->normal_indices, m, c)));
    for (size_t k = 0; m->texcoords && k < 2; k++)
        export_float(text, (double)m->texcoords[2 * (size_t)mesh_element(m->texcoord_indices, m, c) + k]);
    if (m->colors) {
        uint8_t bytes[4];
        export_color_bytes(m, export_color_element(m, c), bytes);
        text_add_part(text, (const char *)bytes, 4);
    }
}

static void lose(struct exporting *e, const lam_mesh *m, bool points)
{
    export_lose_objects(e, "PLY does not support them");
    export_lose_digits(e, m);
    if (export_material_count(e))
        export_lose(e, "materials are omitted (%d): PLY does not support them", export_material_count(e));
    if (e->flat[EXPORT_LINES].line_count)
        export_lose(e, "lines are omitted: most PLY readers do not support them");
    if (!points && e->flat[EXPORT_POINTS].point_count)
        export_lose(e, "points are omitted: a PLY file with triangles cannot contain points");
    export_lose_surroundings(e, false);
}

static bool write(struct exporting *e)
{
    bool points = !e->flat[EXPORT_TRIANGLES].triangle_count;
    const lam_mesh *m = &e->flat[points ? EXPORT_POINTS : EXPORT_TRIANGLES];
    struct text *text = &e->text;
    struct export_vertices vertices;
    if (!mesh_corners(m))
        return fail(e->error, LAM_BAD_ARGUMENT,
                    "%s: found neither triangles nor points, and lambent writes only these to PLY", e->name);
    if (!export_share_vertices(e, m, &vertices))
        return false;
    text_print(
        text,
        "ply\nformat binary_little_endian 1.0\nelement vertex %lu\nproperty float x\nproperty float y\n"
        "property float z\n%s%s%s",
        (unsigned long)vertices.count, m->normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        m->texcoords ? "property float s\nproperty float t\n" : "",
        m->colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n" : "");
    if (!points)
        text_print(text, "element face %lu\nproperty list uchar int vertex_indices\n",
                   (unsigned long)m->triangle_count);
    text_add(text, "end_header\n");
    for (size_t i = 0; i < vertices.count && !text->failed; i++)
        put_vertex(e, m, vertices.corners[i]);
    for (size_t c = 0; !points && c < mesh_corners(m) && !text->failed; c++) {
        if (c % 3 == 0)
            text_add_part(text, "\3", 1);
        export_word(text, vertices.numbers[c]);
    }
    if (e->scene)
        lose(e, m, points);
    return true;
}

const struct exporter exporter_ply = {"ply", LAM_UP_Y, true, write};
