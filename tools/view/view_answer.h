// view_answer.h: answers of HTTP, with the headers that keep other pages out.
#ifndef VIEW_ANSWER_H
#define VIEW_ANSWER_H

#include "view.h"

enum view_bytes {
    VIEW_BORROWED, // the bytes are the caller's, and stay until the server ends
    VIEW_OWNED,    // they are from malloc, and the answer frees them
};

// Queues an answer of bytes. NULL for `type`: text.
enum MHD_Result view_answer(const struct view *view, struct MHD_Connection *connection, int status, const char *type,
                            const void *bytes, size_t size, enum view_bytes whose);

// Returns a sentence.
enum MHD_Result view_answer_text(const struct view *view, struct MHD_Connection *connection, int status,
                                 const char *sentence);

// Returns the contents of a file, whose handle it takes over.
enum MHD_Result view_answer_file(const struct view *view, struct MHD_Connection *connection, int file);

// Answers a connection with the result of its task.
enum MHD_Result view_answer_result(struct view_connection *connection);

// Headers of every answer, on a response of the caller's.
void view_answer_headers(const struct view *view, struct MHD_Response *response, const char *type);

#endif
