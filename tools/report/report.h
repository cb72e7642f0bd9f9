// report.h: tells what came of a job: a line, a table, or JSON.
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "job.h"

// "koala.png  1024x1024  99994 triangles  38 ms", on standard error.
void report_line(const struct job *job);

// What was read and what each step took, on standard error.
void report_table(const struct job *job);

// Where the report goes: standard output, or standard error where the picture goes to standard output, and
// then nothing else is written there; NULL: none is asked for.
FILE *report_stream(const struct options *options);

// Tells a failure that no job stands for (a wrong command line, no device), also as a report; returns the
// exit code.
int tell_failure(const lam_error *error, const struct options *options);

// One line as docs/report.schema.json describes it. `job` NULL: the command line itself was wrong, as `error` says.
void report_json(FILE *file, const struct job *job, const lam_error *error);

#endif
