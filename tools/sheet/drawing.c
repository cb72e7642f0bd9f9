// drawing.c: lines, boxes and words on a page: SVG as its own elements, PNG by a small antialiasing painter.
#include "drawing.h"

#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "output.h"

bool drawing_open(struct drawing *d, int width, int height, bool svg, bool words, const char *font, lam_error *error)
{
    *d = (struct drawing){.width = width, .height = height, .words = words};
    if (svg) {
        d->svg = open_memstream(&d->svg_text, &d->svg_size);
        if (!d->svg)
            return complain(error, LAM_LIMIT, "out of memory");
        fprintf(d->svg,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
                "font-family=\"DejaVu Sans, Verdana, sans-serif\">\n",
                width, height, width, height);
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

void drawing_free(struct drawing *d)
{
    if (d->svg)
        fclose(d->svg);
    free(d->svg_text);
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

// The page stays opaque, so blending is linear interpolation; of encoded values, with which type and thin lines look
// best on white.
static void blend(uint8_t *pixel, uint32_t color, double cover)
{
    for (int c = 0; c < 3; c++) {
        double to = color >> (16 - 8 * c) & 255;
        pixel[c] = (uint8_t)(pixel[c] + (to - pixel[c]) * cover + 0.5);
    }
}

// The coverage of a pixel by a line of this half width. The edge is a ramp one pixel wide, which is exact for edges
// along the axes and close for others.
static double cover_at(struct point a, struct point b, double half, double x, double y)
{
    double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    double along = square > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / square : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    double ox = x - a.x - along * dx, oy = y - a.y - along * dy;
    double cover = half + 0.5 - __builtin_sqrt(ox * ox + oy * oy);
    return cover < 0 ? 0 : cover > 1 ? 1 : cover;
}

// Draws all segments together, so that joints are not blended twice.
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
        return complain(error, LAM_LIMIT, "out of memory");
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

// Cuts a line into dashes along its length.
static bool paint_dashes(struct drawing *d, const struct point *p, int count, double width, uint32_t color, double dash,
                         lam_error *error)
{
    struct point *part = calloc((size_t)count + 2, sizeof *part);
    if (!part)
        return complain(error, LAM_LIMIT, "out of memory");
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

static void svg_letters(FILE *file, const char *text)
{
    for (; *text; text++)
        if (*text == '&' || *text == '<' || *text == '>')
            fprintf(file, *text == '&' ? "&amp;" : *text == '<' ? "&lt;" : "&gt;");
        else
            putc(*text, file);
    fprintf(file, "</text>\n");
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
        svg_letters(d->svg, text);
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
        svg_letters(d->svg, text);
        return true;
    }
    // Draws the text horizontally on a strip, then paints the strip's alpha rotated.
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

void draw_image(struct drawing *d, const lam_image *image, int left, int top)
{
    int columns = image->width < d->width - left ? image->width : d->width - left;
    for (int y = 0; y < image->height && top + y < d->height && columns > 0; y++)
        memcpy(pixel_at(d, left, top + y), (const uint8_t *)image->pixels + 4 * (size_t)y * (size_t)image->width,
               4 * (size_t)columns);
}

// --- writing

bool drawing_write(struct drawing *d, const char *path, lam_error *error)
{
    lam_save_params params = {.compress = d->compress, .quality = d->quality, .durable = d->durable};
    uint64_t size;
    if (d->svg) {
        fprintf(d->svg, "</svg>\n");
        if (fflush(d->svg) != 0 || ferror(d->svg))
            return complain(error, LAM_LIMIT, "out of memory");
        lam_bytes bytes = {d->svg_text, d->svg_size};
        return output_replace(path, &bytes, error);
    }
    return output_save(&d->image, path, &params, &size, error);
}
