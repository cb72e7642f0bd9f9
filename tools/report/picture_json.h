// picture_json.h: describes a drawn picture in JSON, so that a web page can rotate its model.
#ifndef PICTURE_JSON_H
#define PICTURE_JSON_H

#include "job.h"
#include "json.h"

// Writes the members width, height, triangles, read_ms, frame_ms, camera, sphere, own_lights, color and warnings into
// the open JSON object. `read_ms` is the time that reading the model took, possibly for an earlier picture.
// `own_lights` is true if the picture uses the lights in the model's file, and no lights from --light. `color` is the
// diffuse colour of the first object's material.
void picture_json(struct json *json, const struct job *job, double read_ms);

#endif
