// export_numbers.c: writes the numbers in model files, and rotates vectors to the up axis of a format.
#include "export.h"

#include "linear.h"

#include <stdio.h>
#include <string.h>

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
