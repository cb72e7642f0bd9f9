// threemf_xml.h: calls the functions of a table for the elements of an XML part.
#ifndef THREEMF_XML_H
#define THREEMF_XML_H

#include "threemf.h"

enum threemf_namespace {
    NS_NONE,
    NS_CORE,
    NS_MATERIALS,
    NS_PRODUCTION,
    NS_RELATIONSHIPS,
    NS_BEAMS,
    NS_SLICES,
    NS_SLIC3R,
    NS_UNKNOWN
};

struct threemf_xml;
typedef bool threemf_begin_fn(struct threemf_xml *xml, const char *const *attributes);
typedef bool threemf_end_fn(struct threemf_xml *xml);

// A row of the table of elements that the parser reads. `parent` is the row of the element's parent, or −1 for the root
// element. All other elements are skipped, including their content.
struct threemf_element {
    enum threemf_namespace space;
    const char *name;
    int parent;
    threemf_begin_fn *begin; // NULL means no action
    threemf_end_fn *end;     // NULL means no action
};

struct threemf_xml {
    struct threemf *file;
    const char *part; // name of the part, for messages
    const struct threemf_element *elements;
    int element_count;
    void *user;
    // Called for each declared namespace prefix. NULL if not needed.
    void (*declare)(struct threemf_xml *xml, const char *prefix, const char *uri);
    struct threemf_rows *text; // receives the text of the current element; NULL if the text is skipped
    struct xml_parser *parser; // the parser of threemf_xml.c
};

// Loads expat. Fails with LAM_UNSUPPORTED if expat is not installed.
bool threemf_xml_open(struct threemf *file);
void threemf_xml_close(struct threemf *file);

// Parses a part of the package.
bool threemf_xml_parse(struct threemf_xml *xml);

size_t threemf_xml_line(const struct threemf_xml *xml);
// Fails with "FILE: PART:LINE: sentence". Returns false.
bool threemf_xml_fail(struct threemf_xml *xml, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Returns the value of an attribute without a prefix, or NULL if the element does not have this attribute.
const char *threemf_attribute(const char *const *attributes, const char *name);
// Returns the value of an attribute in a namespace. Call this only at the start of the attribute's element.
const char *threemf_attribute_of(const struct threemf_xml *xml, const char *const *attributes,
                                 enum threemf_namespace space, const char *name);
// Parses an attribute that is a whole number of at most INT32_MAX. Sets *found to true if the attribute exists,
// otherwise to false. If `found` is NULL, the attribute is required.
bool threemf_take_number(struct threemf_xml *xml, const char *const *attributes, const char *name, uint32_t *out,
                         bool *found);
// Parses a required attribute that is a number, possibly one that is not finite.
bool threemf_take_float(struct threemf_xml *xml, const char *const *attributes, const char *name, float *out);

#endif
