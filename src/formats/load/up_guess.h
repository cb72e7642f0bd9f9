// up_guess.h: guesses the up axis of a model whose format defines none, if the shape is unambiguous.
#ifndef UP_GUESS_H
#define UP_GUESS_H

#include "importer.h"
#include "scene_internal.h"

// Overrides the usual up axis of the format, with a warning, for two kinds of models. A terrain in the plane of x and y
// that was read with y up is thin along z and has slopes, and most of its area faces +z. (A closed surface faces all
// sides equally.) A model that lies down (only if `may_turn`) does not stand on the usual axis, but on exactly one of
// the other two.
void guess_up(struct lam_scene *scene, const struct importer *importer, bool may_turn,
              const struct import_source *source);

#endif
