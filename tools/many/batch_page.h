// batch_page.h: --report: a page of all pictures of a batch, failures first.
#ifndef BATCH_PAGE_H
#define BATCH_PAGE_H

#include "batch_unit.h"

// Makes the thumbnails of a unit's pictures, in the folder beside the page. Any thread. Thumbnails that cannot be made
// are missing.
void batch_page_thumbnails(const struct batch *batch, const struct batch_unit *unit);

// Returns whether one of them is missing, or older than its picture.
bool batch_page_lacks(const struct batch *batch, const struct batch_unit *unit);

// Makes the thumbnail of one picture, unless there is one that is not older. `is_new`: make it anyway.
void batch_page_thumbnail(const char *page, const char *output, bool is_new);

// Returns whether a path may be a thumbnail's beside the page.
bool batch_page_is_thumbnail(const char *page, const char *path);

struct batch_page {
    const char *path;
    const struct batch_tally *tally;
    json_t *(*record)(void *user, size_t index); // a picture's line of the journal, which is released; NULL: none
    void *user;
    size_t record_count;
};

// Writes the page. Error: LAM_CANNOT_WRITE, LAM_LIMIT.
bool batch_page_write(const struct batch_page *page, lam_error *error);

#endif
