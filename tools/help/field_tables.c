// field_tables.c: prints the tables of material and light fields, as Markdown, for the man page, and for `help`.
#include "help_texts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lambent/light.h>
#include <lambent/material.h>

const char *field_standard(const lam_field *field, char text[80])
{
    static const int counts[] = {[LAM_FIELD_RGB] = 3,
                                 [LAM_FIELD_RGBA] = 4,
                                 [LAM_FIELD_POINT] = 3,
                                 [LAM_FIELD_DIRECTION] = 3,
                                 [LAM_FIELD_TRIPLE] = 3};
    const double *x = field->standard;
    bool zero = x[0] == 0 && x[1] == 0 && x[2] == 0;
    if (!field->light_types && field->offset == offsetof(lam_material, ambient)) // for a material in a scene file
        return strcpy(text, "diffuse");
    if (field->type == LAM_FIELD_DIRECTION && zero)
        return strcpy(text, "the scene's");
    if (field->type == LAM_FIELD_FLAG)
        return strcpy(text, x[0] != 0 ? "true" : "false");
    int used = snprintf(text, 80, "%g", (double)(float)x[0]);
    for (int i = 1; i < counts[field->type]; i++)
        used += snprintf(text + used, 80 - (size_t)used, ", %g", (double)(float)x[i]);
    return text;
}

// Returns the range as text.
static const char *field_range(const lam_field *field, char text[80])
{
    switch (field->type) {
    case LAM_FIELD_FLAG:
        return "yes or no";
    case LAM_FIELD_RGB:
        return "colour";
    case LAM_FIELD_RGBA:
        return "colour with optional alpha";
    case LAM_FIELD_POINT:
        return "point";
    case LAM_FIELD_DIRECTION:
        return "direction";
    default:
        break;
    }
    const char *count = field->type == LAM_FIELD_TRIPLE ? "three numbers, " : "",
               *unit = field->unit ? field->unit : "";
    int used = snprintf(text, 80, "%s%g", count, field->min);
    if (isfinite(field->max))
        snprintf(text + used, 80 - (size_t)used, " to %g%s%s", field->max, *unit ? " " : "", unit);
    else
        snprintf(text + used, 80 - (size_t)used, " or more%s%s", *unit ? " " : "", unit);
    return text;
}

static const char *types_of(const lam_field *field, char text[80])
{
    text[0] = 0;
    for (int i = 0; i <= LAM_LIGHT_SPOT; i++)
        if (field->light_types >> i & 1) {
            size_t used = strlen(text);
            snprintf(text + used, 80 - used, "%s%s", used ? ", " : "",
                     lam_light_type_describe((lam_light_type)i)->word);
        }
    return text;
}

static void markdown_rows(const lam_field *(*row)(int))
{
    for (int i = 0; row(i); i++) {
        const lam_field *field = row(i);
        char text[80];
        printf("| `%s` | %s", field->key, field_range(field, text));
        printf(" | %s", field_standard(field, text));
        printf(" | %s | %s |\n",
               field->light_types ? types_of(field, text)
               : field->source    ? field->source
                                  : "",
               field->summary);
    }
}

void field_tables_markdown(void)
{
    printf("\n## Fields of materials\n\nKeys of `--material` and of a scene file's materials.\n\n"
           "| key | value | default | MTL | |\n|---|---|---|---|---|\n");
    markdown_rows(lam_material_field);
    printf("\n## Fields of lights\n\nKeys of `--light` and of a scene file's lights, in addition to the keys in "
           "docs/scene-file.md.\n\n| key | value | default | lights | |\n|---|---|---|---|---|\n");
    markdown_rows(lam_light_field);
}

static void man_rows(const lam_field *(*row)(int))
{
    for (int i = 0; row(i); i++) {
        const lam_field *field = row(i);
        char text[80];
        printf(".TP\n\\fB%s\\fR (%s; default ", field->key, field_range(field, text));
        printf("%s", field_standard(field, text));
        if (field->light_types)
            printf("; %s", types_of(field, text));
        printf(")\n");
        for (const char *s = field->summary; *s; s++)
            printf(*s == '-' ? "\\-" : "%c", *s);
        printf("\n");
    }
}

void field_tables_man(void)
{
    printf(".SH \"FIELDS OF MATERIALS\"\n");
    man_rows(lam_material_field);
    printf(".SH \"FIELDS OF LIGHTS\"\n");
    man_rows(lam_light_field);
}

void field_tables_text(const lam_field *(*row)(int))
{
    for (int i = 0; row(i); i++) {
        const lam_field *field = row(i);
        char left[40], range[80], standard[80], types[80] = "", text[400];
        snprintf(left, sizeof left, "  %s", field->key);
        snprintf(text, sizeof text, "%s (%s) [%s]%s%s", field->summary, field_range(field, range),
                 field_standard(field, standard), field->light_types ? "; " : "",
                 field->light_types ? types_of(field, types) : "");
        help_row(left, HELP_COLUMN, HELP_WIDTH, text);
    }
}
