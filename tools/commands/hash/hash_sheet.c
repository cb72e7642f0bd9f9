// hash_sheet.c: draws the sheet of old and new pictures for `lambent hash --update` and stores the pictures for the
// next sheet.
#include "hash.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "drawing.h"
#include "kept_picture.h"
#include "output.h"
#include "writer.h"
#include "xxh64.h"

enum { CELL = 320, GAP = 16, TITLE = 28, HEAD = 40, INK = 0x222222, GREY = 0x777777 };

uint64_t hash_of_pixels(const lam_image *image)
{
    return xxh64_of(image->pixels, 4 * (size_t)image->width * (size_t)image->height);
}

char *hash_sheet_path(const char *file)
{
    const char *slash = strrchr(file, '/'), *dot = strrchr(slash ? slash : file, '.');
    char *path = NULL;
    return asprintf(&path, "%.*s-changes.png", (int)(dot ? (size_t)(dot - file) : strlen(file)), file) < 0 ? NULL
                                                                                                           : path;
}

char *hash_picture_path(const char *folder, const char *name)
{
    char *path = NULL;
    while (*name == '/' || strncmp(name, "../", 3) == 0)
        name += *name == '/' ? 1 : 3;
    bool slash = folder[strlen(folder) - 1] != '/';
    return asprintf(&path, "%s%s%s.png", folder, slash ? "/" : "", name) < 0 ? NULL : path;
}

// --- keeping

void hash_sheet_keep(const struct hash_run *run, const char *name, uint64_t recorded, const lam_image *picture,
                     json_t *found)
{
    if (!shared_count_take(run->rows, SHEET_ROWS))
        return;
    lam_image old = {0};
    lam_error error;
    const char *folder = run->options->hash.pictures;
    char *path = folder ? hash_picture_path(folder, name) : NULL;
    // If the hash of the stored picture differs from the recorded hash, the picture is from another run and is ignored.
    if (path && lam_image_load(&old, path, NULL, &error) && old.format == LAM_RGBA8 && hash_of_pixels(&old) == recorded)
        kept_picture_store(found, "old_picture", &old, CELL);
    kept_picture_store(found, "new_picture", picture, CELL);
    lam_image_free(&old);
    free(path);
}

// --- the sheet

// Draws a model's old picture (column 0) and new picture (column 1). If `first` is 1, omits column 0.
static bool draw_row(struct drawing *d, const json_t *record, const char *name, int first, int top, lam_error *error)
{
    lam_image pictures[2] = {0}, difference = {0};
    const char *const keys[] = {"old_picture", "new_picture"};
    bool has[2], ok = true;
    draw_text(d, (struct point){GAP, top + 18}, 15, ALIGN_LEFT, INK, name);
    for (int i = 0; i < 2; i++) {
        has[i] = kept_picture_load(record, keys[i], &pictures[i]);
        int left = GAP + (i - first) * (CELL + GAP);
        if (i < first)
            continue;
        if (has[i])
            ok = ok && draw_image(d, &pictures[i], left, top + TITLE, name, error);
        else
            draw_text(d, (struct point){left + CELL / 2.0, top + TITLE + CELL / 2.0}, 14, ALIGN_MIDDLE, GREY,
                      "not kept (--pictures)");
    }
    if (has[0] && has[1] && pictures[0].width == pictures[1].width && pictures[0].height == pictures[1].height &&
        lam_image_difference(&pictures[0], &pictures[1], 16, &difference, error))
        ok = ok && draw_image(d, &difference, GAP + 2 * (CELL + GAP), top + TITLE, name, error);
    for (int i = 0; i < 2; i++)
        lam_image_free(&pictures[i]);
    lam_image_free(&difference);
    return ok;
}

bool hash_sheet_write(const struct hash_run *run, json_t *const *records, int *rows, lam_error *error)
{
    *rows = 0;
    for (size_t i = 0; i < run->plan.count; i++)
        *rows += json_object_get(records[i], "new_picture") != NULL;
    if (!*rows)
        return true;
    *rows = *rows > SHEET_ROWS ? SHEET_ROWS : *rows;
    struct drawing d;
    bool any_old = false;
    for (size_t i = 0; i < run->plan.count; i++)
        any_old |= json_object_get(records[i], "old_picture") != NULL;
    int first = any_old ? 0 : 1,
        last = any_old ? 3 : 2; // without old pictures, the sheet has only the column of new pictures
    int width = GAP + (last - first) * (CELL + GAP), row = TITLE + CELL + GAP, drawn = 0;
    if (!drawing_open(&d, width, HEAD + *rows * row + GAP, false, true, NULL, error))
        return false;
    static const char *const heads[] = {"old", "new", "difference x 16"};
    for (int i = first; i < last; i++)
        draw_text(&d, (struct point){GAP + (i - first) * (CELL + GAP) + CELL / 2.0, 28}, 18, ALIGN_MIDDLE, INK,
                  heads[i]);
    bool ok = true;
    for (size_t i = 0; ok && i < run->plan.count && drawn < *rows; i++)
        if (json_object_get(records[i], "new_picture"))
            ok = draw_row(&d, records[i], run->names[i], first, HEAD + drawn++ * row, error);
    ok = ok && drawing_write(&d, run->sheet, error);
    drawing_free(&d);
    return ok;
}
