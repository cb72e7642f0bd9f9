// drawing.c: draws lines, boxes and text on a page: as elements of an SVG, or on a PNG with a small antialiasing
// painter.
#include "drawing.h"

#include <stdlib.h>
#include <string.h>

#include "base64.h"
#include "console.h"
#include "foreign.h"
#include "output.h"

bool drawing_open(struct drawing *d, int width, int height, bool svg, bool words, const char *font, lam_error *error)
{
    *d = (struct drawing){.width = width, .height = height, .words = words};
    if (svg) {
        d->svg = open_memstream(&d->svg_text, &d->svg_size);
        if (!d->svg)
            return complain(error, LAM_MACHINE, "out of memory");
        draw_box(d, (struct point){0, 0}, width, height, 0xffffff);
        return true;
    }
    if (words && !(d->font = lam_font_open(font, error))) {
        if (error->code == LAM_UNSUPPORTED) {
            lam_error reason = *error;
            complain(error, LAM_UNSUPPORTED, "%.400s; --no-captions draws without them", reason.text);
        }
        return false;
    }
    if (lam_image_make(&d->image, width, height, LAM_RGBA8, error)) {
        memset(d->image.pixels, 255, (size_t)width * (size_t)height * 4);
        return true;
    }
    drawing_free(d);
    return false;
}

bool drawing_is_svg(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && strcmp(dot, ".svg") == 0;
}

bool drawing_describe(struct drawing *d, const char *title, const char *description, lam_error *error)
{
    free(d->title);
    free(d->description);
    d->title = strdup(title);
    d->description = description ? strdup(description) : NULL; // from open_memstream
    return (d->title && d->description) || complain(error, LAM_MACHINE, "out of memory");
}

void drawing_free(struct drawing *d)
{
    if (d->svg)
        fclose(d->svg);
    free(d->svg_text);
    free(d->title);
    free(d->description);
    lam_font_free(d->font);
    lam_image_free(&d->image);
    *d = (struct drawing){0};
}

// --- PNG

static uint8_t *pixel_at(struct drawing *d, int x, int y)
{
    return (uint8_t *)d->image.pixels + 4 * ((size_t)y * (size_t)d->width + (size_t)x);
}

static int within(double x, int max) { return !(x > 0) ? 0 : x < max ? (int)x : max; }

// The page stays opaque, so blending is linear interpolation. Interpolating encoded values makes text and thin lines
// look best on white.
static void blend(uint8_t *pixel, uint32_t color, double cover)
{
    for (int c = 0; c < 3; c++) {
        double to = color >> (16 - 8 * c) & 255;
        pixel[c] = (uint8_t)(pixel[c] + (to - pixel[c]) * cover + 0.5);
    }
}

// Returns the fraction of the pixel at (x, y) that a line from a to b covers; `half` is half the line's width. The edge
// is a ramp one pixel wide, which is exact for horizontal and vertical edges and approximate for other edges.
static double cover_at(struct point a, struct point b, double half, double x, double y)
{
    double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    double along = square > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / square : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    double ox = x - a.x - along * dx, oy = y - a.y - along * dy;
    double cover = half + 0.5 - __builtin_sqrt(ox * ox + oy * oy);
    return cover < 0 ? 0 : cover > 1 ? 1 : cover;
}

// Draws all segments together, so that their joints are blended only once.
static bool paint_line(struct drawing *d, const struct point *p, int count, double width, uint32_t color,
                       lam_error *error)
{
    double half = width / 2, low_x = 1e9, low_y = 1e9, high_x = -1e9, high_y = -1e9;
    for (int i = 0; i < count; i++) {
        low_x = p[i].x < low_x ? p[i].x : low_x;
        high_x = p[i].x > high_x ? p[i].x : high_x;
        low_y = p[i].y < low_y ? p[i].y : low_y;
        high_y = p[i].y > high_y ? p[i].y : high_y;
    }
    int left = within(low_x - half - 1, d->width), right = within(high_x + half + 2, d->width);
    int top = within(low_y - half - 1, d->height), bottom = within(high_y + half + 2, d->height);
    if (left >= right || top >= bottom)
        return true;
    int columns = right - left;
    float *cover = calloc((size_t)columns * (size_t)(bottom - top), sizeof *cover);
    if (!cover)
        return complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; i + 1 < count || (i == 0 && count == 1); i++) {
        struct point a = p[i], b = p[count == 1 ? 0 : i + 1];
        int x0 = within((a.x < b.x ? a.x : b.x) - half - 1, d->width),
            x1 = within((a.x > b.x ? a.x : b.x) + half + 2, d->width);
        int y0 = within((a.y < b.y ? a.y : b.y) - half - 1, d->height),
            y1 = within((a.y > b.y ? a.y : b.y) + half + 2, d->height);
        for (int y = y0; y < y1; y++)
            for (int x = x0; x < x1; x++) {
                float share = (float)cover_at(a, b, half, x + 0.5, y + 0.5);
                float *here = &cover[(size_t)(y - top) * (size_t)columns + (size_t)(x - left)];
                *here = share > *here ? share : *here;
            }
    }
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++) {
            float share = cover[(size_t)(y - top) * (size_t)columns + (size_t)(x - left)];
            if (share > 0)
                blend(pixel_at(d, x, y), color, (double)share);
        }
    free(cover);
    return true;
}

// Draws a line as dashes of equal length.
static bool paint_dashes(struct drawing *d, const struct point *p, int count, double width, uint32_t color, double dash,
                         lam_error *error)
{
    struct point *part = calloc((size_t)count + 2, sizeof *part);
    if (!part)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = true, on = true;
    int parts = 0;
    double left = dash;
    part[parts++] = p[0];
    for (int i = 0; ok && i + 1 < count; i++) {
        struct point at = p[i];
        for (;;) {
            double dx = p[i + 1].x - at.x, dy = p[i + 1].y - at.y, length = __builtin_sqrt(dx * dx + dy * dy);
            if (length <= left) {
                left -= length;
                part[parts++] = p[i + 1];
                break;
            }
            at = (struct point){at.x + dx * left / length, at.y + dy * left / length};
            part[parts++] = at;
            if (on)
                ok = paint_line(d, part, parts, width, color, error);
            on = !on;
            left = dash;
            parts = 0;
            part[parts++] = at;
            if (!ok)
                break;
        }
    }
    if (ok && on && parts > 1)
        ok = paint_line(d, part, parts, width, color, error);
    free(part);
    return ok;
}

// --- both

void draw_box(struct drawing *d, struct point corner, double width, double height, uint32_t color)
{
    if (d->svg) {
        fprintf(d->svg, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"#%06x\"/>\n", corner.x,
                corner.y, width, height, color);
        return;
    }
    int right = within(corner.x + width + 0.5, d->width), bottom = within(corner.y + height + 0.5, d->height);
    for (int y = within(corner.y + 0.5, d->height); y < bottom; y++)
        for (int x = within(corner.x + 0.5, d->width); x < right; x++)
            blend(pixel_at(d, x, y), color, 1);
}

bool draw_line(struct drawing *d, const struct point *points, int count, double width, uint32_t color, double dash,
               lam_error *error)
{
    if (count < 2)
        return true;
    if (!d->svg)
        return dash > 0 ? paint_dashes(d, points, count, width, color, dash, error)
                        : paint_line(d, points, count, width, color, error);
    fprintf(d->svg, "<polyline fill=\"none\" stroke=\"#%06x\" stroke-width=\"%.2f\" stroke-linejoin=\"round\"", color,
            width);
    if (dash > 0)
        fprintf(d->svg, " stroke-dasharray=\"%.2f\"", dash);
    fprintf(d->svg, " points=\"");
    for (int i = 0; i < count; i++)
        fprintf(d->svg, "%s%.2f,%.2f", i ? " " : "", points[i].x, points[i].y);
    fprintf(d->svg, "\"/>\n");
    return true;
}

bool draw_dot(struct drawing *d, struct point middle, double radius, uint32_t color, lam_error *error)
{
    if (!d->svg)
        return paint_line(d, &middle, 1, 2 * radius, color, error);
    fprintf(d->svg, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"#%06x\"/>\n", middle.x, middle.y, radius, color);
    return true;
}

// Writes the text of an element and its end tag.
static void svg_letters(FILE *file, const char *text, const char *element)
{
    html_text(file, FOREIGN(text));
    fprintf(file, "</%s>\n", element);
}

// Scripts that are written from left to right without shaping: Unicode ranges
// (https://www.unicode.org/Public/UCD/latest/ucd/Blocks.txt). The default font contains the first three ranges.
static const struct {
    uint32_t first, last;
    bool own_font; // the default font contains no character of the range
} plain_scripts[] = {
    {0x20, 0x052F, false},   // Latin, Greek, Cyrillic
    {0x1E00, 0x1FFF, false}, // Latin and Greek with more diacritics
    {0x2000, 0x2BFF, false}, // punctuation, symbols, arrows, mathematical operators
    {0x0530, 0x058F, true},  // Armenian
    {0x10A0, 0x11FF, true},  // Georgian, Hangul jamo
    {0x2C00, 0xD7FF, true},  // Chinese, Japanese, Korean and others
    {0xF900, 0xFAFF, true},  {0xFE10, 0xFE6F, true}, {0xFF00, 0xFFEF, true}, {0x20000, 0x3FFFF, true},
};

// Decodes a UTF-8 character.
static uint32_t letter_number(const char *text, int bytes)
{
    uint32_t number = (unsigned char)*text & (bytes == 1 ? 0x7Fu : 0xFFu >> (bytes + 1));
    for (int i = 1; i < bytes; i++)
        number = number << 6 | ((unsigned char)text[i] & 0x3Fu);
    return number;
}

bool drawing_check_text(const char *option, const char *text, bool has_font, lam_error *error)
{
    for (int bytes; *text; text += bytes) {
        bytes = lam_utf8_length(text, strnlen(text, 4));
        if (!bytes || (unsigned char)*text < 32)
            return complain(error, LAM_BAD_ARGUMENT, "option '--%s': found a byte that is no letter, expected UTF-8",
                            option);
        uint32_t letter = letter_number(text, bytes);
        bool known = false, own_font = false;
        for (size_t i = 0; i < sizeof plain_scripts / sizeof *plain_scripts; i++)
            if (letter >= plain_scripts[i].first && letter <= plain_scripts[i].last) {
                known = true;
                own_font = plain_scripts[i].own_font;
            }
        if (!known || (own_font && !has_font))
            return complain(
                error, LAM_UNSUPPORTED,
                "option '--%s': the letter '%.*s' (U+%04X) %s; write an SVG, -o FILE.svg, whose viewer draws every "
                "language",
                option, bytes, text, (unsigned)letter,
                known ? "is missing from the default font; select another font with --font"
                      : "belongs to a script that is not supported in PNG files");
    }
    return true;
}

void draw_text(struct drawing *d, struct point baseline, double size, enum align align, uint32_t color,
               const char *text)
{
    if (!d->words)
        return;
    if (d->svg) {
        static const char *const anchors[] = {"start", "middle", "end"};
        fprintf(d->svg, "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%.2f\" text-anchor=\"%s\" fill=\"#%06x\">", baseline.x,
                baseline.y, size, anchors[align], color);
        svg_letters(d->svg, text, "text");
        return;
    }
    double back = align == ALIGN_LEFT ? 0 : text_width(d, size, text) * (align == ALIGN_RIGHT ? 1 : 0.5);
    lam_rgba ink = {(float)(color >> 16) / 255, (float)(color >> 8 & 255) / 255, (float)(color & 255) / 255, 1};
    lam_text_draw(&d->image, d->font, baseline.x - back, baseline.y, size, ink, text, NULL);
}

bool draw_text_upwards(struct drawing *d, struct point baseline, double size, uint32_t color, const char *text,
                       lam_error *error)
{
    if (!d->words)
        return true;
    if (d->svg) {
        fprintf(d->svg,
                "<text transform=\"translate(%.2f %.2f) rotate(-90)\" font-size=\"%.2f\" "
                "text-anchor=\"middle\" fill=\"#%06x\">",
                baseline.x, baseline.y, size, color);
        svg_letters(d->svg, text, "text");
        return true;
    }
    // Draws the text horizontally on a strip, then paints the rotated alpha of the strip.
    int length = (int)text_width(d, size, text) + 4, height = (int)(2 * size) + 2, base = (int)(1.5 * size);
    lam_image strip;
    if (!lam_image_make(&strip, length, height, LAM_RGBA8, error))
        return false;
    memset(strip.pixels, 0, (size_t)length * (size_t)height * 4);
    bool ok = lam_text_draw(&strip, d->font, 2, base, size, (lam_rgba){0, 0, 0, 1}, text, error);
    const uint8_t *from = strip.pixels;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < length; x++) {
            int to_x = (int)baseline.x + y - base, to_y = (int)baseline.y + length / 2 - x;
            if (to_x >= 0 && to_y >= 0 && to_x < d->width && to_y < d->height)
                blend(pixel_at(d, to_x, to_y), color, from[4 * (y * length + x) + 3] / 255.0);
        }
    lam_image_free(&strip);
    return ok;
}

double text_width(const struct drawing *d, double size, const char *text)
{
    if (d->font)
        return lam_text_width(d->font, size, text);
    int letters = 0;
    for (; d->words && *text; text++)
        letters += (*text & 0xC0) != 0x80;
    return letters * size * 0.62; // the mean width of DejaVu Sans, with a margin
}

static bool svg_image(struct drawing *d, const lam_image *image, int left, int top, const char *label, lam_error *error)
{
    lam_bytes png = {0};
    size_t length;
    if (!lam_image_encode(image, "png", &(lam_save_params){.compress = d->compress}, &png, error))
        return false;
    char *text = base64_encode(png.data, png.size, &length);
    lam_bytes_free(&png);
    if (!text)
        return complain(error, LAM_MACHINE, "out of memory");
    fprintf(d->svg, "<image x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" href=\"data:image/png;base64,", left, top,
            image->width, image->height);
    fwrite(text, 1, length, d->svg);
    fprintf(d->svg, "\"><title>");
    svg_letters(d->svg, label, "title");
    fprintf(d->svg, "</image>\n");
    free(text);
    return true;
}

bool draw_image(struct drawing *d, const lam_image *image, int left, int top, const char *label, lam_error *error)
{
    if (d->svg)
        return svg_image(d, image, left, top, label, error);
    int columns = image->width < d->width - left ? image->width : d->width - left;
    const uint8_t *from = image->pixels;
    for (int y = 0; y < image->height && top + y < d->height; y++)
        for (int x = 0; x < columns; x++) {
            const uint8_t *pixel = from + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
            blend(pixel_at(d, left + x, top + y), (uint32_t)(pixel[0] << 16 | pixel[1] << 8 | pixel[2]),
                  pixel[3] / 255.0);
        }
    return true;
}

// --- writing

static void put_svg(struct drawing *d, FILE *file)
{
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\"%s "
            "font-family=\"DejaVu Sans, Verdana, sans-serif\">\n",
            d->width, d->height, d->width, d->height, d->title ? " role=\"img\" aria-labelledby=\"title desc\"" : "");
    if (d->title) {
        fprintf(file, "<title id=\"title\">");
        svg_letters(file, d->title, "title");
        fprintf(file, "<desc id=\"desc\">");
        svg_letters(file, d->description, "desc");
    }
    fwrite(d->svg_text, 1, d->svg_size, file);
    fprintf(file, "</svg>\n");
}

// Makes the text of an SVG or the pixels of a picture, after the page's size if `sized` is set.
static bool page_bytes(struct drawing *d, bool sized, lam_bytes *bytes, lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = !d->svg || (fflush(d->svg) == 0 && !ferror(d->svg)) ? open_memstream(&text, &size) : NULL;
    if (!file)
        return complain(error, LAM_MACHINE, "out of memory");
    if (sized)
        fwrite((int[2]){d->width, d->height}, sizeof(int), 2, file);
    if (d->svg)
        put_svg(d, file);
    else
        fwrite(d->image.pixels, 4, (size_t)d->width * (size_t)d->height, file);
    bool failed = ferror(file);
    failed |= fclose(file) != 0;
    *bytes = (lam_bytes){text, size};
    if (failed)
        lam_bytes_free(bytes);
    return !failed || complain(error, LAM_MACHINE, "out of memory");
}

bool drawing_pack(struct drawing *d, lam_bytes *page, lam_error *error) { return page_bytes(d, true, page, error); }

bool drawing_write(struct drawing *d, const char *path, lam_error *error)
{
    lam_save_params params = {.compress = d->compress, .quality = d->quality, .durable = d->durable};
    uint64_t size;
    if (!d->svg)
        return output_save(&d->image, path, &params, &size, error);
    lam_bytes bytes;
    if (!page_bytes(d, false, &bytes, error))
        return false;
    bool ok = output_save_bytes(&bytes, path, d->durable, &size, error);
    lam_bytes_free(&bytes);
    return ok;
}

bool drawing_write_packed(const lam_bytes *page, int size[2], const char *path, const lam_save_params *params,
                          lam_error *error)
{
    const size_t head = 2 * sizeof(int);
    uint64_t written;
    if (page->size < head)
        return complain(error, LAM_MACHINE, "%s: the figure is incomplete", path);
    memcpy(size, page->data, head);
    lam_bytes bytes = {(char *)page->data + head, page->size - head};
    if (drawing_is_svg(path))
        return output_save_bytes(&bytes, path, params->durable, &written, error);
    lam_image image = {.pixels = bytes.data, .format = LAM_RGBA8, .width = size[0], .height = size[1]};
    if (size[0] <= 0 || size[1] <= 0 || bytes.size / 4 / (size_t)size[0] != (size_t)size[1])
        return complain(error, LAM_MACHINE, "%s: the figure is incomplete", path);
    return output_save(&image, path, params, &written, error);
}

bool draw_beam(struct drawing *d, struct point foot, double u, double cosine, uint32_t color, lam_error *error)
{
    enum { INK = 0x222222, GREY = 0x9a9a9a };
    const double sine = __builtin_sqrt(1 - cosine * cosine);
    struct point ground[2] = {{foot.x - 190 * u, foot.y}, {foot.x + 190 * u, foot.y}};
    char text[120] = "the light is behind the surface: cos θ ≤ 0";
    bool ok = draw_line(d, ground, 2, 2 * u, GREY, 0, error);
    if (cosine > 0) {
        const double half = 30 * u, area = half / cosine < 190 * u ? half / cosine : 190 * u;
        struct point trace[2] = {{foot.x - area, foot.y}, {foot.x + area, foot.y}}, across[2];
        for (int side = -1; ok && side <= 1; side += 2) {
            struct point edge[2] = {trace[side > 0], {trace[side > 0].x - 150 * u * sine, foot.y - 150 * u * cosine}};
            ok = draw_line(d, edge, 2, u, color, 4 * u, error);
            // the beam's width, perpendicular to l
            across[side > 0] = (struct point){foot.x - 75 * u * sine + side * half * cosine,
                                              foot.y - 75 * u * cosine - side * half * sine};
        }
        ok = ok && draw_line(d, trace, 2, 5 * u, color, 0, error) && draw_line(d, across, 2, 3 * u, color, 0, error);
        snprintf(text, sizeof text, "light on an area of 1: cos θ = n·l = %.6g", cosine);
        draw_text(d, (struct point){foot.x, foot.y + 40 * u}, 12.5 * u, ALIGN_MIDDLE, INK, text);
        snprintf(text, sizeof text, "beam: 1, surface: 1/cos θ = %.6g", 1 / cosine);
    }
    draw_text(d, (struct point){foot.x, foot.y + 24 * u}, 12.5 * u, ALIGN_MIDDLE, INK, text);
    return ok;
}
