// unsupported_formats.c: kinds of files that are recognised by content, so that an error can name them.
#include "unsupported_formats.h"

#include <string.h>

// A file is of the first kind whose `magic` is at `offset` and that contains `within` (NULL: no such test).
static const struct kind {
    struct unsupported_format kind;
    unsigned offset, length;
    const char *magic;
    const char *within;
} kinds[] = {
    {{"an FBX file", true}, 0, 18, "Kaydara FBX Binary", NULL},
    {{"an FBX file", true}, 0, 5, "; FBX", NULL},
    {{"a STEP file", true}, 0, 12, "ISO-10303-21", NULL},
    {{"a VRML file", true}, 0, 5, "#VRML", NULL},
    {{"a USD file", true}, 0, 5, "#usda", NULL},
    {{"a USD file", true}, 0, 8, "PXR-USDC", NULL},
    {{"an OFF file", true}, 0, 3, "OFF", NULL},
    {{"an OFF file", true}, 0, 4, "COFF", NULL},
    {{"an OFF file", true}, 0, 4, "NOFF", NULL},
    {{"an OFF file", true}, 0, 5, "STOFF", NULL},
    {{"a Draco file", true}, 0, 5, "DRACO", NULL},
    {{"an Alembic file", true}, 0, 5, "Ogawa", NULL},
    {{"a Blender file", true}, 0, 7, "BLENDER", NULL},
    {{"an AutoCAD drawing (DWG)", true}, 0, 4, "AC10", NULL},
    {{"a LightWave file", true}, 8, 3, "LWO", NULL},
    {{"a 3MF file", true}, 0, 4, "PK\3\4", "3D/3dmodel"},
    {{"a USDZ file", true}, 0, 4, "PK\3\4", ".usd"},
    {{"a ZIP archive", false}, 0, 4, "PK\3\4", NULL},
    {{"a gzip-compressed file (unpack it first)", false}, 0, 2, "\x1f\x8b", NULL},
    {{"a zstd-compressed file (unpack it first)", false}, 0, 4, "\x28\xb5\x2f\xfd", NULL},
    {{"UTF-16 text (save it as UTF-8)", false}, 0, 2, "\xff\xfe", NULL},
    {{"UTF-16 text (save it as UTF-8)", false}, 0, 2, "\xfe\xff", NULL},
    {{"a PNG picture", false}, 0, 8, "\x89PNG\r\n\x1a\n", NULL},
    {{"a JPEG picture", false}, 0, 3, "\xff\xd8\xff", NULL},
    {{"a GIF picture", false}, 0, 4, "GIF8", NULL},
    {{"a WebP picture", false}, 8, 4, "WEBP", NULL},
    {{"a TIFF picture", false}, 0, 4, "II*\0", NULL},
    {{"a TIFF picture", false}, 0, 4, "MM\0*", NULL},
    {{"a Radiance picture", false}, 0, 10, "#?RADIANCE", NULL},
    {{"an OpenEXR picture", false}, 0, 4, "\x76\x2f\x31\x01", NULL},
    {{"a PDF document", false}, 0, 5, "%PDF-", NULL},
    {{"a program", false},
     0,
     4,
     "\x7f"
     "ELF",
     NULL},
    {{"a film", false}, 4, 4, "ftyp", NULL},
    {{"a web page", false}, 0, 9, "<!DOCTYPE", NULL},
    {{"a web page", false}, 0, 9, "<!doctype", NULL},
    {{"a web page", false}, 0, 5, "<html", NULL},
};

// Text formats without a magic number: recognised by the first character after white space, and a later word.
static const struct text_kind {
    struct unsupported_format kind;
    char first;
    const char *within;
} text_kinds[] = {
    {{"a JSON file with neither the key \"asset\" of glTF nor \"lambent\" of scene files", false}, '{', "\":"},
    {{"a COLLADA file", true}, '<', "<COLLADA"},
    {{"an X3D file", true}, '<', "<X3D"},
    {{"an AMF file", true}, '<', "<amf"},
    {{"an XML file", false}, '<', "<?xml"},
    {{"a DXF file", true}, '0', "SECTION"},
    {{"a MTL file (materials only; give the .obj that names it)", false}, 'n', "newmtl "},
};

static bool holds(const uint8_t *bytes, size_t size, const char *word)
{
    return memmem(bytes, size, word, strlen(word)) != NULL;
}

// A 3DS file is one chunk: 0x4d4d and the length of the whole.
static bool is_3ds(const uint8_t *bytes, size_t size)
{
    return size >= 6 && bytes[0] == 0x4d && bytes[1] == 0x4d &&
           ((size_t)bytes[2] | (size_t)bytes[3] << 8 | (size_t)bytes[4] << 16 | (size_t)bytes[5] << 24) == size;
}

// IGES has cards of 80 columns, the first of them numbered S      1.
static bool is_iges(const uint8_t *bytes, size_t size) { return size > 80 && memcmp(bytes + 72, "S      1", 8) == 0; }

const struct unsupported_format *unsupported_format_of(const uint8_t *bytes, size_t size)
{
    static const struct unsupported_format studio = {"a 3DS file", true}, iges = {"an IGES file", true};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const struct kind *kind = &kinds[i];
        if (size >= kind->offset + kind->length && memcmp(bytes + kind->offset, kind->magic, kind->length) == 0 &&
            (!kind->within || holds(bytes, size, kind->within)))
            return &kind->kind;
    }
    if (is_3ds(bytes, size))
        return &studio;
    if (is_iges(bytes, size))
        return &iges;
    size_t at = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; // a byte order mark
    bool comment = false;                                                   // MTL files begin with comments
    while (at < size && (bytes[at] <= ' ' || bytes[at] == '#' || comment)) {
        comment = (comment || bytes[at] == '#') && bytes[at] != '\n';
        at++;
    }
    for (size_t i = 0; at < size && i < sizeof text_kinds / sizeof *text_kinds; i++) {
        if (bytes[at] == (uint8_t)text_kinds[i].first && holds(bytes + at, size - at, text_kinds[i].within))
            return &text_kinds[i].kind;
    }
    return NULL;
}
