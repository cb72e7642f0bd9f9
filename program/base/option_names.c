// option_names.c: finds the option that sets a field of the library. The library's messages name fields, because
// programs that call the library have no options.
#include "option_names.h"

#include <stdbool.h>
#include <string.h>

#include <lambent/settings.h>

// Fields without a row in the library's table of settings.
static const struct {
    const char *field, *option;
} names[] = {
    {"lam_control.memory_limit_bytes", "--memory-limit"},
    {"lam_control.triangle_limit", "--triangle-limit"},
    {"lam_control.pixel_limit", "--pixel-limit"},
    {"lam_control.file_limit_bytes", "--file-limit"},
    {"lam_control.json_depth_limit", "--json-depth-limit"},
    {"lam_control.expansion_limit", "--expansion-limit"},
    {"lam_control.object_limit", "--object-limit"},
    {"lam_control.layer_limit", "--layer-limit"},
    {"lam_load_params.deflection", "--deflection"},
    {"lam_load_params.lenient", "--lenient"},
    {"lam_load_params.up", "--up"},
    {"lam_load_params.allowed_paths", "--allow-path FOLDER"},
    {"lam_load_params.models_anywhere", "--files-inside"},
    {"lam_draw_params.output", "--show"},
    {"lam_draw_params.exposure", "--exposure"},
    {"lam_draw_params.tone", "--tone"},
    {"lam_object.back_material", "--back-material"},
    {"lam_scene_set_environment", "--environment"},
    {"lam_scene_set_reflection_map", "--reflection-map"},
    {"lam_shader_params.style", "--style"},
    {"lam_shader_params.lights", "--lights-in"},
};

static bool begins(const char *text, const char *name) { return strncmp(text, name, strlen(name)) == 0; }

// Writes a setting's key as an option: "--" and the key with each _ replaced by -.
static size_t put_key(const char *key, char *out)
{
    size_t used = 2;
    out[0] = out[1] = '-';
    for (; *key; key++)
        out[used++] = *key == '_' ? '-' : *key;
    return used;
}

// Writes the option for the field at the start of `text`. Returns the length of the field, or 0 if the text does not
// begin with a field.
static size_t put_option(const char *text, char *out, size_t *used)
{
    static const char draw[] = "lam_draw_params.";
    size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_.");
    const lam_setting *setting;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (begins(text, names[i].field) && strlen(names[i].field) == length) {
            *used = strlen(names[i].option);
            memcpy(out, names[i].option, *used);
            return length;
        }
    for (int i = 0; begins(text, draw) && (setting = lam_draw_setting(i)); i++)
        if (begins(text + sizeof draw - 1, setting->member) && strlen(setting->member) + sizeof draw - 1 == length) {
            *used = put_key(setting->key, out);
            return length;
        }
    return 0;
}

const char *name_options(const char *text, char out[MESSAGE_SIZE])
{
    size_t at = 0;
    while (*text && at < MESSAGE_SIZE - 64) { // the longest option has fewer than 64 characters
        size_t used = 1, length = begins(text, "lam_") ? put_option(text, out + at, &used) : 0;
        if (!length)
            out[at] = *text;
        at += used;
        text += length ? length : 1;
    }
    out[at] = 0;
    return out;
}
