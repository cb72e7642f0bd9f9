// threemf_xml.h: the elements of an XML part, given one by one to functions of a table.
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
    NS_UNKNOWN
};

struct threemf_xml;
typedef bool threemf_begin_fn(struct threemf_xml *xml, const char *const *attributes);
typedef bool threemf_end_fn(struct threemf_xml *xml);

// An element that is read where its parent is the element in row `parent` of the same table (−1: it is the root). Others are skipped with
// all that they contain.
struct threemf_element {
    enum threemf_namespace space;
    const char *name;
    int parent;
    threemf_begin_fn *begin; // NULL: nothing
    threemf_end_fn *end;     // NULL: nothing
};

struct threemf_xml {
    struct threemf *file;
    const char *part; // the name of the part, for messages
    const struct threemf_element *elements;
    int element_count;
    void *user;
    // A prefix of a name space is declared. NULL: nothing.
    void (*declare)(struct threemf_xml *xml, const char *prefix, const char *uri);
    struct threemf_rows *text; // the text of the current element is added to it; NULL: it is skipped
    struct xml_parser *parser; // of threemf_xml.c
};

// Opens expat. LAM_UNSUPPORTED: it is not installed.
bool threemf_xml_open(struct threemf *file);
void threemf_xml_close(struct threemf *file);

// Parses a part of the package.
bool threemf_xml_parse(struct threemf_xml *xml);

size_t threemf_xml_line(const struct threemf_xml *xml);
// "FILE: PART:LINE: sentence". Returns false.
bool threemf_xml_fail(struct threemf_xml *xml, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Returns the value of an attribute without a prefix, or NULL if the element has none of this name.
const char *threemf_attribute(const char *const *attributes, const char *name);
// The same of an attribute of a name space, while its element begins.
const char *threemf_attribute_of(const struct threemf_xml *xml, const char *const *attributes,
                                 enum threemf_namespace space, const char *name);
// A whole number from 0 to INT32_MAX. *found: the attribute is there. Without `found` it must be.
bool threemf_take_number(struct threemf_xml *xml, const char *const *attributes, const char *name, uint32_t *out,
                         bool *found);
// A finite number that must be there.
bool threemf_take_float(struct threemf_xml *xml, const char *const *attributes, const char *name, float *out);

#endif
