// view_draw.h: the work of a drawing process: it reads requests, draws with the options of their words, and answers; the model stays loaded.
// It runs within the sandbox of a command that reads a stranger's file: no sockets, no other processes.
#ifndef VIEW_DRAW_H
#define VIEW_DRAW_H

#include "options.h"
#include "view_files.h"

// The kind of a request.
enum view_kind {
    VIEW_MODEL,   // the files that the model reads, and whether the page can draw it: JSON
    VIEW_PIXELS,  // JSON about the picture (picture_json.h), and its pixels, RGBA
    VIEW_PICTURE, // the bytes of the picture as PNG
    VIEW_EXPLAIN, // JSON of the pixel x, y
    VIEW_KINDS,
};

struct view_request {
    enum view_kind kind;
    int x, y;
    int threads;   // 0: one for each processor
    int in_flight; // processes that draw at the same time, which share the memory
    int size; // bytes of the words, which follow: each with a 0 at its end; the first is the model, by its path in the page or a shape's name
};

// Before the parts of an answer.
struct view_reply {
    bool keeps;     // the model: it will be drawn again
    int status;     // of HTTP: 200, 422 (a sentence why there is no picture), 409 (cancelled)
    uint32_t notes; // bytes of JSON, or of the sentence
    uint64_t data;  // bytes that follow it: pixels, a file
};

// The largest model that the page draws itself: its triangles, lines and points, and the bytes of its files
// (PAGE_FILES_MAX).
enum { VIEW_TRIANGLES_MAX = 2000000 };

// Reads requests from `from` until it ends, and answers to `to`. SIGUSR1 cancels the one that is worked on. Does not return.
// `options`: limits of the command line.
_Noreturn void view_draw_serve(const struct view_files *files, const struct options *options, int from, int to);

#endif
