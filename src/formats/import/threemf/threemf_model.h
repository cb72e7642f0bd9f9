// threemf_model.h: the state of a model part while it is parsed, and the functions that read its elements.
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
    IN_METALLIC_GROUP,
    IN_METALLIC,
    IN_SPECULAR_GROUP,
    IN_SPECULAR,
    IN_BEAM_LATTICE,
    IN_BEAMS,
    IN_BEAM,
    IN_BUILD,
    IN_ITEM,
    IN_COUNT
};

// The state while a model part is read.
struct model_reader {
    struct threemf *file;
    struct threemf_part *part;
    bool is_root;
    struct threemf_rows spaces; // namespaces declared by the model element (threemf_extensions.c)
    bool in_model;              // inside the model element
    // The current object.
    struct threemf_object *object;
    struct threemf_rows positions, indices, properties, components;
    bool has_properties;
    uint32_t triangle;             // number of triangles read, also those that are left out
    struct threemf_rows midpoints; // of the sides that paintings subdivide (threemf_paint.c)
    size_t midpoint_slots;
    // The current property group, or −1.
    int32_t group;
    uint32_t bases[LAYERS_MAX]; // composite materials: the indices of the mixed base materials
    int base_count;
    uint32_t display; // id of the display properties of the current base materials
    bool has_display;
    struct threemf_rows wishes, displays; // threemf_display.c
    struct threemf_rows text;
    const char **wanted_text; // receives the text of a metadata element
};

static inline struct model_reader *reader_of(struct threemf_xml *xml) { return xml->user; }

// Adds a resource with the id in these attributes. On failure, fills the error and returns NULL.
struct threemf_resource *model_add_resource(struct threemf_xml *xml, const char *const *attributes,
                                            enum resource_kind kind);

// model_resource returns a resource by its index; model_group returns the current property group.
struct threemf_resource *model_resource(struct threemf_part *part, int32_t index);
struct threemf_resource *model_group(struct model_reader *reader);
bool model_add_color(struct threemf *file, struct threemf_part *part, const float color[4]);
// Adds a triangle to the current object.
bool model_add_triangle(struct model_reader *reader, const uint32_t corners[3],
                        const struct threemf_property *property);
// Reads the next number of a list in an attribute. Returns false if the list has no further whole number below `limit`.
bool model_next_number(const char **at, uint32_t limit, uint32_t *out);
bool model_at_end(const char *at); // whether only spaces are left

// A base material that refers to an element of display properties.
struct display_wish {
    int material;
    uint32_t id, index;
};

// If the attributes of a base material or of its group refer to display properties, records that the material uses
// these properties.
bool model_want_display(struct threemf_xml *xml, const char *const *attributes, int material, uint32_t index);

// threemf_extensions.c: records a namespace, and checks the extensions that the model element requires.
void extensions_declare(struct threemf_xml *xml, const char *prefix, const char *uri);
bool extensions_check(struct threemf_xml *xml, const char *const *attributes);

// threemf_properties.c: reads the elements that define property groups.
threemf_begin_fn begin_base_materials, begin_base, begin_color_group, begin_color, begin_texture, begin_texcoord_group,
    begin_texcoord, begin_composites, begin_composite;
threemf_end_fn end_group;
// Parses an attribute "#RRGGBB" or "#RRGGBBAA" (sRGB) and converts it to linear numbers.
bool properties_take_color(struct threemf_xml *xml, const char *const *attributes, const char *name, float out[4]);
// threemf_layers.c: multiproperties.
threemf_begin_fn begin_multis, begin_multi;
threemf_end_fn end_multis;
// threemf_paint.c: adds the triangles into which a painting of filaments subdivides a triangle. `property` applies to
// unpainted ones. paint_finish cuts other triangles at the vertices that subdivisions place on their sides.
bool paint_triangle(struct model_reader *reader, const char *painting, const uint32_t corners[3],
                    const struct threemf_property *property);
bool paint_finish(struct model_reader *reader);
// threemf_display.c: display properties. display_finish applies these properties at the end of the part, because they
// may come after the materials in the file.
threemf_begin_fn begin_display, begin_metallic, begin_specular;
void display_finish(struct model_reader *reader);
// Reports a fault in the current property group, and returns true, because the load can continue. Adds a warning "FILE:
// PART:LINE: sentence" and marks the group as faulty.
bool properties_fault(struct threemf_xml *xml, const char *format, ...) __attribute__((format(printf, 2, 3)));
// Adds the first two colours of every part: white, and the colour of parts without a material.
bool properties_start(struct threemf *file, struct threemf_part *part);

#endif
