// threemf_slicer.c: reads the configurations that PrusaSlicer, Bambu Studio and OrcaSlicer store beside the model: the
// roles of volumes, their extruders, and the colours of filaments.
#include "threemf_xml.h"

#include "fail.h"
#include "json_parse.h"
#include "shown_name.h"
#include "texture_levels.h"

#ifdef HAVE_3MF

#include <lambent/material.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CONFIGURATION_BYTES = 16 << 20 };

// --- filaments

// Adds or replaces the material of a filament if the text contains a colour #RRGGBB. Translucent colours (#RRGGBBAA)
// become opaque, as the model would otherwise be hard to see.
static bool take_color(struct threemf *file, size_t index, const char *text, size_t length)
{
    char color[8] = "", name[32];
    const char *begin = memchr(text, '#', length);
    for (; file->filaments.count <= index; ((int *)file->filaments.items)[file->filaments.count - 1] = -1)
        if (!threemf_add(file, &file->filaments, sizeof(int)))
            return false;
    int *added = (int *)file->filaments.items + index;
    if (begin && (size_t)(text + length - begin) >= 7)
        memcpy(color, begin, 7);
    lam_material made = lam_material_default();
    if (strspn(color + !!*color, "0123456789abcdefABCDEF") != 6 ||
        !lam_color_parse(color, file->source->params->color, &made.diffuse, NULL)) {
        while (length && strchr(" \t\r\n\"", *text))
            text++, length--;
        while (length && strchr(" \t\r\n\"", text[length - 1]))
            length--;
        char shown[SHOWN_NAME_SIZE];
        const char *found = length ? arena_string_of(&file->scene->arena, text, length) : NULL;
        if (found)
            scene_warn(file->scene, "%s: found \"%s\" as the colour of filament %zu, expected #RRGGBB; it is ignored",
                       file->source->name, shown_name(found, shown), index + 1);
        return !length || found;
    }
    made.ambient = (lam_rgb){made.diffuse.r, made.diffuse.g, made.diffuse.b};
    snprintf(name, sizeof name, "filament %zu", index + 1);
    made.name = arena_string(&file->scene->arena, name);
    if (*added >= 0)
        ((lam_material *)file->scene->materials.items)[*added] = made;
    else
        *added = scene_adopt_material(file->scene, &made, file->error);
    return *added >= 0;
}

uint32_t threemf_filament(const struct threemf *file, uint32_t extruder)
{
    return extruder && extruder <= file->filaments.count ? extruder : file->filaments.count > 0;
}

int threemf_filament_material(const struct threemf *file, uint32_t filament)
{
    uint32_t number = threemf_filament(file, filament);
    return number ? ((const int *)file->filaments.items)[number - 1] : -1;
}

// PrusaSlicer: lines such as "; filament_colour = #FF8000;#DB5182". A valid extruder_colour replaces the filament's.
static bool read_prusa_settings(struct threemf *file, const char *part)
{
    static const char *const keys[] = {"; filament_colour = ", "; material_colour = ", "; extruder_colour = "};
    const uint8_t *bytes;
    size_t size;
    if (!threemf_package_read_whole(file, part, &bytes, &size))
        return false;
    const char *text = (const char *)bytes, *end = text + size;
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
        for (const char *line = text, *next; line < end; line = next) {
            size_t length = strlen(keys[k]), index = 0;
            next = memchr(line, '\n', (size_t)(end - line));
            next = next ? next + 1 : end;
            if ((size_t)(next - line) < length || memcmp(line, keys[k], length) != 0)
                continue;
            for (const char *at = line + length, *stop; at < next; at = stop + 1) {
                stop = memchr(at, ';', (size_t)(next - at));
                stop = stop ? stop : next;
                if (!take_color(file, index++, at, (size_t)(stop - at)))
                    return false;
            }
        }
    return true;
}

// Bambu Studio and OrcaSlicer: {"filament_colour": ["#FF8000", …], …}.
static bool read_project(struct threemf *file, const char *part)
{
    const uint8_t *bytes;
    size_t size;
    char name[2 * SHOWN_NAME_SIZE + 512], shown[SHOWN_NAME_SIZE];
    snprintf(name, sizeof name, "%s: %s", file->source->name, shown_name(part, shown));
    if (!threemf_package_read_whole(file, part, &bytes, &size))
        return false;
    json_t *root = json_parse((const char *)bytes, size, name, file->source->call, file->error);
    const json_t *list = json_object_get(root, "filament_colour");
    bool ok = root != NULL;
    for (size_t i = 0; ok && i < json_array_size(list); i++) {
        const char *color = json_string_value(json_array_get(list, i));
        color = color ? color : "a value that is no text";
        ok = take_color(file, i, color, strlen(color));
    }
    json_decref(root);
    return ok;
}

// --- volumes

enum { IN_CONFIG, IN_OBJECT, IN_VOLUME, IN_PART, OF_OBJECT, OF_VOLUME, OF_PART, ELEMENTS };

static bool add_volume(struct threemf_xml *xml, struct threemf_volume volume)
{
    struct threemf_volume *row = threemf_add(xml->file, &xml->file->volumes, sizeof *row);
    if (row)
        *row = volume;
    return row != NULL;
}

static bool take_role(struct threemf_xml *xml, const char *text, enum threemf_role *out)
{
    static const struct {
        const char *prusa, *bambu;
    } names[] = {[ROLE_PRINTS] = {"ModelPart", "normal_part"},
                 [MODIFIER] = {"ParameterModifier", "modifier_part"},
                 [SUPPORT_ENFORCER] = {"SupportEnforcer", "support_enforcer"},
                 [SUPPORT_BLOCKER] = {"SupportBlocker", "support_blocker"},
                 [NEGATIVE] = {"NegativeVolume", "negative_part"}};
    char shown[SHOWN_NAME_SIZE];
    for (size_t i = 0; text && i < sizeof names / sizeof *names; i++)
        if (strcmp(text, names[i].prusa) == 0 || strcmp(text, names[i].bambu) == 0) {
            *out = (enum threemf_role)i;
            return true;
        }
    if (text)
        scene_warn(xml->file->scene, "%s: %s:%zu: found a volume of the unknown kind \"%s\", drawn as one that prints",
                   xml->file->source->name, xml->part, threemf_xml_line(xml), shown_name(text, shown));
    return true;
}

static bool begin_object(struct threemf_xml *xml, const char *const *attributes)
{
    uint32_t id;
    *(size_t *)xml->user = xml->file->volumes.count;
    return threemf_take_number(xml, attributes, "id", &id, NULL) &&
           add_volume(xml, (struct threemf_volume){.object = (int32_t)id, .part = WHOLE_OBJECT});
}

static const struct threemf_volume *current_object(const struct threemf_xml *xml)
{
    return (const struct threemf_volume *)xml->file->volumes.items + *(const size_t *)xml->user;
}

static bool begin_volume(struct threemf_xml *xml, const char *const *attributes)
{
    struct threemf_volume row = {.object = current_object(xml)->object, .part = TRIANGLE_RANGE};
    return threemf_take_number(xml, attributes, "firstid", &row.first, NULL) &&
           threemf_take_number(xml, attributes, "lastid", &row.last, NULL) && add_volume(xml, row);
}

static bool begin_part(struct threemf_xml *xml, const char *const *attributes)
{
    struct threemf_volume row = {.object = current_object(xml)->object};
    uint32_t id;
    if (!threemf_take_number(xml, attributes, "id", &id, NULL) ||
        !take_role(xml, threemf_attribute(attributes, "subtype"), &row.role))
        return false;
    row.part = (int32_t)id;
    return add_volume(xml, row);
}

static bool take_setting(struct threemf_xml *xml, const char *const *attributes, struct threemf_volume *row)
{
    const char *key = threemf_attribute(attributes, "key"), *value = threemf_attribute(attributes, "value");
    if (key && value && strcmp(key, "extruder") == 0)
        return threemf_take_number(xml, attributes, "value", &row->extruder, NULL);
    if (key && value && strcmp(key, "volume_type") == 0)
        return take_role(xml, value, &row->role);
    if (key && value && strcmp(key, "modifier") == 0 && strcmp(value, "1") == 0) // of Slic3r before volume_type
        row->role = MODIFIER;
    return true;
}

static bool begin_object_setting(struct threemf_xml *xml, const char *const *attributes)
{
    return take_setting(xml, attributes, (struct threemf_volume *)current_object(xml));
}

static bool begin_volume_setting(struct threemf_xml *xml, const char *const *attributes)
{
    struct threemf_volume *rows = xml->file->volumes.items;
    return take_setting(xml, attributes, rows + xml->file->volumes.count - 1);
}

static bool read_volumes(struct threemf *file, const char *part)
{
    static const struct threemf_element elements[ELEMENTS] = {
        [IN_CONFIG] = {NS_NONE, "config", -1, NULL, NULL},
        [IN_OBJECT] = {NS_NONE, "object", IN_CONFIG, begin_object, NULL},
        [IN_VOLUME] = {NS_NONE, "volume", IN_OBJECT, begin_volume, NULL},
        [IN_PART] = {NS_NONE, "part", IN_OBJECT, begin_part, NULL},
        [OF_OBJECT] = {NS_NONE, "metadata", IN_OBJECT, begin_object_setting, NULL},
        [OF_VOLUME] = {NS_NONE, "metadata", IN_VOLUME, begin_volume_setting, NULL},
        [OF_PART] = {NS_NONE, "metadata", IN_PART, begin_volume_setting, NULL},
    };
    size_t object = 0;
    struct threemf_xml xml = {
        .file = file, .part = part, .elements = elements, .element_count = ELEMENTS, .user = &object};
    return threemf_xml_parse(&xml);
}

static int by_place(const void *a, const void *b)
{
    const struct threemf_volume *x = a, *y = b;
    const int64_t differences[] = {(int64_t)x->object - y->object,      (int64_t)x->part - y->part,
                                   (int64_t)x->first - y->first,        (int64_t)x->last - y->last,
                                   (int64_t)x->role - (int64_t)y->role, (int64_t)x->extruder - y->extruder};
    for (size_t i = 0; i < sizeof differences / sizeof *differences; i++)
        if (differences[i])
            return differences[i] < 0 ? -1 : 1;
    return 0;
}

const struct threemf_volume *threemf_volume_at(const struct threemf *file, const struct threemf_part *from,
                                               int32_t object, int32_t part, uint32_t triangle)
{
    const struct threemf_volume *rows = file->volumes.items, wanted = {object, part, triangle, UINT32_MAX, ROLES, 0};
    size_t low = 0, high = from == *(struct threemf_part **)file->parts.items ? file->volumes.count : 0;
    while (low < high) { // the last row that begins at this triangle or before it
        size_t middle = low + (high - low) / 2;
        if (by_place(&rows[middle], &wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    const struct threemf_volume *row = low ? &rows[low - 1] : NULL;
    bool found = row && row->object == object && row->part == part;
    return found && (part != TRIANGLE_RANGE || triangle <= row->last) ? row : NULL;
}

// --- all configurations

bool threemf_slicer_read(struct threemf *file)
{
    static const struct {
        const char *part;
        bool (*read)(struct threemf *file, const char *part);
    } parts[] = {{"Metadata/Slic3r_PE.config", read_prusa_settings},
                 {"Metadata/Slic3r_PE_model.config", read_volumes},
                 {"Metadata/project_settings.config", read_project},
                 {"Metadata/model_settings.config", read_volumes}};
    lam_error *error = file->error;
    file->part_limit = CONFIGURATION_BYTES;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const char *part = threemf_package_find(file, parts[i].part);
        lam_error reason = {0};
        file->error = &reason;
        bool ok = !part || parts[i].read(file, part);
        file->error = error;
        if (!ok && !call_should_continue(file->source->call))
            return call_error(file->source->call, error);
        if (!ok)
            scene_warn(file->scene, "%s; drawn without the rest of this part", reason.text);
    }
    file->part_limit = 0;
    if (file->volumes.count)
        qsort(file->volumes.items, file->volumes.count, sizeof(struct threemf_volume), by_place);
    const struct threemf_volume *rows = file->volumes.items;
    for (size_t i = 0; i < file->volumes.count; i++)
        file->uncolored |= !file->filaments.count && rows[i].extruder > 1;
    return true;
}

#endif
