// batch_page.h: writes the page of --report, which shows all pictures of a batch, failures first.
#ifndef BATCH_PAGE_H
#define BATCH_PAGE_H

#include "batch_unit.h"

// Makes the thumbnails of a unit's pictures, in the folder beside the page. Any thread may call this function. Errors
// are ignored.
void batch_page_thumbnails(const struct batch *batch, const struct batch_unit *unit);

// Returns whether a thumbnail is missing, or older than its picture.
bool batch_page_lacks(const struct batch *batch, const struct batch_unit *unit);

// Makes the thumbnail of one picture if `is_new` is set or if no up-to-date thumbnail exists.
void batch_page_thumbnail(const char *page, const char *output, bool is_new);

// Returns the path of a record's picture, allocated with malloc. The path of a journal that others may have written
// (`own` is false) must be below the folder of the page; otherwise the result is NULL.
char *batch_page_output(const char *page, bool own, const json_t *record);

// Returns whether a path may be a thumbnail of the page.
bool batch_page_is_thumbnail(const char *page, const char *path);

struct batch_page {
    const char *path;
    const struct batch_tally *tally;
    // returns a picture's journal line or NULL; the caller releases it
    json_t *(*record)(void *user, size_t index);
    void *user;
    bool own; // the run itself made the records
    size_t record_count;
};

// Writes the page. Fails with LAM_CANNOT_WRITE or LAM_LIMIT.
bool batch_page_write(const struct batch_page *page, lam_error *error);

#endif
