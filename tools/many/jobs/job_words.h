// job_words.h: the options of a job: words of a command line, or an object of options.
#ifndef JOB_WORDS_H
#define JOB_WORDS_H

#include <jansson.h>

#include "options.h"

// The words of `value`: a list of words, {"size": 256, "light": ["a", "b"], "wireframe": true}, or nothing (NULL, null). From
// malloc; freed by job_words_free, also after an error. Error: LAM_BAD_ARGUMENT, LAM_LIMIT.
bool job_words_make(const json_t *value, char ***words, int *count, lam_error *error);
void job_words_free(char **words, int count);

// Adds the words, which stay in use, to the options. Error: LAM_BAD_ARGUMENT, also for an option that is not one of the picture.
bool job_words_apply(char *const *words, int count, struct options *options, lam_error *error);

#endif
