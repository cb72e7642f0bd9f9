// scene_schema.c: prints the JSON Schema of scene files: scene.schema.json.in with the fields of materials and lights
// inserted.
#include "help_texts.h"

#include <lambent/light.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "schema.inc"

static const char every_light[] =
    "        \"name\": {\"type\": \"string\", \"minLength\": 1},\n"
    "        \"frame\": {\n"
    "          \"enum\": [\"world\", \"camera\", \"view\", \"object\"],\n"
    "          \"default\": \"world\",\n"
    "          \"description\": \"The coordinate system of position, direction and up.\"\n"
    "        },\n"
    "        \"object\": {\"type\": \"string\", \"minLength\": 1, \"description\": "
    "\"The name of the object, if frame is object. Default: the "
    "first object.\"}";
static const char colored_light[] = "        \"color\": {\"$ref\": \"#/$defs/color3\", \"description\": \"color "
                                    "times intensity sets diffuse and specular. Default: "
                                    "1, 1, 1.\"},\n"
                                    "        \"intensity\": {\"type\": \"number\", \"minimum\": 0, \"default\": 1, "
                                    "\"description\": \"The factor of color.\"}";

static void print_field(const lam_field *field)
{
    char standard[80];
    field_standard(field, standard);
    printf("        \"%s\": {", field->key);
    switch (field->type) {
    case LAM_FIELD_NUMBER:
    case LAM_FIELD_ANGLE:
        printf("\"type\": \"number\", \"minimum\": %g, ", field->min);
        if (isfinite(field->max))
            printf("\"maximum\": %g, ", field->max);
        printf("\"default\": %s", standard);
        break;
    case LAM_FIELD_FLAG:
        printf("\"type\": \"boolean\", \"default\": %s", standard);
        break;
    case LAM_FIELD_RGB:
    case LAM_FIELD_RGBA:
        printf("\"$ref\": \"#/$defs/color%d\"", field->type == LAM_FIELD_RGB ? 3 : 4);
        break;
    case LAM_FIELD_DIRECTION:
        printf("\"$ref\": \"#/$defs/vector\"");
        break;
    case LAM_FIELD_POINT: // the fourth number is optional: w
        printf("\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": 3, \"maxItems\": 4");
        break;
    case LAM_FIELD_TRIPLE:
        printf(
            "\"type\": \"array\", \"items\": {\"type\": \"number\", \"minimum\": %g}, \"minItems\": 3, \"maxItems\": 3",
            field->min);
        break;
    }
    printf(", \"description\": \"%s. Default: %s.\"}", field->summary, standard);
}

static void print_fields(const char *name, size_t length)
{
    static const char *const types[] = {"ambient_light", "hemisphere", "point", "directional", "spot"};
    const lam_field *(*row)(int) = lam_material_field;
    int type = -1, count = 0;
    for (int i = 0; i <= LAM_LIGHT_SPOT; i++)
        if (strlen(types[i]) == length && memcmp(types[i], name, length) == 0) {
            row = lam_light_field;
            type = i;
        }
    for (int i = 0; row(i); i++) {
        if (type >= 0 && !(row(i)->light_types >> type & 1))
            continue;
        printf(count++ ? ",\n" : "");
        print_field(row(i));
    }
}

static void print_words(const lam_setting *setting)
{
    const char *word, *standard = "";
    int value;
    bool list = setting->type == LAM_SETTING_WORDS;
    printf("%s\"enum\": [", list ? "\"type\": \"array\", \"items\": {" : "");
    for (int i = 0; (word = setting->word(i, &value)); i++) {
        printf("%s\"%s\"", i ? ", " : "", word);
        if (value == 0 && !*standard)
            standard = word;
    }
    if (list)
        printf("]}, \"default\": []");
    else
        printf("], \"default\": \"%s\"", standard);
}

static void print_settings(void)
{
    for (int i = 0; lam_draw_setting(i); i++) {
        const lam_setting *setting = lam_draw_setting(i);
        printf("%s    \"%s\": {", i ? ",\n" : "", setting->key);
        switch (setting->type) {
        case LAM_SETTING_WORD:
        case LAM_SETTING_WORDS:
            print_words(setting);
            break;
        case LAM_SETTING_FLAG:
        case LAM_SETTING_NOT_FLAG:
            printf("\"type\": \"boolean\", \"default\": %s", setting->type == LAM_SETTING_FLAG ? "false" : "true");
            break;
        case LAM_SETTING_RGB:
        case LAM_SETTING_RGBA:
            printf("\"$ref\": \"#/$defs/color%d\"", setting->type == LAM_SETTING_RGB ? 3 : 4);
            break;
        case LAM_SETTING_WHOLE:
        case LAM_SETTING_NUMBER:
        case LAM_SETTING_ANGLE:
            printf("\"type\": \"%s\", \"minimum\": %.10g, \"maximum\": %.10g",
                   setting->type == LAM_SETTING_WHOLE ? "integer" : "number", setting->zero ? 0 : setting->min,
                   setting->max);
            if (setting->standard >= setting->min || setting->zero) // otherwise the default depends on the scene
                printf(", \"default\": %.3g", setting->standard);
            break;
        }
        printf(", \"description\": \"%s\"}", setting->summary);
    }
}

static bool is(const char *name, size_t length, const char *word)
{
    return strlen(word) == length && memcmp(name, word, length) == 0;
}

void generate_scene_schema(void)
{
    for (const char *line = text_scene_schema_json_in; *line;) {
        size_t length = strcspn(line, "\n"), indent = strspn(line, " ");
        const char *next = line + length + (line[length] != 0);
        if (line[indent] != '@') {
            printf("%.*s\n", (int)length, line);
            line = next;
            continue;
        }
        const char *name = line + indent + 1;
        size_t name_length = length - indent - 2;
        if (is(name, name_length, "every_light"))
            fputs(every_light, stdout);
        else if (is(name, name_length, "colored_light"))
            fputs(colored_light, stdout);
        else if (is(name, name_length, "settings"))
            print_settings();
        else
            print_fields(name, name_length);
        printf(next[strspn(next, " ")] == '}' ? "\n" : ",\n");
        line = next;
    }
}
