// mesh_save.c: writes a mesh as a model file: OBJ, STL (binary) or PLY (binary, little endian).
#include "fail.h"
#include "file.h"
#include "linear.h"
#include "text_builder.h"

#include <lambent/scene.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct writer {
    const lam_mesh *mesh;
    lam_up from, to; // the axis that is up in the mesh, and in the format
    struct text text;
};

static uint32_t element(const uint32_t *own, const lam_mesh *mesh, size_t corner)
{
    return own ? own[corner] : mesh->indices ? mesh->indices[corner] : (uint32_t)corner;
}

// A vector, rotated about one axis so that up stays up.
static lam_vec3 turned(const struct writer *w, lam_vec3 p)
{
    if (w->from == LAM_UP_X)
        p = v3(-p.y, p.x, p.z);
    else if (w->from == LAM_UP_Z)
        p = v3(p.x, p.z, -p.y);
    return w->to == LAM_UP_Z ? v3(p.x, -p.z, p.y) : p;
}

static lam_vec3 position(const struct writer *w, uint32_t vertex)
{
    const float *p = w->mesh->positions + 3 * (size_t)vertex;
    const double *o = w->mesh->origin;
    return turned(w, v3((double)p[0] + o[0], (double)p[1] + o[1], (double)p[2] + o[2]));
}

static lam_vec3 normal(const struct writer *w, uint32_t index)
{
    const float *n = w->mesh->normals + 3 * (size_t)index;
    return turned(w, v3_unit(v3((double)n[0], (double)n[1], (double)n[2])));
}

// Prints a number with all digits of a float, or of a double if it is not exactly a float; with a point in every
// locale.
static void add_number(struct text *text, double x)
{
    char digits[40], plain[40];
    size_t length = 0;
    snprintf(digits, sizeof digits, (double)(float)x == x ? "%.9g" : "%.17g", x + 0.0);
    bool point = false;
    for (const char *c = digits; *c; c++) {
        bool usual = (*c >= '0' && *c <= '9') || *c == '-' || *c == '+' || *c == 'e';
        if (usual || !point)
            plain[length++] = usual ? *c : '.';
        point |= !usual;
    }
    text_add_part(text, plain, length);
}

static void add_line(struct text *text, const char *word, const double *numbers, int count)
{
    text_add(text, word);
    for (int i = 0; i < count; i++) {
        text_add(text, " ");
        add_number(text, numbers[i]);
    }
    text_add(text, "\n");
}

static void add_vector(struct text *text, const char *word, lam_vec3 p)
{
    add_line(text, word, (double[3]){p.x, p.y, p.z}, 3);
}

static bool write_obj(struct writer *w, lam_error *error)
{
    (void)error;
    const lam_mesh *m = w->mesh;
    struct text *text = &w->text;
    if (m->name)
        text_print(text, "o %.200s\n", m->name);
    for (uint32_t i = 0; i < m->vertex_count; i++)
        add_vector(text, "v", position(w, i));
    for (uint32_t i = 0; m->texcoords && i < m->texcoord_count; i++)
        add_line(text, "vt", (double[2]){(double)m->texcoords[2 * (size_t)i], (double)m->texcoords[2 * (size_t)i + 1]},
                 2);
    for (uint32_t i = 0; m->normals && i < m->normal_count; i++)
        add_vector(text, "vn", normal(w, i));
    for (size_t t = 0; t < m->triangle_count; t++) {
        text_add(text, "f");
        for (size_t c = 3 * t; c < 3 * t + 3; c++) {
            text_print(text, " %lu", element(NULL, m, c) + 1UL);
            if (m->texcoords)
                text_print(text, "/%lu", element(m->texcoord_indices, m, c) + 1UL);
            if (m->normals)
                text_print(text, m->texcoords ? "/%lu" : "//%lu", element(m->normal_indices, m, c) + 1UL);
        }
        text_add(text, "\n");
    }
    return true;
}

static void add_word(struct text *text, uint32_t value)
{
    char bytes[4] = {(char)(value & 255), (char)(value >> 8 & 255), (char)(value >> 16 & 255), (char)(value >> 24)};
    text_add_part(text, bytes, 4);
}

static void add_float(struct text *text, double x)
{
    float rounded = (float)(x + 0.0);
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    add_word(text, bits);
}

static void add_floats(struct text *text, lam_vec3 p)
{
    add_float(text, p.x);
    add_float(text, p.y);
    add_float(text, p.z);
}

static bool write_stl(struct writer *w, lam_error *error)
{
    (void)error;
    const lam_mesh *m = w->mesh;
    char head[81];
    snprintf(head, sizeof head, "%-80.80s", m->name ? m->name : "mesh"); // not "solid", as text files begin
    text_add_part(&w->text, strncmp(head, "solid", 5) == 0 ? "mesh " : head, strncmp(head, "solid", 5) == 0 ? 5 : 80);
    while (w->text.length < 80 && !w->text.failed)
        text_add(&w->text, " ");
    add_word(&w->text, m->triangle_count);
    for (size_t t = 0; t < m->triangle_count; t++) {
        lam_vec3 p[3];
        for (size_t k = 0; k < 3; k++)
            p[k] = position(w, element(NULL, m, 3 * t + k));
        add_floats(&w->text, v3_unit(v3_cross(v3_sub(p[1], p[0]), v3_sub(p[2], p[0]))));
        for (int k = 0; k < 3; k++)
            add_floats(&w->text, p[k]);
        text_add_part(&w->text, "\0", 2);
    }
    return true;
}

// PLY has one number for a corner's position, normal and texture coordinate: corners with the same three share a vertex.
struct ply_vertex {
    uint32_t position, normal, texcoord;
};

static bool write_ply(struct writer *w, lam_error *error)
{
    const lam_mesh *m = w->mesh;
    size_t corners = 3 * (size_t)m->triangle_count, slots = 64, count = 0;
    while (slots < 2 * corners)
        slots *= 2;
    struct ply_vertex *vertices = malloc((corners + 1) * sizeof *vertices);
    uint32_t *table = malloc(slots * sizeof *table), *numbers = malloc((corners + 1) * sizeof *numbers);
    bool ok = vertices && table && numbers;
    if (ok)
        memset(table, 0xff, slots * sizeof *table);
    for (size_t c = 0; ok && c < corners; c++) {
        struct ply_vertex v = {element(NULL, m, c), m->normals ? element(m->normal_indices, m, c) : 0,
                               m->texcoords ? element(m->texcoord_indices, m, c) : 0};
        uint64_t hash =
            (v.position * UINT64_C(0x9e3779b97f4a7c15) ^ v.normal) * UINT64_C(0xbf58476d1ce4e5b9) ^ v.texcoord;
        size_t slot = (size_t)((hash * UINT64_C(0x94d049bb133111eb)) >> 20) & (slots - 1);
        while (table[slot] != UINT32_MAX && memcmp(&vertices[table[slot]], &v, sizeof v) != 0)
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == UINT32_MAX) {
            table[slot] = (uint32_t)count;
            vertices[count++] = v;
        }
        numbers[c] = table[slot];
    }
    text_print(&w->text,
               "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
               "property float z\n%s%selement face %lu\nproperty list uchar int vertex_indices\nend_header\n",
               count, m->normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
               m->texcoords ? "property float s\nproperty float t\n" : "", (unsigned long)m->triangle_count);
    for (size_t i = 0; ok && i < count; i++) {
        add_floats(&w->text, position(w, vertices[i].position));
        if (m->normals)
            add_floats(&w->text, normal(w, vertices[i].normal));
        for (size_t k = 0; m->texcoords && k < 2; k++)
            add_float(&w->text, (double)m->texcoords[2 * (size_t)vertices[i].texcoord + k]);
    }
    for (size_t c = 0; ok && c < corners; c++) {
        if (c % 3 == 0)
            text_add_part(&w->text, "\3", 1);
        add_word(&w->text, numbers[c]);
    }
    free(vertices);
    free(table);
    free(numbers);
    return ok || fail_memory(error, corners * 24);
}

// The formats, by the endings of names, and the axis that is up in them.
static const struct format {
    const char *ending;
    lam_up up;
    bool (*write)(struct writer *w, lam_error *error);
} formats[] = {{"obj", LAM_UP_Y, write_obj}, {"stl", LAM_UP_Z, write_stl}, {"ply", LAM_UP_Y, write_ply}};

enum { FORMATS = (int)(sizeof formats / sizeof *formats) };

const char *lam_mesh_format(int index) { return index >= 0 && index < FORMATS ? formats[index].ending : NULL; }

static const struct format *find_format(const char *path, lam_error *error)
{
    const char *ending = path_ending(path);
    char list[16 * FORMATS] = "";
    for (int i = 0; i < FORMATS; i++) {
        if (strcmp(ending, formats[i].ending) == 0)
            return &formats[i];
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s.%s",
                 i == 0             ? ""
                 : i + 1 == FORMATS ? " or "
                                    : ", ",
                 formats[i].ending);
    }
    fail(error, LAM_UNSUPPORTED, "%s: found the ending '%.20s', expected %s", path, ending, list);
    return NULL;
}

bool lam_mesh_save(const lam_mesh *mesh, const char *path, lam_up up, lam_error *error)
{
    if (!mesh || !path)
        return fail(error, LAM_BAD_ARGUMENT, "lam_mesh_save: %s is NULL", mesh ? "path" : "mesh");
    if (!check_reserved("lam_mesh", mesh, error))
        return false;
    if (!mesh->triangle_count || !mesh->positions)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the mesh has no triangles", path);
    const struct format *format = find_format(path, error);
    if (!format)
        return false;
    struct writer w = {.mesh = mesh, .from = up, .to = format->up};
    bool ok = format->write(&w, error);
    if (ok && w.text.failed) {
        ok = false;
        if (error)
            *error = w.text.error;
    }
    ok = ok && file_write(path, w.text.bytes, w.text.length, false, NULL, error);
    free(w.text.bytes);
    return ok;
}
