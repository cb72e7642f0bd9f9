// material_option.c: parses the values of --material and --back-material, and warns about coefficients above 1.
#include "material_option.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include <lambent/fields.h>
#include <lambent/words.h>

#include "console.h"

bool material_option_parse(const char *text, lam_color_mode mode, struct material_option *option, lam_error *error)
{
    *option = (struct material_option){.mode = mode};
    if (strlen(text) >= sizeof option->text)
        return complain(error, LAM_BAD_ARGUMENT, "it is %zu letters long, expected less than %zu", strlen(text),
                        sizeof option->text);
    strcpy(option->text, text);
    char *at = strchr(option->text, '@');
    if (at) {
        *at++ = 0;
        option->target = at;
        if (!*at)
            return complain(error, LAM_BAD_ARGUMENT,
                            "found nothing after '@', expected the name of an object, part or material");
    }
    lam_material unused = lam_material_default();
    if (!lam_material_parse(option->text, mode, &unused, error))
        return false;
    char first[sizeof option->text];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(option->text, ","), option->text);
    option->named = lam_material_find(first) != LAM_MATERIAL_COUNT || strcasecmp(first, "glass") == 0;
    return true;
}

lam_material material_option_apply(const struct material_option *option, lam_material material)
{
    if (option->named)
        material = lam_material_default();
    // lam_material_parse cannot fail, because material_option_parse has checked the text.
    lam_material_parse(option->text, option->mode, &material, NULL);
    return material;
}

// Returns whether a field is a colour whose channels are fractions of reflected light. Of the colours, only such fields
// have a symbol.
static bool is_fraction(const lam_field *field)
{
    return (field->type == LAM_FIELD_RGB || field->type == LAM_FIELD_RGBA) && field->symbol;
}

const char *color_advice(const double rgb[3], char text[COLOR_ADVICE_SIZE])
{
    unsigned bytes[3];
    bool fits = rgb[0] >= 16 || rgb[1] >= 16 || rgb[2] >= 16; // smaller numbers are probably not bytes
    for (int i = 0; i < 3 && fits; i++) {
        fits = rgb[i] >= 0 && rgb[i] <= 255;
        bytes[i] = fits ? (unsigned)rgb[i] : 0;
        fits = fits && rgb[i] == bytes[i];
    }
    text[0] = 0;
    if (fits)
        snprintf(text, COLOR_ADVICE_SIZE, "; for 0 to 255 write #%02x%02x%02x", bytes[0], bytes[1], bytes[2]);
    return text;
}

// Adds at most `limit` warnings about coefficients above 1 and returns the number of such coefficients.
static int warn(const lam_material *material, const char *subject, int limit, lam_scene *scene)
{
    int over = 0;
    for (int i = 0; lam_material_field(i); i++) {
        double color[4];
        if (!is_fraction(lam_material_field(i)))
            continue;
        lam_field_get(lam_material_field(i), material, color);
        double largest = color[0] > color[1] ? color[0] : color[1];
        largest = largest > color[2] ? largest : color[2];
        if (!(largest > 1) || ++over > limit)
            continue;
        char text[240], advice[COLOR_ADVICE_SIZE];
        snprintf(text, sizeof text, "%s: %s is %g, which reflects more light than it receives (above 1)%s", subject,
                 lam_material_field(i)->key, largest, color_advice(color, advice));
        lam_scene_add_warning(scene, text);
    }
    return over;
}

// Applies the option to a white material, so that a factor above 1 leads to a coefficient above 1.
void material_option_warn(const struct material_option *option, const char *name, lam_scene *scene)
{
    static const double white[4] = {1, 1, 1, 1};
    lam_material material = lam_material_default();
    for (int i = 0; lam_material_field(i); i++)
        if (is_fraction(lam_material_field(i)))
            lam_field_set(lam_material_field(i), &material, white);
    material = material_option_apply(option, material);
    char subject[40];
    snprintf(subject, sizeof subject, "option '--%s'", name);
    warn(&material, subject, LAM_FIELDS_MAX, scene);
}

void materials_warn(lam_scene *scene)
{
    enum { REPORTED = 3 };
    int over = 0;
    // For glTF files, Lambent derives the highlight values itself, so that rough surfaces conserve energy. These values
    // need no warning.
    if (strcmp(lam_scene_format(scene), "gltf") == 0)
        return;
    for (int i = 0; i < lam_scene_material_count(scene); i++) {
        lam_material material = *lam_scene_material(scene, i);
        char subject[80];
        snprintf(subject, sizeof subject, "material '%.60s'", material.name ? material.name : "unnamed");
        over += warn(&material, subject, over < REPORTED ? REPORTED - over : 0, scene);
    }
    if (over > REPORTED) {
        char text[100];
        snprintf(text, sizeof text, "%d more coefficients of materials are above 1", over - REPORTED);
        lam_scene_add_warning(scene, text);
    }
}
