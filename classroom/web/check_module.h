// check_module.h: the functions of the module of checks, which check.js calls. The module prints answers and error
// messages as JSON to standard output.
#ifndef CHECK_MODULE_H
#define CHECK_MODULE_H

#include <lambent/check.h>
#include <lambent/lambent.h>
#include <stdint.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

// Returns memory for the texts of the next call, each with a 0 at its end. NULL if memory is insufficient.
char *web_texts(uint32_t bytes) WEB_EXPORT(web_texts);

// Checks shaders. The texts of the call are the fragment shader, the vertex shader ("": the module generates one), the
// name of a contract ("": the module recognises it), and the highlight ("phong", or "" for the contract's highlight).
// `size` is the size of the pictures; 0 means the default. `max_pictures` is the same as in lam_check_params. The
// report is the same as from `lambent check --json`.
void web_check(int size, double max_pictures) WEB_EXPORT(web_check);

// Returns the RGBA pixels of a scene of the last report, four bytes for each pixel, rows from the top. Picture 0 is the
// shader's picture, 1 the reference, and 2 their difference times 8. NULL if memory is insufficient.
const void *web_check_picture(int scene, int which) WEB_EXPORT(web_check_picture);

// Lists contracts with their names, scenes, known mistakes and exercises.
void web_check_lists(void) WEB_EXPORT(web_check_lists);

// Prints the shaders of an exercise with its mistake and without it. The text of the call names the mistake.
void web_exercise(void) WEB_EXPORT(web_exercise);

// --- the exercises of the tab of shaders. They contain the mistakes of `lambent shader --mistake`.

struct json;

// Writes the member "exercises": the id, visible effect and description of each mistake.
void exercises_list(struct json *json);

// Prints the texts with a mistake, the texts without it, and their highlight. Returns false if no mistake has this id,
// or if memory is insufficient.
bool exercise_put(const char *mistake, lam_error *error);

// --- the painter of a check with WebGL 2.

extern const lam_check_painter web_painter;

// Returns whether the browser has stopped a shader since the last call. The page's WebGL context is then lost.
bool web_painter_was_stopped(void);

#endif
