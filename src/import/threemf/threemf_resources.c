// threemf_resources.c: the resources of a model part, by their ids.
#include "threemf_model.h"

#ifdef HAVE_3MF

#include <stdio.h>

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
    if (threemf_resource_at(part, (int32_t)id)) {
        threemf_xml_fail(xml, "the id %u is used twice", id);
        return NULL;
    }
    snprintf(name, sizeof name, "%d", (int32_t)id);
    const char *copy = arena_string(reader->file->scratch, name);
    struct threemf_resource *resource = copy ? threemf_add(reader->file, &part->resources, sizeof *resource) : NULL;
    if (!resource || !name_table_add(&part->ids, copy, (int32_t)part->resources.count - 1)) {
        threemf_no_memory(reader->file, sizeof *resource);
        return NULL;
    }
    *resource = (struct threemf_resource){.kind = kind, .material = -1, .base = -1};
    reader->group = (int32_t)part->resources.count - 1;
    return resource;
}

#endif
