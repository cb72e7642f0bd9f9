// view_words.h: parses the page's command line, and converts its paths to paths on this machine.
#ifndef VIEW_WORDS_H
#define VIEW_WORDS_H

#include "options.h"
#include "view_files.h"

struct view_words {
    char *text;             // the words, each with a terminating zero
    char **words;           // pointers to the words, reordered by the parser
    char *model;            // the model's path on this machine, or a shape's name
    const char *page_model; // the model's path in the page
    char *environment;
};

// Parses the words of the page. Only options about pictures are accepted; `limits` provides all other options. `out` is
// valid until view_words_free. The caller must call options_free and then view_words_free, even after a failure. Fails
// with LAM_BAD_ARGUMENT, LAM_CANNOT_READ (a file that is not served) or LAM_LIMIT.
bool view_words_parse(struct view_words *w, const char *text, size_t size, const struct view_files *files,
                      const struct options *limits, struct options *out, lam_error *error);
void view_words_free(struct view_words *w);

#endif
