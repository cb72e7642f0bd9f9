// check_module.h: the functions that the module of the page's checks provides to check.js. Answers, including error
// messages, are JSON on standard output.
#ifndef CHECK_MODULE_H
#define CHECK_MODULE_H

#include <stdint.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

// Memory for the texts of the next call, each with a 0 at its end. NULL if memory is insufficient.
char *web_texts(uint32_t bytes) WEB_EXPORT(web_texts);

// Checks the texts: fragment shader, vertex shader ("": one is generated), name of a contract ("": it is recognised),
// highlight ("phong", or "": the contract's).
// `size` is the size of the pictures; 0 means the default. `max_pictures` is the same as in lam_check_params. The
// report is the same as from `lambent check --json`.
void web_check(int size, double max_pictures) WEB_EXPORT(web_check);

// The RGBA pixels of a scene of the last report, four bytes for each pixel, rows from the top: 0 the shader's picture,
// 1 the reference, 2 their difference times 8. NULL if memory is insufficient.
const void *web_check_picture(int scene, int which) WEB_EXPORT(web_check_picture);

// Lists contracts with their names, scenes, known mistakes and exercises.
void web_check_lists(void) WEB_EXPORT(web_check_lists);

// The exercise with the mistake named in the call: its shaders with the mistake and without it.
void web_exercise(void) WEB_EXPORT(web_exercise);

#endif
