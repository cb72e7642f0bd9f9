// ply_header.c: reads the header of a PLY file: its elements and their properties.
//
//   ply
//   format ascii 1.0                    or binary_little_endian, binary_big_endian
//   comment …                           or obj_info; on any line. "comment TextureFile NAME" names a picture
//   element vertex 8
//   property float x                    scalars: a type and a name
//   property list uchar int corners     lists: type of the count, type of the items, name
//   end_header
//
// A line may be indented or blank. Lines end in "\n" or "\r\n"; if the first line ends in "\r", all lines do. The body
// begins after the line end of "end_header".
#include "ply.h"
#include "fail.h"
#include "number.h"
#include "text_cursor.h"

#include <string.h>

static const char *const type_names[PLY_TYPE_COUNT][2] = {
    [PLY_I8] = {"char", "int8"},      [PLY_U8] = {"uchar", "uint8"},     [PLY_I16] = {"short", "int16"},
    [PLY_U16] = {"ushort", "uint16"}, [PLY_I32] = {"int", "int32"},      [PLY_U32] = {"uint", "uint32"},
    [PLY_F32] = {"float", "float32"}, [PLY_F64] = {"double", "float64"},
};

int ply_find(const struct ply_element *element, bool list, const char *name)
{
    for (int i = 0; i < element->property_count; i++) {
        if (element->properties[i].list == list && strcmp(element->properties[i].name, name) == 0)
            return i;
    }
    return -1;
}

struct lines {
    const struct import_source *source;
    struct arena *arena;
    const uint8_t *at, *end; // the rest of the current line
    const uint8_t *next;     // the next line
    size_t number;           // the number of the current line
    char ending;             // '\n' (a '\r' before it is white space) or '\r'
};

// Advances to the next line. Returns false at the end of the file.
static bool next_line(struct lines *lines)
{
    const uint8_t *end = lines->source->bytes + lines->source->size;
    lines->at = lines->next;
    if (lines->at == end)
        return false;
    lines->number++;
    lines->end = memchr(lines->at, lines->ending, (size_t)(end - lines->at));
    if (!lines->end)
        lines->end = end;
    lines->next = lines->end == end ? end : lines->end + 1;
    return true;
}

static bool is_word(const uint8_t *word, const uint8_t *end, const char *expected)
{
    return (size_t)(end - word) == strlen(expected) && memcmp(word, expected, (size_t)(end - word)) == 0;
}

// Reads the next word of the line; the word is empty at the end of the line.
static void next_word(struct lines *lines, const uint8_t **word, const uint8_t **end)
{
    *word = text_skip_white(lines->at, lines->end);
    *end = lines->at = text_skip_word(*word, lines->end);
}

static bool fail_word(const struct lines *lines, const uint8_t *word, const char *expected, lam_error *error)
{
    char found[TEXT_FOUND_SIZE];
    return fail_line(error, lines->source, lines->number, "found %s, expected %s",
                     word < lines->end ? text_found(word, lines->end, found) : "the end of the line", expected);
}

static bool read_type(struct lines *lines, enum ply_type *type, lam_error *error)
{
    const uint8_t *word, *end;
    next_word(lines, &word, &end);
    for (int i = 0; i < PLY_TYPE_COUNT; i++) {
        if (is_word(word, end, type_names[i][0]) || is_word(word, end, type_names[i][1])) {
            *type = (enum ply_type)i;
            return true;
        }
    }
    return fail_word(lines, word, "a type (char, uchar, short, ushort, int, uint, float or double)", error);
}

static bool read_name(struct lines *lines, const char **name, lam_error *error)
{
    const uint8_t *word, *end;
    next_word(lines, &word, &end);
    if (word == end)
        return fail_word(lines, word, "a name", error);
    *name = text_name(lines->arena, word, (size_t)(end - word));
    return *name || call_memory_error(lines->source->call, (size_t)(end - word), error);
}

static bool read_format(struct lines *lines, enum ply_format *format, lam_error *error)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const uint8_t *word, *end;
    next_word(lines, &word, &end);
    int found = 0;
    while (found < 3 && !is_word(word, end, names[found]))
        found++;
    if (found == 3)
        return fail_word(lines, word, "ascii, binary_little_endian or binary_big_endian", error);
    *format = (enum ply_format)found;
    next_word(lines, &word, &end);
    return is_word(word, end, "1.0") || fail_word(lines, word, "version 1.0", error);
}

static bool read_element(struct lines *lines, struct ply_element *element, lam_error *error)
{
    *element = (struct ply_element){.line = lines->number};
    if (!read_name(lines, &element->name, error))
        return false;
    const uint8_t *word, *end;
    next_word(lines, &word, &end);
    int64_t count = 0;
    if (word == end || number_int(word, end, &count) != end || count < 0)
        return fail_word(lines, word, "the number of rows", error);
    element->count = (uint64_t)count;
    return true;
}

static bool read_property(struct lines *lines, struct ply_element *element, struct ply_property *property,
                          lam_error *error)
{
    *property = (struct ply_property){0};
    const uint8_t *before = lines->at, *word, *end;
    next_word(lines, &word, &end);
    property->list = is_word(word, end, "list");
    if (property->list) {
        before = lines->at;
        if (!read_type(lines, &property->count_type, error))
            return false;
        if (!ply_type_is_integer(property->count_type))
            return fail_word(lines, text_skip_white(before, lines->end), "an integer type for a list's count", error);
    } else {
        lines->at = before;
    }
    if (!read_type(lines, &property->type, error) || !read_name(lines, &property->name, error))
        return false;
    element->property_count++;
    element->list_count += property->list;
    element->scalar_bytes += property->list ? 0 : ply_type_size(property->type);
    element->min_bytes += ply_type_size(property->list ? property->count_type : property->type);
    return true;
}

enum keyword { BLANK, REMARK, TEXTURE, FORMAT, ELEMENT, PROPERTY, END, UNKNOWN };

// Reads a line's first word into *word and returns its keyword.
static enum keyword read_keyword(struct lines *lines, const uint8_t **word)
{
    static const struct {
        const char *word;
        enum keyword keyword;
    } keywords[] = {{"comment", REMARK},  {"obj_info", REMARK},   {"format", FORMAT},
                    {"element", ELEMENT}, {"property", PROPERTY}, {"end_header", END}};
    const uint8_t *end;
    next_word(lines, word, &end);
    if (*word == end)
        return BLANK;
    const uint8_t *second = text_skip_white(end, lines->end);
    if (is_word(*word, end, "comment") && text_is_word(second, lines->end, "texturefile")) {
        lines->at = text_skip_white(text_skip_word(second, lines->end), lines->end);
        return TEXTURE;
    }
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; i++) {
        if (is_word(*word, end, keywords[i].word))
            return keywords[i].keyword;
    }
    return UNKNOWN;
}

// Chooses the line ending from the first line, "ply", and skips this line.
static struct lines start(const struct import_source *source, struct arena *arena)
{
    struct lines lines = {.source = source, .arena = arena, .next = source->bytes, .ending = '\n'};
    const uint8_t *end = source->bytes + source->size, *line_end = text_line_end(source->bytes, end);
    if (line_end + 1 < end && line_end[0] == '\r' && line_end[1] != '\n')
        lines.ending = '\r';
    next_line(&lines);
    return lines;
}

bool ply_read_header(const struct import_source *source, struct arena *arena, struct ply_header *header,
                     lam_error *error)
{
    // The first pass counts elements and properties, and the second reads them.
    size_t element_capacity = 0, property_capacity = 0, texture_capacity = 0;
    enum keyword keyword = BLANK;
    const uint8_t *word;
    struct lines lines = start(source, arena);
    while (keyword != END && next_line(&lines)) {
        keyword = read_keyword(&lines, &word);
        element_capacity += keyword == ELEMENT;
        property_capacity += keyword == PROPERTY;
        texture_capacity += keyword == TEXTURE;
    }
    struct ply_element *elements = arena_array(arena, element_capacity, sizeof *elements);
    struct ply_property *properties = arena_array(arena, property_capacity, sizeof *properties);
    const char **textures = arena_array(arena, texture_capacity, sizeof *textures);
    if (!elements || !properties || !textures)
        return call_memory_error(source->call,
                                 element_capacity * sizeof *elements + property_capacity * sizeof *properties, error);

    bool has_format = false;
    *header = (struct ply_header){.elements = elements, .textures = textures};
    lines = start(source, arena);
    for (bool first = true;; first = false) {
        if (!first && !next_line(&lines))
            return fail_line(error, source, lines.number, "the file ends in its header, expected \"end_header\"");
        if (memchr(lines.at, 0, (size_t)(lines.end - lines.at)))
            return fail_line(error, source, lines.number, "found a zero byte in the header, expected text");
        if (first) // skips the line "ply"
            continue;
        keyword = read_keyword(&lines, &word);
        struct ply_element *element = header->element_count > 0 ? &elements[header->element_count - 1] : NULL;
        switch (keyword) {
        case BLANK:
        case REMARK:
            break;
        case TEXTURE: {
            const uint8_t *name = lines.at, *end = lines.end;
            while (end > name && text_white(end[-1]))
                end--;
            textures[header->texture_count] = text_name(arena, name, (size_t)(end - name));
            if (!textures[header->texture_count++])
                return call_memory_error(source->call, (size_t)(end - name), error);
            break;
        }
        case FORMAT:
            if (!read_format(&lines, &header->format, error))
                return false;
            has_format = true;
            break;
        case ELEMENT:
            element = &elements[header->element_count++];
            if (!read_element(&lines, element, error))
                return false;
            element->properties = properties;
            break;
        case PROPERTY:
            if (!element)
                return fail_word(&lines, word, "an element before its properties", error);
            if (!read_property(&lines, element, properties++, error))
                return false;
            break;
        case END:
            if (!has_format)
                return fail_word(&lines, word, "a format line before end_header", error);
            header->body = (size_t)(lines.next - source->bytes);
            return true;
        default:
            if (header->unknown_count++ == 0) {
                header->unknown_line = lines.number;
                header->unknown = word;
            }
        }
    }
}

void ply_warn_header(const struct import_source *source, struct lam_scene *scene, const struct ply_header *header)
{
    char found[TEXT_FOUND_SIZE];
    if (header->unknown_count)
        scene_warn(scene,
                   "%s:%zu: found %s, expected format, comment, element, property or end_header; the line is ignored%s",
                   source->name, header->unknown_line, text_found(header->unknown, source->bytes + source->size, found),
                   header->unknown_count > 1 ? ", and others" : "");
}
