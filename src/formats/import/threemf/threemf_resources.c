// threemf_resources.c: finds the resources of a model part by their ids, and adds colours and triangles.
#include "threemf_model.h"

#ifdef HAVE_3MF

#include <stdio.h>
#include <string.h>

struct threemf_resource *model_resource(struct threemf_part *part, int32_t index)
{
    return (struct threemf_resource *)part->resources.items + index;
}

struct threemf_resource *model_group(struct model_reader *reader)
{
    return model_resource(reader->part, reader->group);
}

bool model_add_color(struct threemf *file, struct threemf_part *part, const float color[4])
{
    float *row = threemf_add(file, &part->colors, 4 * sizeof *row);
    if (row)
        memcpy(row, color, 4 * sizeof *row);
    return row != NULL;
}

bool model_add_triangle(struct model_reader *reader, const uint32_t corners[3], const struct threemf_property *property)
{
    struct threemf *file = reader->file;
    uint32_t *row = threemf_add(file, &reader->indices, 3 * sizeof *row);
    struct threemf_property *kept = row ? threemf_add(file, &reader->properties, sizeof *kept) : NULL;
    if (!kept ||
        !call_check_triangles(file->source->call, file->source->name, reader->indices.count, "triangles",
                              file->error) ||
        (reader->indices.count % 65536 == 0 && !call_should_continue(file->source->call) &&
         !call_error(file->source->call, file->error)))
        return false;
    memcpy(row, corners, 3 * sizeof *row);
    *kept = *property;
    reader->has_properties |= property->group != reader->object->group || property->index[0] != reader->object->index ||
                              property->index[1] != property->index[0] || property->index[2] != property->index[0];
    return true;
}

bool model_next_number(const char **at, uint32_t limit, uint32_t *out)
{
    uint64_t value = 0;
    const char *digits = *at + strspn(*at, " \t\r\n");
    const char *end = digits;
    while (*end >= '0' && *end <= '9' && value <= INT32_MAX)
        value = 10 * value + (uint64_t)(*end++ - '0');
    *at = end;
    *out = (uint32_t)value;
    return end > digits && value < limit && (!*end || strchr(" \t\r\n", *end));
}

bool model_at_end(const char *at) { return !at[strspn(at, " \t\r\n")]; }

struct threemf_resource *threemf_resource_at(const struct threemf_part *part, int32_t id)
{
    char name[16];
    snprintf(name, sizeof name, "%d", id);
    int32_t index = name_table_find(&part->ids, name);
    return index < 0 ? NULL : (struct threemf_resource *)part->resources.items + index;
}

struct threemf_resource *model_add_resource(struct threemf_xml *xml, const char *const *attributes,
                                            enum resource_kind kind)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_part *part = reader->part;
    uint32_t id;
    char name[16];
    if (!threemf_take_number(xml, attributes, "id", &id, NULL))
        return NULL;
    if (threemf_resource_at(part, (int32_t)id))
        return threemf_xml_fail(xml, "the id %u is used twice", id), NULL;
    snprintf(name, sizeof name, "%d", (int32_t)id);
    const char *copy = arena_string(reader->file->scratch, name);
    struct threemf_resource *resource = copy ? threemf_add(reader->file, &part->resources, sizeof *resource) : NULL;
    if (!resource || !name_table_add(&part->ids, copy, (int32_t)part->resources.count - 1))
        return threemf_no_memory(reader->file, sizeof *resource), NULL;
    *resource = (struct threemf_resource){.kind = kind, .material = -1, .base = -1};
    reader->group = (int32_t)part->resources.count - 1;
    return resource;
}

bool model_want_display(struct threemf_xml *xml, const char *const *attributes, int material, uint32_t index)
{
    struct model_reader *reader = reader_of(xml);
    uint32_t id;
    bool own;
    if (!threemf_take_number(xml, attributes, "displaypropertiesid", &id, &own))
        return false;
    struct display_wish *row =
        own || reader->has_display ? threemf_add(reader->file, &reader->wishes, sizeof *row) : NULL;
    if (row)
        *row = (struct display_wish){material, own ? id : reader->display, index};
    return row || (!own && !reader->has_display);
}

#endif
