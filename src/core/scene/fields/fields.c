// fields.c: reads, sets and checks a field of a material or light by its row in the table of fields.
#include "fields.h"

#include "linear.h"

#include <stdio.h>
#include <string.h>

static const struct {
    int count;
    enum { FLOATS, DOUBLES, BOOL } kind;
    const char *parts[4]; // names of the members
} types[] = {
    [LAM_FIELD_NUMBER] = {1, FLOATS, {""}},
    [LAM_FIELD_ANGLE] = {1, FLOATS, {""}},
    [LAM_FIELD_FLAG] = {1, BOOL, {""}},
    [LAM_FIELD_RGB] = {3, FLOATS, {".r", ".g", ".b"}},
    [LAM_FIELD_RGBA] = {4, FLOATS, {".r", ".g", ".b", ".a"}},
    [LAM_FIELD_POINT] = {3, DOUBLES, {".x", ".y", ".z"}},
    [LAM_FIELD_DIRECTION] = {3, DOUBLES, {".x", ".y", ".z"}},
    [LAM_FIELD_TRIPLE] = {3, FLOATS, {".constant", ".linear", ".quadratic"}},
};

int lam_field_get(const lam_field *field, const void *object, double numbers[4])
{
    const void *at = (const char *)object + field->offset;
    int count = types[field->type].count;
    for (int i = 0; i < count; i++)
        switch (types[field->type].kind) {
        case FLOATS:
            numbers[i] = (double)((const float *)at)[i];
            break;
        case DOUBLES:
            numbers[i] = ((const double *)at)[i];
            break;
        case BOOL:
            numbers[i] = *(const bool *)at != (field->standard[0] != 0);
            break;
        }
    return count;
}

void lam_field_set(const lam_field *field, void *object, const double numbers[4])
{
    void *at = (char *)object + field->offset;
    for (int i = 0; i < types[field->type].count; i++)
        switch (types[field->type].kind) {
        case FLOATS:
            ((float *)at)[i] = (float)numbers[i];
            break;
        case DOUBLES:
            ((double *)at)[i] = numbers[i];
            break;
        case BOOL:
            *(bool *)at = (numbers[i] != 0) != (field->standard[0] != 0);
            break;
        }
}

int lam_field_get_written(const lam_field *field, const void *object, double numbers[4])
{
    int count = lam_field_get(field, object, numbers);
    if (field->type != LAM_FIELD_ANGLE)
        return count;
    const double exact = math_degrees(numbers[0]);
    double power = 1, decimal = exact;
    for (int decimals = 0; decimals <= 12; decimals++, power *= 10) {
        decimal = (double)(int64_t)(exact * power + 0.5) / power;
        if ((float)math_radians(decimal) == (float)numbers[0])
            break;
    }
    numbers[0] = decimal;
    return count;
}

void field_set_written(const lam_field *field, void *object, const double numbers[4])
{
    double radians[4] = {math_radians(numbers[0])};
    lam_field_set(field, object, field->type == LAM_FIELD_ANGLE ? radians : numbers);
}

void field_set_standard(const lam_field *field, void *object) { field_set_written(field, object, field->standard); }

bool field_equal(const lam_field *field, const void *a, const void *b)
{
    double of_a[4], of_b[4];
    size_t count = (size_t)lam_field_get(field, a, of_a);
    lam_field_get(field, b, of_b);
    return memcmp(of_a, of_b, count * sizeof *of_a) == 0;
}

bool field_is_zero(const lam_field *field, const void *object)
{
    double numbers[4] = {0};
    if (field->type == LAM_FIELD_FLAG)
        return !*(const bool *)((const char *)object + field->offset);
    lam_field_get(field, object, numbers);
    return numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0 && numbers[3] == 0;
}

bool field_is_standard(const lam_field *field, const void *object)
{
    double numbers[4];
    int count = lam_field_get_written(field, object, numbers);
    bool same = true;
    for (int i = 0; i < count; i++)
        same &= (float)numbers[i] == (float)field->standard[i];
    return same;
}

bool field_fits(const lam_field *field, const void *object, struct field_fault *fault)
{
    double numbers[4], min = field->min, max = field->max;
    int count = lam_field_get(field, object, numbers);
    const char *const *parts = types[field->type].parts;
    if (field->type == LAM_FIELD_ANGLE) {
        min = math_radians(min) - (min < 0 ? 1e-6 : 0);
        max = math_radians(max) + 1e-6; // π and π/2, rounded to float, may exceed the exact values by 1e-7
    }
    for (int i = 0; i < count; i++) {
        double highest = field->type == LAM_FIELD_RGBA && i == 3 ? 1 : max;
        if (math_finite(numbers[i]) && numbers[i] >= min && numbers[i] <= highest)
            continue;
        snprintf(fault->name, sizeof fault->name, "%s%s", field->name, parts[i]);
        fault->found = numbers[i];
        if (math_finite(highest))
            snprintf(fault->expected, sizeof fault->expected, "%g to %g", min, highest);
        else
            snprintf(fault->expected, sizeof fault->expected,
                     math_finite(min) ? "a finite number of %g or more" : "a finite number", min);
        return false;
    }
    const double *s = field->standard;
    if (field->type != LAM_FIELD_DIRECTION || numbers[0] != 0 || numbers[1] != 0 || numbers[2] != 0 ||
        (s[0] == 0 && s[1] == 0 && s[2] == 0))
        return true;
    *fault = (struct field_fault){.expected = "a vector that is not zero"};
    snprintf(fault->name, sizeof fault->name, "%s", field->name);
    return false;
}
