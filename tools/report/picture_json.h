// picture_json.h: the data of a drawn picture that a page needs to rotate its model.
#ifndef PICTURE_JSON_H
#define PICTURE_JSON_H

#include "job.h"
#include "json.h"

// Prints the members of an object: width, height, triangles, read_ms, frame_ms, camera, sphere, warnings. `read_ms`: the time of reading
// the model, which may have been before.
void picture_json(struct json *json, const struct job *job, double read_ms);

#endif
