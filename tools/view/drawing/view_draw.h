// view_draw.h: runs the drawing process, which reads requests, draws the pictures, and sends answers. The process keeps
// the model loaded. It runs in the sandbox for untrusted files, without access to sockets or other processes.
#ifndef VIEW_DRAW_H
#define VIEW_DRAW_H

#include "options.h"
#include "view_files.h"

// The kinds of requests.
enum view_kind {
    VIEW_MODEL,   // JSON: the model's files, and whether the page can draw the model
    VIEW_PIXELS,  // JSON about the picture (report.h), and its RGBA pixels
    VIEW_PICTURE, // the picture as a PNG
    VIEW_EXPLAIN, // JSON that explains the pixel x, y
    VIEW_KINDS,
};

struct view_request {
    enum view_kind kind;
    int x, y;
    int threads;   // 0 means one per processor
    int in_flight; // the number of drawing processes, which share the memory
    // The size in bytes of the words, which follow this struct and each end with a 0. The first word is the model: its
    // path in the page, or the name of a shape.
    int size;
};

// The header of an answer. The notes and the data follow it.
struct view_reply {
    bool keeps;     // the model stays loaded for more pictures
    int status;     // HTTP status: 200, 422 (with a sentence) or 409 (cancelled)
    uint32_t notes; // the size of the JSON or of the sentence, in bytes
    uint64_t data;  // the size of the pixel data or of the file, in bytes
};

// The largest model that the page draws itself: the number of triangles, lines and points. PAGE_FILES_MAX limits the
// size of the model's files.
enum { VIEW_TRIANGLES_MAX = 2000000 };

// Reads requests from the file handle `from` until the end of the file, and writes the answers to `to`. SIGUSR1 cancels
// the current request. Does not return. `options` contains the limits from the command line.
_Noreturn void view_draw_serve(const struct view_files *files, const struct options *options, int from, int to);

#endif
