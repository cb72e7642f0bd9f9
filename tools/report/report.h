// report.h: reports the result of a job as a line, a table, or JSON.
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "job.h"
#include "json.h"

// Prints "koala.png  1024x1024  99994 triangles  38 ms" on standard error.
void report_line(const struct job *job);

// Prints the files read and the time of each step on standard error.
void report_table(const struct job *job);

// Returns the stream of the JSON report: standard output, or standard error if the picture goes to standard output.
// Returns NULL if there is no report.
FILE *report_stream(const struct options *options);

// Reports a failure that does not belong to a job, such as a wrong command line or a missing device. With --json, also
// reports the failure as JSON. Returns the exit code.
int report_failure(const lam_error *error, const struct options *options);

// Writes the key "error": the class, the exit code and the text, or null if there is no error.
void json_error(struct json *json, const lam_error *error);

// Prints one line in the format of docs/report.schema.json. If `job` is NULL, `error` concerns the command line.
void report_json(FILE *file, const struct job *job, const lam_error *error);

#endif
