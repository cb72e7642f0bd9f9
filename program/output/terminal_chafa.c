// terminal_chafa.c: makes sixels and block characters with libchafa, which is loaded with dlopen only if it is needed.
//
// This file declares the few functions and constants itself, so a build does not need the library's header. They belong
// to the stable interface (https://hpjansson.org/chafa/ref/), which has not changed since version 1.6.
#include "terminal.h"

#include <dlfcn.h>
#include <string.h>

#include "console.h"

enum { SYMBOLS = 0, SIXELS = 1 };                        // ChafaPixelMode
enum { TRUECOLOR = 0, INDEXED_256 = 1, INDEXED_16 = 3 }; // ChafaCanvasMode
enum { RGBA8_UNASSOCIATED = 4 };                         // ChafaPixelType
enum { TAG_SPACE = 1, TAG_BLOCK = 8 };                   // ChafaSymbolTags

// GString of GLib.
struct g_string {
    char *text;
    size_t length, allocated;
};

// FUNCTION(result, name, parameters): the functions called in libchafa, and in GLib, which libchafa loads.
#define FUNCTIONS                                                                                                      \
    FUNCTION(void *, chafa_canvas_config_new, (void))                                                                  \
    FUNCTION(void, chafa_canvas_config_unref, (void *))                                                                \
    FUNCTION(void, chafa_canvas_config_set_geometry, (void *, int, int))                                               \
    FUNCTION(void, chafa_canvas_config_set_cell_geometry, (void *, int, int))                                          \
    FUNCTION(void, chafa_canvas_config_set_canvas_mode, (void *, int))                                                 \
    FUNCTION(void, chafa_canvas_config_set_pixel_mode, (void *, int))                                                  \
    FUNCTION(void, chafa_canvas_config_set_symbol_map, (void *, const void *))                                         \
    FUNCTION(void *, chafa_symbol_map_new, (void))                                                                     \
    FUNCTION(void, chafa_symbol_map_unref, (void *))                                                                   \
    FUNCTION(void, chafa_symbol_map_add_by_tags, (void *, int))                                                        \
    FUNCTION(void *, chafa_term_db_get_default, (void))                                                                \
    FUNCTION(void *, chafa_term_db_get_fallback_info, (void *))                                                        \
    FUNCTION(void, chafa_term_info_unref, (void *))                                                                    \
    FUNCTION(void *, chafa_canvas_new, (const void *))                                                                 \
    FUNCTION(void, chafa_canvas_unref, (void *))                                                                       \
    FUNCTION(void, chafa_canvas_draw_all_pixels, (void *, int, const uint8_t *, int, int, int))                        \
    FUNCTION(struct g_string *, chafa_canvas_print, (void *, void *))                                                  \
    FUNCTION(char *, g_string_free, (struct g_string *, int))

static struct {
    void *library; // never closed
#define FUNCTION(result, name, parameters) result(*name) parameters;
    FUNCTIONS
#undef FUNCTION
} chafa;

bool chafa_open(lam_error *error)
{
    if (chafa.library)
        return true;
#ifdef LAMBENT_STATIC
    return complain(error, LAM_UNSUPPORTED,
                    "option '--term': sixels and blocks need libchafa, which this static program does not contain");
#endif
    void *library = dlopen("libchafa.so.0", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return complain(error, LAM_UNSUPPORTED,
                        "option '--term': sixels and blocks need libchafa (Debian's package libchafa0): %.200s",
                        dlerror());
    bool ok = true;
    void *found;
#define FUNCTION(result, name, parameters)                                                                             \
    found = dlsym(library, #name);                                                                                     \
    memcpy(&chafa.name, &found, sizeof found);                                                                         \
    ok = ok && found;
    FUNCTIONS
#undef FUNCTION
    if (!ok) {
        dlclose(library);
        return complain(error, LAM_UNSUPPORTED, "option '--term': libchafa is too old, expected version 1.6 or newer");
    }
    chafa.library = library;
    return true;
}

bool chafa_print(const struct terminal *terminal, const lam_image *image, const struct chafa_size *size, FILE *out,
                 lam_error *error)
{
    bool sixels = terminal->kind == TERM_SIXEL;
    void *config = chafa.chafa_canvas_config_new();
    void *map = chafa.chafa_symbol_map_new();
    chafa.chafa_symbol_map_add_by_tags(map, TAG_SPACE | TAG_BLOCK);
    chafa.chafa_canvas_config_set_symbol_map(config, map);
    chafa.chafa_canvas_config_set_pixel_mode(config, sixels ? SIXELS : SYMBOLS);
    chafa.chafa_canvas_config_set_canvas_mode(config, sixels || terminal->has_truecolor ? TRUECOLOR
                                                      : terminal->has_256               ? INDEXED_256
                                                                                        : INDEXED_16);
    // Sixels use a single cell of the picture's size, so that rounding to cells does not stretch the picture.
    chafa.chafa_canvas_config_set_geometry(config, sixels ? 1 : size->columns, sixels ? 1 : size->rows);
    chafa.chafa_canvas_config_set_cell_geometry(config, sixels ? size->width : terminal->cell_width,
                                                sixels ? size->height : terminal->cell_height);
    void *canvas = chafa.chafa_canvas_new(config);
    chafa.chafa_canvas_draw_all_pixels(canvas, RGBA8_UNASSOCIATED, image->pixels, image->width, image->height,
                                       4 * image->width);
    void *info = chafa.chafa_term_db_get_fallback_info(chafa.chafa_term_db_get_default());
    struct g_string *text = chafa.chafa_canvas_print(canvas, info);
    bool ok = text && fwrite(text->text, 1, text->length, out) == text->length;
    if (text)
        chafa.g_string_free(text, 1);
    chafa.chafa_term_info_unref(info);
    chafa.chafa_canvas_unref(canvas);
    chafa.chafa_symbol_map_unref(map);
    chafa.chafa_canvas_config_unref(config);
    return ok || complain(error, LAM_CANNOT_WRITE, "standard output: cannot write the picture");
}
