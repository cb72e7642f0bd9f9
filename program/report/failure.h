// failure.h: reports errors as text and as JSON.
#ifndef FAILURE_H
#define FAILURE_H

#include "json.h"
#include "options.h"

// Returns the stream of the JSON report: standard output, or standard error if the picture goes to standard output.
// Returns NULL if there is no report.
FILE *report_stream(const struct options *options);

// Reports a failure that does not belong to a job, such as a wrong command line or a missing device. With --json, also
// reports the failure as JSON. Returns the exit code.
int report_failure(const lam_error *error, const struct options *options);

// Begins a report: writes the version and the state of the sandbox.
void report_begin(struct json *json);

// Writes the key "error": the class, the exit code and the text, or null if there is no error.
void json_error(struct json *json, const lam_error *error);

#endif
