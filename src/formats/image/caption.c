// caption.c: draws text in pictures with FreeType, which is loaded (dlopen) when the first font is opened.
#include "dynamic_library.h"
#include "fail.h"
#include "file.h"
#include "pixels.h"

#include <stdlib.h>
#include <string.h>

#include <lambent/caption.h>

#define NEEDED "captions need the Debian packages libfreetype6 and fonts-dejavu-core, or a font named by LAMBENT_FONT"

// Font files of the Debian packages fonts-dejavu-core, fonts-liberation2, fonts-liberation, fonts-noto-core,
// fonts-freefont-ttf and fonts-roboto-unhinted.
static const char *const font_paths[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/freefont/FreeSans.ttf",
    "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
};

const char *lam_font_path(int index)
{
    return index >= 0 && index < (int)(sizeof font_paths / sizeof *font_paths) ? font_paths[index] : NULL;
}

#ifdef HAVE_FREETYPE

#include <unistd.h>

#include <ft2build.h>
#include FT_FREETYPE_H

#ifdef LAMBENT_STATIC
#include "static_font.h"

#include <zlib.h>
#endif

// The FreeType functions that Lambent uses, with the types of their declarations.
#define FUNCTIONS(each)                                                                                                \
    each(FT_Init_FreeType) each(FT_Done_FreeType) each(FT_New_Face) each(FT_New_Memory_Face) each(FT_Done_Face)        \
        each(FT_Set_Char_Size) each(FT_Get_Char_Index) each(FT_Load_Glyph) each(FT_Get_Kerning)

struct freetype {
    void *handle;
    FUNCTIONS(LIBRARY_MEMBER)
};

struct lam_font {
    struct freetype ft;
    FT_Library library;
    FT_Face face;
    unsigned char *bytes; // bytes of the font embedded in a static program
};

static bool open_freetype(struct freetype *ft, lam_error *error)
{
    const char *fault = library_open_functions(&ft->handle, "libfreetype.so.6", false, LIBRARY_NAMES(FUNCTIONS),
                                               "lacks functions of FreeType 2");
    return !fault || fail(error, LAM_UNSUPPORTED, "text: libfreetype.so.6 %s; " NEEDED, fault);
}

static const char *find_font(void)
{
    const char *named = getenv("LAMBENT_FONT");
    if (named && *named)
        return named;
#ifndef LAMBENT_STATIC
    for (int i = 0; lam_font_path(i); i++)
        if (access(lam_font_path(i), R_OK) == 0)
            return lam_font_path(i);
#endif
    return NULL;
}

// Opens the font embedded in a static program, so that captions do not depend on the fonts of the machine.
static bool open_contained(lam_font *font, lam_error *error)
{
#ifdef LAMBENT_STATIC
    unsigned long size = static_font_size;
    font->bytes = malloc(size);
    if (!font->bytes)
        return fail_memory(error, size);
    if (uncompress(font->bytes, &size, static_font, static_font_packed_size) == Z_OK &&
        font->ft.FT_New_Memory_Face(font->library, font->bytes, (FT_Long)size, 0, &font->face) == 0)
        return true;
    return fail(error, LAM_MACHINE, "text: the program's own font cannot be opened: out of memory");
#else
    (void)font;
    return fail(error, LAM_UNSUPPORTED, "text: none of the default fonts is installed; " NEEDED);
#endif
}

static bool open_file(lam_font *font, const char *path, lam_error *error)
{
    if (access(path, R_OK) != 0)
        return fail(error, LAM_CANNOT_READ, "%s: the font is missing or cannot be read", path);
    if (!file_check_regular(path, error))
        return false;
    if (font->ft.FT_New_Face(font->library, path, 0, &font->face) != 0)
        return fail(error, LAM_CANNOT_READ, "%s: not a font that FreeType can read", path);
    return FT_IS_SCALABLE(font->face) ||
           fail(error, LAM_CANNOT_READ, "%s: the font has fixed sizes, expected an outline font", path);
}

static lam_font *open_font(const char *path, lam_error *error)
{
    lam_font *font = calloc(1, sizeof *font);
    if (!font)
        return fail_memory(error, sizeof *font), NULL;
    path = path ? path : find_font();
    bool ok = open_freetype(&font->ft, error);
    if (ok && font->ft.FT_Init_FreeType(&font->library) != 0)
        ok = fail(error, LAM_MACHINE, "text: FreeType did not start: out of memory");
    ok = ok && (path ? open_file(font, path, error) : open_contained(font, error));
    if (ok)
        return font;
    lam_font_free(font);
    return NULL;
}

lam_font *lam_font_open(const char *path, lam_error *error)
{
    lam_font *font = open_font(path, error);
    return font ? font : open_font(path, error); // if one allocation fails, FreeType may report a damaged font
}

void lam_font_free(lam_font *font)
{
    if (!font)
        return;
    if (font->face)
        font->ft.FT_Done_Face(font->face);
    if (font->library)
        font->ft.FT_Done_FreeType(font->library);
    if (font->ft.handle)
        library_close(font->ft.handle);
    free(font->bytes);
    free(font);
}

// Returns the code point at *text (U+FFFD for an invalid byte or sequence) and advances *text.
static FT_ULong next_letter(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    int more = s[0] < 0x80                   ? 0
               : s[0] >= 0xC2 && s[0] < 0xE0 ? 1
               : (s[0] & 0xF0) == 0xE0       ? 2
               : s[0] >= 0xF0 && s[0] < 0xF5 ? 3
                                             : -1;
    FT_ULong letter = more < 0 ? 0xFFFD : more == 0 ? s[0] : s[0] & (0x3Fu >> more);
    for (int i = 1; i <= more; i++) {
        if ((s[i] & 0xC0) != 0x80) {
            *text += 1;
            return 0xFFFD;
        }
        letter = letter << 6 | (s[i] & 0x3F);
    }
    *text += more < 0 ? 1 : more + 1;
    bool wrong = (more == 2 && letter < 0x800) || (more == 3 && (letter < 0x10000 || letter > 0x10FFFF)) ||
                 (letter >= 0xD800 && letter < 0xE000);
    return wrong ? 0xFFFD : letter;
}

static float clamped(float x) { return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f; }

// Blends a colour over a pixel; `cover` is the covered fraction of the pixel. Neither the colour nor the pixel is
// premultiplied.
static void blend_bytes(uint8_t *pixel, lam_rgba color, float cover)
{
    float from = color.a * cover, under = (float)pixel[3] / 255.0f, alpha = from + under * (1.0f - from);
    if (!(alpha > 0.0f))
        return;
    const float part[3] = {color.r, color.g, color.b};
    for (int c = 0; c < 3; c++) {
        float value = (part[c] * from + (float)pixel[c] / 255.0f * under * (1.0f - from)) / alpha;
        pixel[c] = (uint8_t)(clamped(value) * 255.0f + 0.5f);
    }
    pixel[3] = (uint8_t)(clamped(alpha) * 255.0f + 0.5f);
}

// Like blend_bytes, but for a pixel of premultiplied floats.
static void blend_floats(float *pixel, lam_rgba color, float cover)
{
    float from = color.a * cover;
    const float part[4] = {color.r * from, color.g * from, color.b * from, from};
    for (int c = 0; c < 4; c++)
        pixel[c] = part[c] + pixel[c] * (1.0f - from);
}

static void stamp(lam_image *image, const FT_Bitmap *bitmap, int left, int top, lam_rgba color)
{
    for (int row = 0; row < (int)bitmap->rows; row++)
        for (int column = 0; column < (int)bitmap->width; column++) {
            int x = left + column, y = top + row;
            if (x < 0 || y < 0 || x >= image->width || y >= image->height)
                continue;
            float cover = (float)bitmap->buffer[row * bitmap->pitch + column] / 255.0f, working[4];
            if (!(cover > 0.0f))
                continue;
            void *pixel = (char *)image_row(image, y) + (size_t)x * pixel_bytes(image->format);
            pixels_to_working(image->format, pixel, 1, working);
            if (format_is_float(image->format))
                blend_floats(working, color, cover);
            else
                blend_bytes((uint8_t *)working, color, cover);
            pixels_from_working(image->format, false, working, 1, pixel);
        }
}

// Lays out a line of text and returns its width in pixels. Draws the text unless `image` is NULL. Skips letters whose
// glyphs FreeType cannot load.
static double walk(lam_image *image, lam_font *font, double x, double y, double size_px, lam_rgba color,
                   const char *text)
{
    if (font->ft.FT_Set_Char_Size(font->face, 0, (FT_F26Dot6)(size_px * 64 + 0.5), 72, 72) != 0)
        return 0;
    FT_UInt before = 0;
    FT_Pos pen = 0; // in 1/64 pixel
    while (*text) {
        FT_UInt glyph = font->ft.FT_Get_Char_Index(font->face, next_letter(&text));
        FT_Vector kerning = {0, 0};
        if (before && glyph && font->ft.FT_Get_Kerning(font->face, before, glyph, FT_KERNING_UNFITTED, &kerning) == 0)
            pen += kerning.x;
        before = glyph;
        if (font->ft.FT_Load_Glyph(font->face, glyph, FT_LOAD_TARGET_LIGHT | (image ? FT_LOAD_RENDER : 0)) != 0)
            continue;
        FT_GlyphSlot slot = font->face->glyph;
        if (image && slot->bitmap.pixel_mode == FT_PIXEL_MODE_GRAY)
            stamp(image, &slot->bitmap, (int)(x + (double)pen / 64 + 0.5) + slot->bitmap_left,
                  (int)(y + 0.5) - slot->bitmap_top, color);
        pen += slot->advance.x;
    }
    return (double)pen / 64;
}

double lam_text_width(lam_font *font, double size_px, const char *text)
{
    if (!font || !text || !(size_px >= 1 && size_px <= 1000))
        return 0;
    return walk(NULL, font, 0, 0, size_px, (lam_rgba){0}, text);
}

bool lam_text_draw(lam_image *image, lam_font *font, double x, double y, double size_px, lam_rgba color,
                   const char *text, lam_error *error)
{
    if (!font || !text)
        return fail(error, LAM_BAD_ARGUMENT, "text: %s is NULL", font ? "text" : "font");
    if (!image_check(image, "text", error))
        return false;
    if (!(size_px >= 1 && size_px <= 1000))
        return fail(error, LAM_BAD_ARGUMENT, "text: the size is %g pixels, expected 1 to 1000", size_px);
    if (!(x > -1e6 && x < 1e6 && y > -1e6 && y < 1e6))
        return fail(error, LAM_BAD_ARGUMENT, "text: its position is %g, %g, expected pixels of the picture", x, y);
    walk(image, font, x, y, size_px, color, text);
    return true;
}

#else // FreeType's headers were missing at build time

lam_font *lam_font_open(const char *path, lam_error *error)
{
    (void)path;
    fail(error, LAM_UNSUPPORTED, "text: this build does not include FreeType (libfreetype-dev was missing)");
    return NULL;
}

void lam_font_free(lam_font *font) { (void)font; }

double lam_text_width(lam_font *font, double size_px, const char *text)
{
    (void)font, (void)size_px, (void)text;
    return 0;
}

bool lam_text_draw(lam_image *image, lam_font *font, double x, double y, double size_px, lam_rgba color,
                   const char *text, lam_error *error)
{
    (void)image, (void)font, (void)x, (void)y, (void)size_px, (void)color, (void)text;
    return fail(error, LAM_UNSUPPORTED, "text: this build does not include FreeType (libfreetype-dev was missing)");
}

#endif
