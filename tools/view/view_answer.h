// view_answer.h: sends HTTP answers, with headers that block access by other pages.
#ifndef VIEW_ANSWER_H
#define VIEW_ANSWER_H

#include "view.h"

enum view_bytes {
    VIEW_BORROWED, // the caller's bytes, valid until the server ends
    VIEW_OWNED,    // bytes allocated with malloc; the library frees them after the answer
};

// Queues an answer. If `type` is NULL, the answer is plain text.
enum MHD_Result view_answer(const struct view *view, struct MHD_Connection *connection, int status, const char *type,
                            const void *bytes, size_t size, enum view_bytes whose);

// Answers with a sentence.
enum MHD_Result view_answer_text(const struct view *view, struct MHD_Connection *connection, int status,
                                 const char *sentence);

// Answers with the contents of a file, and closes the handle `file` at the end.
enum MHD_Result view_answer_file(const struct view *view, struct MHD_Connection *connection, int file);

// Answers a connection with the result of its task.
enum MHD_Result view_answer_result(struct view_connection *connection);

// Adds the headers of all answers to the caller's response.
void view_answer_headers(const struct view *view, struct MHD_Response *response, const char *type);

#endif
