// kept_picture.h: keeps a picture in the record of a model, so that a model's process can pass it to the batch's.
#ifndef KEPT_PICTURE_H
#define KEPT_PICTURE_H

#include <jansson.h>
#include <lambent/image.h>

// Stores a picture (LAM_RGBA8) under a key of a record, reduced to at most `most` pixels on its longer side. If memory
// runs out, nothing is stored.
void kept_picture_store(json_t *record, const char *key, const lam_image *picture, int most);

// Gets a picture from a record. Returns false if there is none. The caller frees the picture in any case.
bool kept_picture_load(const json_t *record, const char *key, lam_image *picture);

#endif
