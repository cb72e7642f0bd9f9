// threemf_model.h: the elements of a model part while it is parsed.
#ifndef THREEMF_MODEL_H
#define THREEMF_MODEL_H

#include "threemf_xml.h"

// The rows of the table in threemf_model.c.
enum threemf_row {
    IN_MODEL,
    IN_METADATA,
    IN_RESOURCES,
    IN_OBJECT,
    IN_MESH,
    IN_VERTICES,
    IN_VERTEX,
    IN_TRIANGLES,
    IN_TRIANGLE,
    IN_COMPONENTS,
    IN_COMPONENT,
    IN_BASE_MATERIALS,
    IN_BASE,
    IN_COLOR_GROUP,
    IN_COLOR,
    IN_TEXTURE,
    IN_TEXCOORD_GROUP,
    IN_TEXCOORD,
    IN_COMPOSITES,
    IN_COMPOSITE,
    IN_MULTIS,
    IN_MULTI,
    IN_CORE_MULTI,
    IN_BUILD,
    IN_ITEM,
    IN_COUNT
};

// The state of reading a model part.
struct model_reader {
    struct threemf *file;
    struct threemf_part *part;
    bool is_root;
    struct threemf_rows spaces; // the name spaces that the model element declares (threemf_extensions.c)
    bool in_model;              // the model element is open
    // The object that is open.
    struct threemf_object *object;
    struct threemf_rows positions, indices, properties, components;
    bool has_properties;
    // The group of properties that is open; −1: none.
    int32_t group;
    uint32_t bases[LAYERS_MAX]; // composite materials: the indices of the base materials that they mix
    int base_count;
    struct threemf_rows text;
    const char **wanted_text; // where the text of a metadata element goes
};

static inline struct model_reader *reader_of(struct threemf_xml *xml) { return xml->user; }

// Adds a resource with the id of these attributes. NULL: the error says why not.
struct threemf_resource *model_add_resource(struct threemf_xml *xml, const char *const *attributes,
                                            enum resource_kind kind);

// threemf_extensions.c: keeps a name space; checks the extensions that the model element requires.
void extensions_declare(struct threemf_xml *xml, const char *prefix, const char *uri);
bool extensions_check(struct threemf_xml *xml, const char *const *attributes);

// threemf_properties.c: the elements of groups of properties.
threemf_begin_fn begin_base_materials, begin_base, begin_color_group, begin_color, begin_texture, begin_texcoord_group,
    begin_texcoord, begin_composites, begin_composite, begin_multis, begin_multi;
threemf_end_fn end_group;
// A fault of properties does not stop the load: a warning "FILE: PART:LINE: sentence", and the open group is faulty. Returns true.
bool properties_fault(struct threemf_xml *xml, const char *format, ...) __attribute__((format(printf, 2, 3)));
// White and the colour of parts without a material, which a part's colours begin with.
bool properties_start(struct threemf *file, struct threemf_part *part);

#endif
