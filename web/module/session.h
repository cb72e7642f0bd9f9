// session.h: the functions that the module offers to the page (web/lambent.js). Words form a command line, each with a
// 0 at its end, in the memory of web_words. Answers, including error messages, are JSON on standard output.
#ifndef SESSION_H
#define SESSION_H

#include <stdint.h>

#include "host.h"

// Returns memory for the words of the next call, or NULL if memory runs out.
char *web_words(uint32_t bytes) WEB_EXPORT(web_words);

// Limits the memory for reading a model to this number of bytes, and the memory for drawing it to the same number, if
// the words contain no --memory-limit. 0, the default, means no limit.
void web_limit_memory(double bytes) WEB_EXPORT(web_limit_memory);

// Draws the picture of a command line, MODEL [OPTION...]. The model stays loaded until a call names another model, or
// contains an option that changes how the model is read. Returns 0, or the program's exit code. web_pixels returns the
// picture: RGBA, four bytes for each pixel, rows from the top, valid until the next call.
int web_draw(int count) WEB_EXPORT(web_draw);
const void *web_pixels(void) WEB_EXPORT(web_pixels);

// Draws the same picture, and writes it to the file that -o names.
int web_save(int count) WEB_EXPORT(web_save);

// Explains a pixel of that picture, as `lambent explain --json` does.
int web_explain(int count, int x, int y) WEB_EXPORT(web_explain);

// Prints three curves of one of that picture's lights, in the steps of `lambent plot`: the attenuation at distances
// from 0 to `farthest`, and the cone and the highlight at angles from 0 to 90 degrees. `light` is the light's index
// among the point, spot and directional lights, as listed in an explanation. The word after the command line names the
// reflection model of the highlight.
int web_curves(int count, int light, double farthest, double shininess) WEB_EXPORT(web_curves);

// Prints that picture's lights, as `lambent lights` does.
int web_lights(int count) WEB_EXPORT(web_lights);

// Lists the contents of the words' model (contents.h), without drawing it.
int web_contents(int count) WEB_EXPORT(web_contents);

// Lists the options of a picture with the complete help, in its groups, the names of shapes, materials and
// environments, and the extensions of readable models.
void web_options(void) WEB_EXPORT(web_options);

// Forgets the model, because its files may have changed.
void web_forget(void) WEB_EXPORT(web_forget);

#endif
