// check_module.h: what the module of the page's checks offers to it (check.js). Answers are JSON on standard output, an error's
// sentence among them.
#ifndef CHECK_MODULE_H
#define CHECK_MODULE_H

#include <stdint.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

// Memory for the texts of the next call, each with a 0 at its end. NULL: there is none.
char *web_texts(uint32_t bytes) WEB_EXPORT(web_texts);

// Checks the texts: fragment shader, vertex shader ("": one is generated), name of a contract ("": it is recognised), highlight ("phong", or "": that
// of the contract).
// `size`: of the pictures, 0: the default. `max_pictures`: as in lam_check_params. The report is as `lambent check --json` has it.
void web_check(int size, double max_pictures) WEB_EXPORT(web_check);

// RGBA of a scene of the last report, four bytes for each pixel, rows from the top: 0 the shader's, 1 the reference, 2 their
// difference, 8 times as large. NULL: there is none.
const void *web_check_picture(int scene, int which) WEB_EXPORT(web_check_picture);

// Lists contracts with their names, scenes, known mistakes and exercises.
void web_check_lists(void) WEB_EXPORT(web_check_lists);

// The exercise with the mistake that the text of the call names: its shaders with the mistake and without it.
void web_exercise(void) WEB_EXPORT(web_exercise);

#endif
