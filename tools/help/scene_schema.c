// scene_schema.c: prints the JSON Schema of scene files: scene.schema.json.in with the fields of materials and lights
// inserted.
#include "help_texts.h"

#include <lambent/light.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lambent/words.h>

#include "schema.inc"

// The type of a length, which may be a text with a unit: "2r".
#define LENGTH "\"type\": [\"number\", \"string\"], \"pattern\": \"^[-+]?[0-9.]+r$\""

static void print_field(const lam_field *field)
{
    char standard[80];
    bool is_length = field->light_types && field->unit && strstr(field->unit, "units");
    field_standard(field, standard);
    switch (field->type) {
    case LAM_FIELD_NUMBER:
    case LAM_FIELD_ANGLE:
        printf("%s, \"minimum\": %g, ", is_length ? LENGTH : "\"type\": \"number\"", field->min);
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
        printf("\"type\": \"array\", \"items\": {" LENGTH "}, \"minItems\": 3, \"maxItems\": 4");
        break;
    case LAM_FIELD_TRIPLE:
        printf("\"type\": \"array\", \"items\": {" LENGTH ", \"minimum\": %g}, \"minItems\": "
               "3, \"maxItems\": 3",
               field->min);
        break;
    }
    printf(", \"description\": \"%s. Default: %s.\"", field->summary, standard);
}

// Prints a key of a material (`type` −1) or of a light of a type.
static void print_key(const char *key, int type)
{
    const lam_field *(*row)(int) = type < 0 ? lam_material_field : lam_light_field;
    printf("        \"%s\": {", key);
    for (int i = 0; row(i); i++)
        if (strcmp(row(i)->key, key) == 0 && (type < 0 || row(i)->light_types >> type & 1)) {
            print_field(row(i));
            printf("}");
            return;
        }
    // scene.schema.json.in describes the keys that are not fields, and the factors of colours.
    bool factor = type < 0 && strlen(key) == 2;
    printf("\"$ref\": \"#/$defs/key_%s\"}", factor ? "factor" : key);
}

static void print_material(void)
{
    for (int i = 0; lam_material_key(i); i++) {
        printf(i ? ",\n" : "");
        print_key(lam_material_key(i), -1);
    }
}

static void print_lights(void)
{
    for (int type = 0; type < LAM_LIGHT_TYPE_COUNT; type++) {
        const lam_light_type_info *about = lam_light_type_describe((lam_light_type)type);
        printf("%s    \"%s_light\": {\n      \"type\": \"object\",\n      \"required\": [\"type\"],\n      ",
               type ? ",\n" : "", about->word);
        printf("\"additionalProperties\": false,\n      \"description\": \"A light %s.\",\n      ", about->summary);
        printf("\"properties\": {\n        \"type\": {\"const\": \"%s\"}", about->word);
        for (int i = 0; lam_light_key((lam_light_type)type, i); i++) {
            printf(",\n");
            print_key(lam_light_key((lam_light_type)type, i), type);
        }
        printf("\n      }\n    }");
    }
}

static void print_light_refs(void)
{
    for (int type = 0; type < LAM_LIGHT_TYPE_COUNT; type++)
        printf("%s          {\"$ref\": \"#/$defs/%s_light\"}", type ? ",\n" : "",
               lam_light_type_describe((lam_light_type)type)->word);
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

void generate_scene_schema(void)
{
    static const struct {
        const char *name;
        void (*print)(void);
    } parts[] = {{"settings", print_settings},
                 {"material", print_material},
                 {"lights", print_lights},
                 {"light_refs", print_light_refs}};
    for (const char *line = text_scene_schema_json_in; *line;) {
        size_t length = strcspn(line, "\n"), indent = strspn(line, " ");
        const char *next = line + length + (line[length] != 0), *after = next + strspn(next, " ");
        if (line[indent] != '@')
            printf("%.*s\n", (int)length, line);
        for (size_t i = 0; line[indent] == '@' && i < sizeof parts / sizeof *parts; i++)
            if (strlen(parts[i].name) == length - indent - 2 &&
                strncmp(parts[i].name, line + indent + 1, length - indent - 2) == 0) {
                parts[i].print();
                printf(*after == '}' || *after == ']' ? "\n" : ",\n");
            }
        line = next;
    }
}
