// static_libraries.c: lists the libraries that a static program (meson -Dstatic_program=true) contains, and their
// functions by name. dynamic_library.c uses this table, because a static program cannot load libraries.
#include "static_libraries.h"

#include <stddef.h>
#include <string.h>

// Each row is a library's file name and the functions that Lambent looks up in it.
#define LIBRARIES(library, function)                                                                                   \
    library("libexpat.so.1") function(XML_ParserCreate_MM) function(XML_ParserFree) function(XML_SetUserData)          \
        function(XML_SetElementHandler) function(XML_SetCharacterDataHandler) function(                                \
            XML_SetStartDoctypeDeclHandler) function(XML_Parse) function(XML_StopParser) function(XML_GetErrorCode)    \
            function(XML_ErrorString) function(XML_GetCurrentLineNumber) function(XML_GetCurrentByteIndex) function(   \
                XML_SetReparseDeferralEnabled) library("libdeflate.so.0") function(libdeflate_alloc_compressor)        \
                function(libdeflate_free_compressor) function(libdeflate_deflate_compress)                             \
                    function(libdeflate_deflate_compress_bound) function(libdeflate_alloc_decompressor) function(      \
                        libdeflate_free_decompressor) function(libdeflate_zlib_decompress_ex)                          \
                        function(libdeflate_crc32) library("libwebp.so.7") function(WebPGetFeaturesInternal) function( \
                            WebPINewRGB) function(WebPIUpdate) function(WebPIDelete) function(WebPConfigInitInternal)  \
                            function(WebPPictureInitInternal) function(WebPPictureImportRGBA) function(WebPEncode)     \
                                function(WebPPictureFree) function(WebPFree) library("libwebpmux.so.3") function(      \
                                    WebPAnimEncoderOptionsInitInternal) function(WebPAnimEncoderNewInternal)           \
                                    function(WebPAnimEncoderAdd) function(WebPAnimEncoderAssemble)                     \
                                        function(WebPAnimEncoderGetError) function(WebPAnimEncoderDelete) library(     \
                                            "libfreetype.so.6") function(FT_Init_FreeType) function(FT_Done_FreeType)  \
                                            function(FT_New_Face) function(FT_New_Memory_Face) function(FT_Done_Face)  \
                                                function(FT_Set_Char_Size) function(FT_Get_Char_Index)                 \
                                                    function(FT_Load_Glyph) function(FT_Get_Kerning)                   \
                                                        library("libmeshoptimizer.so.2d")                              \
                                                            function(meshopt_decodeVertexBuffer)                       \
                                                                function(meshopt_decodeIndexBuffer)                    \
                                                                    function(meshopt_decodeIndexSequence)              \
                                                                        function(meshopt_decodeFilterOct)              \
                                                                            function(meshopt_decodeFilterQuat)         \
                                                                                function(meshopt_decodeFilterExp)

// Only the addresses of these declarations are used; the callers know the functions' types.
#define IGNORED(name)
#define DECLARED(name) extern char name[];
#pragma weak XML_SetReparseDeferralEnabled // since expat 2.6; the last row of its library, because it may have no address
LIBRARIES(IGNORED, DECLARED)

// A row without an address starts a new library.
static const struct row {
    const char *name;
    void *address;
} rows[] = {
#define LIBRARY(name)  {name, NULL},
#define FUNCTION(name) {#name, name},
    LIBRARIES(LIBRARY, FUNCTION){NULL, NULL}};

const void *static_library(const char *name)
{
    for (const struct row *row = rows; row->name; row++)
        if (!row->address && strcmp(row->name, name) == 0)
            return row;
    return NULL;
}

void *static_function(const void *library, const char *name)
{
    for (const struct row *row = (const struct row *)library + 1; row->address; row++)
        if (strcmp(row->name, name) == 0)
            return row->address;
    return NULL;
}
