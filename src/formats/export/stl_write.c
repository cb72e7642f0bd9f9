// stl_write.c: writes triangles as binary STL.
#include "export.h"

#include "fail.h"
#include "linear.h"

#include <stdio.h>
#include <string.h>

static bool write(struct exporting *e)
{
    const lam_mesh *m = &e->flat[EXPORT_TRIANGLES];
    struct text *text = &e->text;
    char head[81];
    if (!m->triangle_count)
        return fail(e->error, LAM_BAD_ARGUMENT, "%s: found no triangles, and STL supports nothing else", e->name);
    const char *name = m->name ? m->name : "mesh";
    snprintf(head, sizeof head, "%-80.80s",
             // ASCII files begin with "solid", so binary files must not
             strncmp(name, "solid", 5) == 0 ? "mesh" : name);
    text_add_part(text, head, 80);
    export_word(text, m->triangle_count);
    for (size_t t = 0; t < m->triangle_count && !text->failed; t++) {
        lam_vec3 p[3];
        for (size_t k = 0; k < 3; k++)
            p[k] = export_position(e, m, mesh_element(NULL, m, 3 * t + k));
        export_floats(text, v3_unit(v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0]))));
        for (int k = 0; k < 3; k++)
            export_floats(text, p[k]);
        text_add_part(text, "\0", 2);
    }
    if (!e->scene)
        return true;
    if (m->normals && !export_has_usual_normals(e))
        export_lose(e, "normals are omitted: STL has one per triangle, and most readers compute smooth normals");
    export_lose_objects(e, "STL does not support them");
    export_lose_digits(e, m);
    if (m->colors)
        export_lose(e, "colours are omitted: programs disagree on how STL stores them");
    if (m->texcoords)
        export_lose(e, "texture coordinates are omitted: STL does not support them");
    if (export_material_count(e))
        export_lose(e, "materials are omitted (%d): STL does not support them", export_material_count(e));
    if (e->flat[EXPORT_LINES].line_count || e->flat[EXPORT_POINTS].point_count)
        export_lose(e, "lines and points are omitted: STL does not support them");
    export_lose_surroundings(e, false);
    return true;
}

const struct exporter exporter_stl = {"stl", LAM_UP_Z, true, write};
