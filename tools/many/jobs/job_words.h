// job_words.h: the options of a job, given as words of a command line or as a JSON object.
#ifndef JOB_WORDS_H
#define JOB_WORDS_H

#include <jansson.h>

#include "options.h"

// Makes the words for `value`: a list of words, an object such as {"size": 256, "light": ["a", "b"], "wireframe":
// true}, or nothing (NULL, null). The caller frees the words with job_words_free, even after an error. Fails with
// LAM_BAD_ARGUMENT or LAM_LIMIT.
bool job_words_make(const json_t *value, char ***words, int *count, lam_error *error);
void job_words_free(char **words, int count);

// Adds the words, which must stay valid, to the options. Fails with LAM_BAD_ARGUMENT if a word is invalid or an option
// does not concern the picture.
bool job_words_apply(char *const *words, int count, struct options *options, lam_error *error);

#endif
