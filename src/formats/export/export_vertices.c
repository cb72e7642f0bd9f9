// export_vertices.c: merges corners with equal attributes into vertices, for formats with one index for all attributes
// of a corner. This file also converts colours and textures for the writers.
#include "export.h"
#include "linear.h"
#include "srgb.h"
#include "texture_levels.h"

#include <stdio.h>
#include <string.h>

enum { ATTRIBUTES = 6 };

// For each attribute of a corner, the index of the attribute's element in the mesh.
struct corner {
    uint32_t elements[ATTRIBUTES];
};

uint32_t export_color_element(const lam_mesh *m, size_t corner)
{
    return m->colors_rate == LAM_PER_TRIANGLE ? (uint32_t)(corner / (mesh_corners(m) / mesh_items(m)))
                                              : mesh_element(m->color_indices, m, corner);
}

static struct corner corner_of(const lam_mesh *m, size_t c)
{
    return (struct corner){{mesh_element(NULL, m, c), m->normals ? mesh_element(m->normal_indices, m, c) : 0,
                            m->texcoords ? mesh_element(m->texcoord_indices, m, c) : 0,
                            m->second_texcoords ? mesh_element(m->second_texcoord_indices, m, c) : 0,
                            m->tangents ? mesh_element(m->tangent_indices, m, c) : 0,
                            m->colors ? export_color_element(m, c) : 0}};
}

static size_t slot_of(const struct corner *corner, size_t slots)
{
    uint64_t hash = 0;
    for (int i = 0; i < ATTRIBUTES; i++)
        hash = (hash ^ corner->elements[i]) * UINT64_C(0x9e3779b97f4a7c15) + (hash >> 29);
    return (size_t)(hash >> 20) & (slots - 1);
}

bool export_share_vertices(struct exporting *e, const lam_mesh *mesh, struct export_vertices *out)
{
    size_t corners = mesh_corners(mesh), slots = 64;
    while (slots < 2 * corners)
        slots *= 2;
    uint32_t *firsts = arena_array(e->arena, corners + 1, sizeof *firsts),
             *table = export_memory(e, slots * sizeof *table),
             *numbers = arena_array(e->arena, corners + 1, sizeof *numbers), count = 0;
    if (!firsts || !table || !numbers) {
        export_memory_free(e, table, slots * sizeof *table);
        return export_no_memory(e, corners * 8 + slots * 4);
    }
    memset(table, 0xff, slots * sizeof *table);
    for (size_t c = 0; c < corners && export_continues(e, c); c++) {
        struct corner corner = corner_of(mesh, c);
        size_t slot = slot_of(&corner, slots);
        for (; table[slot] != UINT32_MAX; slot = (slot + 1) & (slots - 1)) {
            struct corner other = corner_of(mesh, firsts[table[slot]]);
            if (memcmp(&other, &corner, sizeof corner) == 0)
                break;
        }
        if (table[slot] == UINT32_MAX) {
            table[slot] = count;
            firsts[count++] = (uint32_t)c;
        }
        numbers[c] = table[slot];
    }
    export_memory_free(e, table, slots * sizeof *table);
    *out = (struct export_vertices){count, firsts, numbers};
    return export_is_whole(e);
}

// --- colours

void export_color(const lam_mesh *mesh, size_t element, float color[4])
{
    size_t at = 4 * element;
    if (mesh->colors_format == LAM_COLORS_LINEAR_F32) {
        memcpy(color, (const float *)mesh->colors + at, 4 * sizeof *color);
        return;
    }
    const uint8_t *bytes = (const uint8_t *)mesh->colors + at;
    for (int i = 0; i < 4; i++) {
        double share = bytes[i] / 255.0;
        color[i] = (float)(i < 3 && mesh->colors_format == LAM_COLORS_SRGB8 ? srgb_linear(share) : share);
    }
}

// Values below 1 are encoded as sRGB. The reader rounds the number to a float and decodes it. If a quotient of a byte
// and 255 decodes to exactly `light`, the function returns this quotient. Otherwise, it returns the smallest float
// between 0 and 1 that decodes to at least `light`. A colour read from OBJ or MTL is therefore written with its
// original number.
double export_encoded(float light)
{
    uint32_t low = 0, high = 0x3f800000; // the bit patterns of the floats 0 and 1
    if (!(light > 0) || light >= 1)
        return light > 0 ? (double)light : 0;
    float number = (float)(srgb_byte((double)light) / 255.0);
    if ((float)srgb_linear((double)number) == light)
        return (double)number;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        memcpy(&number, &middle, sizeof number);
        if ((float)srgb_linear((double)number) < light)
            low = middle + 1;
        else
            high = middle;
    }
    memcpy(&number, &low, sizeof number);
    return (double)number;
}

void export_color_bytes(const lam_mesh *mesh, size_t element, uint8_t bytes[4])
{
    float color[4];
    if (mesh->colors_format == LAM_COLORS_SRGB8) {
        memcpy(bytes, (const uint8_t *)mesh->colors + 4 * element, 4);
        return;
    }
    export_color(mesh, element, color);
    for (int i = 0; i < 3; i++)
        bytes[i] = srgb_byte((double)color[i]);
    float alpha = color[3] > 0 ? color[3] < 1 ? color[3] : 1 : 0;
    bytes[3] = (uint8_t)(alpha * 255 + 0.5f);
}

// --- pictures

bool export_texture(struct exporting *e, const lam_texture *texture, lam_bytes *png)
{
    const struct texture_level *level = &texture->levels[0];
    *png = (lam_bytes){0};
    if (!texture->bytes) {
        export_lose(e,
                    "the picture %s is omitted: it has more than 8 bits per channel, which PNG in a model cannot store",
                    texture->name ? texture->name : "of a material");
        return false;
    }
    lam_image image = {.width = level->width,
                       .height = level->height,
                       .pixels = (void *)(uintptr_t)texture->bytes,
                       .format = texture->channels == 3 ? LAM_RGB8 : LAM_RGBA8};
    lam_save_params params = {.raw = texture->values == LAM_TEXTURE_NUMBERS, .control = e->params->control};
    return export_is_whole(e) && lam_image_encode(&image, "png", &params, png, e->error);
}

// --- writes the numbers in model files, and rotates vectors to the up axis of a format.

lam_vec3 export_turned(const struct exporting *e, lam_vec3 p)
{
    switch (e->from) { // rotates the vector from the scene's up axis to y up
    case LAM_UP_X:
        p = v3(-p.y, p.x, p.z);
        break;
    case LAM_UP_NEGATIVE_X:
        p = v3(p.y, -p.x, p.z);
        break;
    case LAM_UP_NEGATIVE_Y:
        p = v3(-p.x, -p.y, p.z);
        break;
    case LAM_UP_Z:
        p = v3(p.x, p.z, -p.y);
        break;
    case LAM_UP_NEGATIVE_Z:
        p = v3(-p.x, -p.z, -p.y);
        break;
    default:
        break;
    }
    return e->to == LAM_UP_Z ? v3(p.x, -p.z, p.y) : p;
}

lam_vec3 export_position(const struct exporting *e, const lam_mesh *mesh, uint32_t vertex)
{
    const float *p = mesh->positions + 3 * (size_t)vertex;
    const double *o = mesh->origin;
    return export_turned(e, v3((double)p[0] + o[0], (double)p[1] + o[1], (double)p[2] + o[2]));
}

// Normalises the normal only if its length is not 1 within rounding errors, so that reading and writing a file
// preserves the numbers.
lam_vec3 export_normal(const struct exporting *e, const lam_mesh *mesh, uint32_t index)
{
    const float *n = mesh->normals + 3 * (size_t)index;
    lam_vec3 normal = v3((double)n[0], (double)n[1], (double)n[2]);
    double square = v3_dot(normal, normal);
    return export_turned(e, square > 0.999999 && square < 1.000001 ? normal : v3_unit(normal));
}

void export_number(struct text *text, double x)
{
    char digits[40], plain[40];
    size_t length = 0;
    snprintf(digits, sizeof digits, (double)(float)x == x ? "%.9g" : "%.17g", x + 0.0);
    bool point = false;
    for (const char *c = digits; *c; c++) { // the decimal separator becomes a point in every locale
        bool usual = (*c >= '0' && *c <= '9') || *c == '-' || *c == '+' || *c == 'e';
        if (usual || !point)
            plain[length++] = usual ? *c : '.';
        point |= !usual;
    }
    text_add_part(text, plain, length);
}

void export_list(struct text *text, const char *word, const double *numbers, int count)
{
    text_add(text, word);
    for (int i = 0; i < count; i++) {
        text_add(text, " ");
        export_number(text, numbers[i]);
    }
}

void export_line(struct text *text, const char *word, const double *numbers, int count)
{
    export_list(text, word, numbers, count);
    text_add(text, "\n");
}

void export_word(struct text *text, uint32_t value)
{
    char bytes[4] = {(char)(value & 255), (char)(value >> 8 & 255), (char)(value >> 16 & 255), (char)(value >> 24)};
    text_add_part(text, bytes, 4);
}

void export_float(struct text *text, double x)
{
    float rounded = (float)(x + 0.0);
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    export_word(text, bits);
}

void export_floats(struct text *text, lam_vec3 p)
{
    export_float(text, p.x);
    export_float(text, p.y);
    export_float(text, p.z);
}
