// plan.h: implements --dry-run: lists the pictures and files without drawing.
#ifndef PLAN_H
#define PLAN_H

#include <stdio.h>

#include "job.h"

// Prints the plan.
void report_plan(FILE *out, const struct job *job);

int planned_samples(const struct options *options); // per pixel
bool plan_replaces(const struct job *job);          // true if the picture's file exists

// Calls `visit` for each option of the command line with its value (NULL for a switch), and once per value for a
// repeatable option.
typedef void option_visit(void *user, const char *name, const char *value);
void each_given_option(const struct options *options, option_visit *visit, void *user);

#endif
