// contents.h: the contents of a model, for the page's list of objects and materials.
#ifndef WEB_CONTENTS_H
#define WEB_CONTENTS_H

#include <lambent/lambent.h>

#include "json.h"

// Writes the members of an object: size, unit, counts, objects with their parts (the first CONTENTS_MOST of them), materials, animations, variants
// and cameras of a loaded scene.
void contents_json(struct json *json, const lam_scene *scene);

// Objects, parts of an object and materials beyond this number are only counted.
enum { CONTENTS_MOST = 500 };

#endif
