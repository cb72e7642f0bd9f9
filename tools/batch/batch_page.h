// batch_page.h: --report: a page of all pictures of a batch, failures first.
#ifndef BATCH_PAGE_H
#define BATCH_PAGE_H

#include "batch_unit.h"

// Makes the thumbnails of a unit's pictures, in the folder beside the page. Any thread. What cannot be made is not there.
void batch_page_thumbnails(const struct batch *batch, const struct batch_unit *unit);

// Writes the page from the batch's records. Error: LAM_CANNOT_WRITE, LAM_LIMIT.
bool batch_page_write(const struct batch *batch, lam_error *error);

#endif
