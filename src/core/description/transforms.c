// transforms.c: reads an object's transform in a scene file: steps, or a matrix.
#include "description.h"

#include "linear.h"

#include <string.h>

// Reads ["translate", x, y, z], ["rotate", degrees, x, y, z], ["scale", s] or ["scale", x, y, z].
static bool read_step(struct reader *r, const struct place *place, const json_t *step, lam_mat4 *out)
{
    static const char *const expected =
        "expected [\"translate\", x, y, z], [\"rotate\", degrees, x, y, z] or [\"scale\", x, y, z]";
    const json_t *word = json_is_array(step) ? json_array_get(step, 0) : NULL;
    const char *name = word && json_is_string(word) ? json_string_value(word) : "";
    double n[4] = {0};
    size_t count = json_is_array(step) && json_array_size(step) ? json_array_size(step) - 1 : 0;
    bool translate = strcmp(name, "translate") == 0 && count == 3, rotate = strcmp(name, "rotate") == 0 && count == 4;
    bool scale = strcmp(name, "scale") == 0 && (count == 3 || count == 1);
    char kind[JSON_KIND_SIZE], shown[SHOWN_NAME_SIZE];
    if (!translate && !rotate && !scale)
        return *name ? json_fail(&r->json, place, "found \"%s\" with %zu number%s, %s", shown_name(name, shown), count,
                                 count == 1 ? "" : "s", expected)
                     : json_fail(&r->json, place, "found %s, %s", json_kind(step, kind), expected);
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(step, i + 1);
        n[i] = json_number_value(value);
        if (!json_is_number(value) || n[i] < -1e30 || n[i] > 1e30)
            return json_fail(&r->json, ELEMENT_OF(place, i + 1), "found %s, expected a number", json_kind(value, kind));
    }
    if (translate) {
        *out = mat4_translate(n[0], n[1], n[2]);
    } else if (rotate) {
        if (n[1] == 0 && n[2] == 0 && n[3] == 0)
            return json_fail(&r->json, place, "the axis of the rotation is 0, 0, 0, expected a direction");
        if (n[0] < -360000 || n[0] > 360000)
            return json_fail(&r->json, ELEMENT_OF(place, 1), "found %.10g, expected degrees from -360000 to 360000",
                             n[0]);
        *out = mat4_rotate(math_radians(n[0]), v3(n[1], n[2], n[3]));
    } else {
        for (size_t i = count; i < 3; i++)
            n[i] = n[0];
        for (size_t i = 0; i < 3; i++)
            if (n[i] == 0)
                return json_fail(&r->json, place, "scales by 0, which leaves no surface to light");
        *out = mat4_scale(n[0], n[1], n[2]);
    }
    return true;
}

// Reads sixteen numbers, row by row: the fourth, eighth and twelfth are the translation.
static bool read_matrix(struct reader *r, const struct place *place, const json_t *value, lam_mat4 *out)
{
    double n[16];
    if (!json_numbers_of(&r->json, place, value, 16, 16, n, NULL))
        return false;
    if (n[12] != 0 || n[13] != 0 || n[14] != 0 || n[15] != 1)
        return json_fail(&r->json, place, "the matrix's last row is %.10g, %.10g, %.10g, %.10g, expected 0, 0, 0, 1",
                         n[12], n[13], n[14], n[15]);
    memcpy(out->m, n, sizeof out->m);
    return true;
}

bool read_transform(struct reader *r, const struct place *place, const json_t *value, lam_mat4 *out)
{
    *out = lam_mat4_identity();
    if (!json_is_array(value))
        return json_unexpected(&r->json, place, value, "a list of steps, or of 16 numbers");
    if (json_is_number(json_array_get(value, 0))) {
        if (!read_matrix(r, place, value, out))
            return false;
    } else {
        for (size_t i = 0; i < json_array_size(value); i++) {
            lam_mat4 step;
            if (!read_step(r, ELEMENT_OF(place, i), json_array_get(value, i), &step))
                return false;
            *out = mat4_mul(out, &step);
        }
    }
    double determinant = mat4_determinant3(out);
    if (!(determinant != 0) || !math_finite(determinant))
        return json_fail(&r->json, place,
                         "the transform cannot be inverted: it flattens the object, or its numbers are too large");
    return true;
}
