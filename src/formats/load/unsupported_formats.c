// unsupported_formats.c: recognises unsupported formats by content or name, so that an error can name them.
#include "unsupported_formats.h"

#include "picture_kinds.h"

#include <stdbool.h>
#include <string.h>
#include <strings.h>

// The first matching row determines the kind of a file. A row matches if `magic` is at `offset`, and `within` (NULL if
// not required) occurs in the file.
static const struct kind {
    struct unsupported_format kind;
    unsigned offset, length;
    const char *magic;
    const char *within;
} kinds[] = {
    {{"an FBX file", ".glb"}, 0, 18, "Kaydara FBX Binary", NULL},
    {{"an FBX file", ".glb"}, 0, 5, "; FBX", NULL},
    {{"a STEP file", ".stl"}, 0, 12, "ISO-10303-21", NULL},
    {{"a VRML file", ".glb"}, 0, 5, "#VRML", NULL},
    {{"a USD file", ".glb"}, 0, 5, "#usda", NULL},
    {{"a USD file", ".glb"}, 0, 8, "PXR-USDC", NULL},
    {{"an OFF file", ".ply"}, 0, 3, "OFF", NULL},
    {{"an OFF file", ".ply"}, 0, 4, "COFF", NULL},
    {{"an OFF file", ".ply"}, 0, 4, "NOFF", NULL},
    {{"an OFF file", ".ply"}, 0, 5, "STOFF", NULL},
    {{"a DirectX file", ".glb"}, 0, 4, "xof ", NULL},
    {{"an AC3D file", ".glb"}, 0, 4, "AC3D", NULL},
    {{"a Draco file", ".glb"}, 0, 5, "DRACO", NULL},
    {{"an Alembic file", ".glb"}, 0, 5, "Ogawa", NULL},
    {{"a Blender file", ".glb"}, 0, 7, "BLENDER", NULL},
    {{"an AutoCAD drawing (DWG)", ".stl"}, 0, 4, "AC10", NULL},
    {{"a LightWave file", ".glb"}, 8, 3, "LWO", NULL},
    {{"a USDZ file", ".glb"}, 0, 4, "PK\3\4", ".usd"},
    {{"a ZIP archive", NULL}, 0, 4, "PK\3\4", NULL},
    {{"a gzip-compressed file (unpack it first)", NULL}, 0, 2, "\x1f\x8b", NULL},
    {{"a zstd-compressed file (unpack it first)", NULL}, 0, 4, "\x28\xb5\x2f\xfd", NULL},
    {{"UTF-16 text (save it as UTF-8)", NULL}, 0, 2, "\xff\xfe", NULL},
    {{"UTF-16 text (save it as UTF-8)", NULL}, 0, 2, "\xfe\xff", NULL},
    {{"a PNG picture", NULL}, 0, 8, "\x89PNG\r\n\x1a\n", NULL},
    {{"a JPEG picture", NULL}, 0, 3, "\xff\xd8\xff", NULL},
    {{"a WebP picture", NULL}, 8, 4, "WEBP", NULL},
    {{"an AVIF picture", NULL}, 4, 7, "ftypavi", NULL},
#define ROW(offset, length, magic, name) {{name, NULL}, offset, length, magic, NULL}
    UNREAD_PICTURES(ROW),
#undef ROW
    {{"a Radiance picture", NULL}, 0, 10, "#?RADIANCE", NULL},
    {{"an OpenEXR picture", NULL}, 0, 4, "\x76\x2f\x31\x01", NULL},
    {{"a PDF document", NULL}, 0, 5, "%PDF-", NULL},
    {{"a program", NULL},
     0,
     4,
     "\x7f"
     "ELF",
     NULL},
    {{"a film", NULL}, 4, 4, "ftyp", NULL},
    {{"a web page", NULL}, 0, 9, "<!DOCTYPE", NULL},
    {{"a web page", NULL}, 0, 9, "<!doctype", NULL},
    {{"a web page", NULL}, 0, 5, "<html", NULL},
};

// Text formats without a magic number: they are recognised by the first character after white space and by a later
// word.
static const struct text_kind {
    struct unsupported_format kind;
    char first;
    const char *within;
} text_kinds[] = {
    {{"a JSON file with neither the key \"asset\" of glTF nor \"lambent\" of scene files", NULL}, '{', "\":"},
    {{"a COLLADA file", ".glb"}, '<', "<COLLADA"},
    {{"an X3D file", ".glb"}, '<', "<X3D"},
    {{"an AMF file", ".stl"}, '<', "<amf"},
    {{"a BREP file", ".stl"}, 'D', "CASCADE Topology V"},
    {{"a BREP file", ".stl"}, 'C', "CASCADE Topology V"},
    {{"a BREP file", ".stl"}, 'O', "CASCADE Topology V"},
    {{"an XML file", NULL}, '<', "<?xml"},
    {{"a DXF file", ".stl"}, '0', "SECTION"},
    {{"an MTL file (materials only; give the .obj that names it)", NULL}, 'n', "newmtl "},
};

// Formats by their file extensions, which are separated by spaces.
static const struct named_kind {
    const char *endings;
    struct unsupported_format kind;
} named_kinds[] = {
    {"fbx", {"an FBX file", ".glb"}},
    {"blend", {"a Blender file", ".glb"}},
    {"dae", {"a COLLADA file", ".glb"}},
    {"usd usda usdc usdz", {"a USD file", ".glb"}},
    {"3ds", {"a 3DS file", ".glb"}},
    {"max", {"a 3ds Max file", ".glb"}},
    {"ma mb", {"a Maya file", ".glb"}},
    {"c4d", {"a Cinema 4D file", ".glb"}},
    {"lwo", {"a LightWave file", ".glb"}},
    {"abc", {"an Alembic file", ".glb"}},
    {"x3d", {"an X3D file", ".glb"}},
    {"wrl", {"a VRML file", ".glb"}},
    {"x", {"a DirectX file", ".glb"}},
    {"ac", {"an AC3D file", ".glb"}},
    {"skp", {"a SketchUp file", ".glb"}},
    {"drc", {"a Draco file", ".glb"}},
    {"off", {"an OFF file", ".ply"}},
    {"step stp", {"a STEP file", ".stl"}},
    {"iges igs", {"an IGES file", ".stl"}},
    {"brep brp", {"a BREP file", ".stl"}},
    {"amf", {"an AMF file", ".stl"}},
    {"dxf dwg", {"an AutoCAD drawing", ".stl"}},
    {"f3d ipt iam sldprt sldasm fcstd 3dm scad x_t", {"a CAD file", ".stl"}},
};

const struct unsupported_format *unsupported_format_named(const char *ending)
{
    size_t length = strlen(ending);
    for (size_t i = 0; length && i < sizeof named_kinds / sizeof *named_kinds; i++)
        for (const char *word = named_kinds[i].endings; *word; word += strspn(word, " ")) {
            size_t end = strcspn(word, " ");
            if (end == length && strncasecmp(word, ending, length) == 0)
                return &named_kinds[i].kind;
            word += end;
        }
    return NULL;
}

static bool holds(const uint8_t *bytes, size_t size, const char *word)
{
    return memmem(bytes, size, word, strlen(word)) != NULL;
}

// A 3DS file is a single chunk, which begins with 0x4d4d and the length of the whole file.
static bool is_3ds(const uint8_t *bytes, size_t size)
{
    return size >= 6 && bytes[0] == 0x4d && bytes[1] == 0x4d &&
           ((size_t)bytes[2] | (size_t)bytes[3] << 8 | (size_t)bytes[4] << 16 | (size_t)bytes[5] << 24) == size;
}

// IGES files consist of 80-column cards. The first card is numbered S 1.
static bool is_iges(const uint8_t *bytes, size_t size)
{
    return size > 80 && (memcmp(bytes + 72, "S      1", 8) == 0 || memcmp(bytes + 72, "S0000001", 8) == 0);
}

const struct unsupported_format *unsupported_format_of(const uint8_t *bytes, size_t size)
{
    static const struct unsupported_format studio = {"a 3DS file", ".glb"}, iges = {"an IGES file", ".stl"};
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
