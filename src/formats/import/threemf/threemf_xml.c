// threemf_xml.c: parses XML parts with expat, which is loaded on demand.
//
// Limits: an element may be at most TOKEN_BYTES long, and elements may be nested at most DEPTH_MAX deep. Document types
// are rejected, because 3MF forbids them and their entities can expand to any size. Memory that expat allocates counts
// towards the call's memory limit.
#include "threemf_xml.h"

#include "fail.h"
#include "number.h"
#include "shown_name.h"

#ifdef HAVE_3MF

#include "dynamic_library.h"

#include <expat.h>
#include <float.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LIBRARY "libexpat.so.1"

#define FUNCTIONS(each)                                                                                                \
    each(XML_ParserCreate_MM) each(XML_ParserFree) each(XML_SetUserData) each(XML_SetElementHandler)                   \
        each(XML_SetCharacterDataHandler) each(XML_SetStartDoctypeDeclHandler) each(XML_Parse) each(XML_StopParser)    \
            each(XML_GetErrorCode) each(XML_ErrorString) each(XML_GetCurrentLineNumber) each(XML_GetCurrentByteIndex)

struct expat_library {
    void *handle;
    FUNCTIONS(LIBRARY_MEMBER)
    // NULL before expat 2.6. Newer versions otherwise wait for more bytes before they scan an incomplete element again, so
    // that check_token would find elements too long.
    XML_Bool (*set_deferral)(XML_Parser parser, XML_Bool enabled);
};

enum { DEPTH_MAX = 256, TOKEN_BYTES = 1 << 20, SPACES_MAX = 256 };
enum { AT_ROOT = -1, SKIPPED = -2 };

// A namespace prefix, which is valid inside the element that declares it.
struct declaration {
    size_t prefix; // the position of the prefix in xml_parser.prefixes; "" applies to names without a prefix
    enum threemf_namespace space;
    int depth;
};

struct xml_parser {
    XML_Parser expat;
    const struct expat_library *library;
    uint64_t given; // bytes given to expat so far
    int depth;
    int rows[DEPTH_MAX + 1];                      // the row in the table of each open element; rows[0] is AT_ROOT
    bool failed;                                  // the error has been filled in
    enum threemf_namespace spaces[DEPTH_MAX + 1]; // the namespaces of the open elements
    struct threemf_rows declarations, prefixes;   // struct declaration, char
};

static const char *const uris[] = {
    [NS_NONE] = "",
    [NS_CORE] = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
    [NS_MATERIALS] = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    [NS_PRODUCTION] = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    [NS_RELATIONSHIPS] = "http://schemas.openxmlformats.org/package/2006/relationships",
    [NS_BEAMS] = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02",
    [NS_SLICES] = "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07",
    [NS_SLIC3R] = "http://schemas.slic3r.org/3mf/2017/06",
};

// --- expat's memory counts towards the memory limit of the parsing thread's call

static __thread struct call_control *parsing_call;

// Each block begins with its size, padded so that the memory after it is aligned.
enum { BLOCK_HEAD = 16 };

static void *resize_block(void *old, size_t size)
{
    char *block = old ? (char *)old - BLOCK_HEAD : NULL;
    size_t had = 0;
    if (block)
        memcpy(&had, block, sizeof had);
    if (size > SIZE_MAX / 2 || !call_charge(parsing_call, size))
        return NULL;
    char *moved = realloc(block, size + BLOCK_HEAD);
    call_refund(parsing_call, moved ? had : size);
    if (!moved)
        return NULL;
    memcpy(moved, &size, sizeof size);
    return moved + BLOCK_HEAD;
}

static void *make_block(size_t size) { return resize_block(NULL, size); }

static void free_block(void *old)
{
    size_t had;
    if (!old)
        return;
    memcpy(&had, (char *)old - BLOCK_HEAD, sizeof had);
    call_refund(parsing_call, had);
    free((char *)old - BLOCK_HEAD);
}

// --- errors

size_t threemf_xml_line(const struct threemf_xml *xml)
{
    return (size_t)xml->parser->library->XML_GetCurrentLineNumber(xml->parser->expat);
}

static void stop(struct threemf_xml *xml)
{
    xml->parser->failed = true;
    xml->parser->library->XML_StopParser(xml->parser->expat, XML_FALSE);
}

bool threemf_xml_fail(struct threemf_xml *xml, const char *format, ...)
{
    char sentence[400], shown[SHOWN_NAME_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    return fail(xml->file->error, LAM_CANNOT_READ, "%s: %s:%zu: %s", xml->file->source->name,
                shown_name(xml->part, shown), threemf_xml_line(xml), sentence);
}

// --- name spaces
//
// This file resolves prefixes itself, because expat rejects undeclared prefixes, which occur in samples of the 3MF
// consortium.

static enum threemf_namespace space_of_uri(const char *uri)
{
    for (int i = NS_CORE; i < NS_UNKNOWN; i++)
        if (strcmp(uris[i], uri) == 0)
            return (enum threemf_namespace)i;
    return NS_UNKNOWN;
}

static bool declare(struct threemf_xml *xml, const char *prefix, const char *uri)
{
    struct xml_parser *parser = xml->parser;
    size_t length = strlen(prefix) + 1, begin = parser->prefixes.count;
    if (parser->declarations.count == SPACES_MAX)
        return threemf_xml_fail(xml, "found more than %d namespaces", SPACES_MAX);
    struct declaration *row = threemf_add(xml->file, &parser->declarations, sizeof *row);
    if (!row || !threemf_reserve(xml->file, &parser->prefixes, 1, begin + length))
        return false;
    memcpy((char *)parser->prefixes.items + begin, prefix, length);
    parser->prefixes.count += length;
    *row = (struct declaration){begin, *uri ? space_of_uri(uri) : NS_NONE, parser->depth + 1};
    if (xml->declare)
        xml->declare(xml, prefix, uri);
    return true;
}

// Finds the namespace of the name of an element or attribute. Returns false if the prefix is not declared.
static bool find_space(const struct xml_parser *parser, const char *name, enum threemf_namespace *out)
{
    const char *colon = strchr(name, ':');
    size_t length = colon ? (size_t)(colon - name) : 0;
    const struct declaration *rows = parser->declarations.items;
    for (size_t i = parser->declarations.count; i-- > 0;) {
        const char *prefix = (const char *)parser->prefixes.items + rows[i].prefix;
        if (strncmp(prefix, name, length) == 0 && !prefix[length]) {
            *out = rows[i].space;
            return true;
        }
    }
    *out = colon ? NS_UNKNOWN : NS_NONE;
    return !colon || (length == 3 && memcmp(name, "xml", 3) == 0);
}

static bool refuse_prefix(struct threemf_xml *xml, const char *name)
{
    char shown[SHOWN_NAME_SIZE];
    return threemf_xml_fail(xml, "found the name %s, whose prefix is not declared (lam_load_params.lenient reads on)",
                            shown_name(name, shown));
}

// Reads the declarations of an element and finds its namespace. An undeclared prefix is an error. With
// lam_load_params.lenient, an element with an undeclared prefix is in the namespace of its parent.
static bool take_spaces(struct threemf_xml *xml, const char *name, const char *const *attributes,
                        enum threemf_namespace *out)
{
    struct xml_parser *parser = xml->parser;
    bool lenient = xml->file->source->params->lenient;
    enum threemf_namespace unused;
    for (int i = 0; attributes[i]; i += 2)
        if (strncmp(attributes[i], "xmlns", 5) == 0 && (!attributes[i][5] || attributes[i][5] == ':') &&
            !declare(xml, attributes[i] + 5 + (attributes[i][5] == ':'), attributes[i + 1]))
            return false;
    for (int i = 0; attributes[i] && !lenient; i += 2)
        if (strchr(attributes[i], ':') && strncmp(attributes[i], "xmlns:", 6) != 0 &&
            !find_space(parser, attributes[i], &unused))
            return refuse_prefix(xml, attributes[i]);
    if (find_space(parser, name, out))
        return true;
    *out = parser->spaces[parser->depth];
    return lenient || refuse_prefix(xml, name);
}

// --- elements

// Returns a name without its prefix.
static const char *local_name(const char *name)
{
    const char *colon = strchr(name, ':');
    return colon ? colon + 1 : name;
}

static int find_row(const struct threemf_xml *xml, const char *name, enum threemf_namespace space)
{
    const char *local = local_name(name);
    int parent = xml->parser->rows[xml->parser->depth];
    for (int i = 0; parent != SKIPPED && i < xml->element_count; i++) {
        const struct threemf_element *row = &xml->elements[i];
        if (row->parent == parent && row->space == space && strcmp(row->name, local) == 0)
            return i;
    }
    return SKIPPED;
}

static bool open_element(struct threemf_xml *xml, const char *name, const char *const *attributes)
{
    struct xml_parser *parser = xml->parser;
    char shown[SHOWN_NAME_SIZE];
    enum threemf_namespace space = NS_NONE;
    if (parser->depth == DEPTH_MAX)
        return threemf_xml_fail(xml, "found more than %d elements within one another", DEPTH_MAX);
    if (!take_spaces(xml, name, attributes, &space))
        return false;
    int row = find_row(xml, name, space);
    if (parser->depth == 0 && row == SKIPPED)
        return threemf_xml_fail(xml, "found the element %s, expected %s of 3MF", shown_name(local_name(name), shown),
                                xml->elements[0].name);
    parser->rows[++parser->depth] = row;
    parser->spaces[parser->depth] = space;
    return row == SKIPPED || !xml->elements[row].begin || xml->elements[row].begin(xml, attributes);
}

static void XMLCALL begin_element(void *user, const XML_Char *name, const XML_Char **attributes)
{
    struct threemf_xml *xml = user;
    if (!xml->parser->failed && !open_element(xml, name, (const char *const *)attributes))
        stop(xml);
}

static void XMLCALL end_element(void *user, const XML_Char *name)
{
    struct threemf_xml *xml = user;
    struct xml_parser *parser = xml->parser;
    (void)name;
    if (parser->failed)
        return;
    int row = parser->rows[parser->depth--];
    if (row != SKIPPED && xml->elements[row].end && !xml->elements[row].end(xml))
        stop(xml);
    const struct declaration *rows = parser->declarations.items;
    while (parser->declarations.count && rows[parser->declarations.count - 1].depth > parser->depth)
        parser->prefixes.count = rows[--parser->declarations.count].prefix;
}

static void XMLCALL take_text(void *user, const XML_Char *text, int length)
{
    struct threemf_xml *xml = user;
    enum { TEXT_MAX = 4096 };
    for (int i = 0; xml->text && i < length && xml->text->count < TEXT_MAX && !xml->parser->failed; i++) {
        char *byte = threemf_add(xml->file, xml->text, 1);
        if (byte)
            *byte = text[i];
        else
            stop(xml);
    }
}

static void XMLCALL refuse_document_type(void *user, const XML_Char *name, const XML_Char *system,
                                         const XML_Char *public, int internal)
{
    struct threemf_xml *xml = user;
    (void)name, (void)system, (void)public, (void)internal;
    threemf_xml_fail(xml, "found a document type (<!DOCTYPE), which 3MF does not allow");
    stop(xml);
}

// --- parsing

bool threemf_xml_open(struct threemf *file)
{
    struct expat_library *expat = arena_alloc_zeroed(file->scratch, sizeof *expat);
    if (!expat)
        return threemf_no_memory(file, sizeof *expat);
    const char *fault =
        library_open_functions(&expat->handle, LIBRARY, true, LIBRARY_NAMES(FUNCTIONS), "lacks functions of expat 2");
    file->expat = fault ? NULL : expat;
    if (!fault && !library_find(expat->handle, "XML_SetReparseDeferralEnabled", &expat->set_deferral))
        expat->set_deferral = NULL;
    return !fault ||
           fail(file->error, LAM_UNSUPPORTED,
                "%s: reading 3MF needs " LIBRARY ", which %s (Debian's package libexpat1)", file->source->name, fault);
}

void threemf_xml_close(struct threemf *file)
{
    if (file->expat)
        library_close(file->expat->handle);
}

// Limits the length of an element, because expat rescans an incomplete element on each call and would take quadratic
// time.
static bool check_token(struct threemf_xml *xml)
{
    const struct xml_parser *parser = xml->parser;
    int64_t begin = parser->library->XML_GetCurrentByteIndex(parser->expat);
    return begin < 0 || parser->given - (uint64_t)begin <= TOKEN_BYTES ||
           threemf_xml_fail(xml, "found an element, a comment or a text of more than %d bytes", TOKEN_BYTES);
}

static bool parse_chunk(void *user, const void *bytes, size_t size, bool last)
{
    struct threemf_xml *xml = user;
    struct xml_parser *parser = xml->parser;
    parser->given += size;
    if (parser->library->XML_Parse(parser->expat, bytes, (int)size, last) == XML_STATUS_OK)
        return check_token(xml);
    if (parser->failed)
        return false;
    enum XML_Error code = parser->library->XML_GetErrorCode(parser->expat);
    if (code == XML_ERROR_NO_MEMORY)
        return threemf_no_memory(xml->file, size);
    return threemf_xml_fail(xml, "not well-formed XML: %s", parser->library->XML_ErrorString(code));
}

bool threemf_xml_parse(struct threemf_xml *xml)
{
    static const XML_Memory_Handling_Suite memory = {make_block, resize_block, free_block};
    const struct expat_library *library = xml->file->expat;
    struct call_control *before = parsing_call;
    struct xml_parser parser = {.library = library, .rows = {AT_ROOT}};
    parsing_call = xml->file->source->call;
    xml->parser = &parser;
    parser.expat = library->XML_ParserCreate_MM(NULL, &memory, NULL);
    bool ok = parser.expat || threemf_no_memory(xml->file, sizeof parser);
    if (ok) {
        library->XML_SetUserData(parser.expat, xml);
        if (library->set_deferral)
            library->set_deferral(parser.expat, XML_FALSE);
        library->XML_SetElementHandler(parser.expat, begin_element, end_element);
        library->XML_SetCharacterDataHandler(parser.expat, take_text);
        library->XML_SetStartDoctypeDeclHandler(parser.expat, refuse_document_type);
        ok = threemf_package_read(xml->file, xml->part, parse_chunk, xml);
        library->XML_ParserFree(parser.expat);
    }
    threemf_rows_free(xml->file, &parser.declarations);
    threemf_rows_free(xml->file, &parser.prefixes);
    parsing_call = before;
    xml->parser = NULL;
    return ok;
}

// --- attributes

const char *threemf_attribute(const char *const *attributes, const char *name)
{
    for (; *attributes; attributes += 2)
        if (strcmp(attributes[0], name) == 0)
            return attributes[1];
    return NULL;
}

const char *threemf_attribute_of(const struct threemf_xml *xml, const char *const *attributes,
                                 enum threemf_namespace space, const char *name)
{
    enum threemf_namespace found;
    for (; *attributes; attributes += 2)
        if (strchr(attributes[0], ':') && strcmp(local_name(attributes[0]), name) == 0 &&
            find_space(xml->parser, attributes[0], &found) && found == space)
            return attributes[1];
    return NULL;
}

bool threemf_take_number(struct threemf_xml *xml, const char *const *attributes, const char *name, uint32_t *out,
                         bool *found)
{
    const char *text = threemf_attribute(attributes, name);
    char shown[SHOWN_NAME_SIZE];
    if (found)
        *found = text != NULL;
    if (!text)
        return found || threemf_xml_fail(xml, "the attribute %s is missing", name);
    uint64_t value = 0;
    const char *at = text + strspn(text, " \t\r\n"), *digits = at;
    while (*at >= '0' && *at <= '9' && value <= INT32_MAX)
        value = 10 * value + (uint64_t)(*at++ - '0');
    bool good = at > digits && value <= INT32_MAX && !at[strspn(at, " \t\r\n")];
    *out = (uint32_t)value;
    return good || threemf_xml_fail(xml, "found %s=\"%s\", expected a whole number up to %d", name,
                                    shown_name(text, shown), INT32_MAX);
}

bool threemf_take_float(struct threemf_xml *xml, const char *const *attributes, const char *name, float *out)
{
    const char *text = threemf_attribute(attributes, name);
    char shown[SHOWN_NAME_SIZE];
    if (!text)
        return threemf_xml_fail(xml, "the attribute %s is missing", name);
    const uint8_t *at = (const uint8_t *)text + strspn(text, " \t\r\n");
    const uint8_t *next = number_float(at, at + strlen((const char *)at), out);
    bool good = next && !next[strspn((const char *)next, " \t\r\n")];
    return good || threemf_xml_fail(xml, "found %s=\"%s\", expected a number", name, shown_name(text, shown));
}

#endif
