// report.h: reports the result of a job as a line, a table, or JSON.
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "failure.h"
#include "job.h"

// Prints "koala.png  1024x1024  99994 triangles  38 ms" on standard error.
void report_line(const struct job *job);

// Prints the files read and the time of each step on standard error.
void report_table(const struct job *job);

// Prints one line in the format of docs/report.schema.json.
void report_json(FILE *file, const struct job *job, const lam_error *error);

#endif
