// report.h: reports the result of a job as a line, a table, or JSON.
#ifndef REPORT_H
#define REPORT_H

#include "failure.h"
#include "job.h"
#include "json.h"
#include "options.h"

#include <stdio.h>

// Prints "koala.png  1024x1024  99994 triangles  38 ms" on standard error.
void report_line(const struct job *job);

// Prints the files read and the time of each step on standard error.
void report_table(const struct job *job);

// Prints one line in the format of docs/report.schema.json.
void report_json(FILE *file, const struct job *job, const lam_error *error);

// --- describes a drawn picture in JSON, so that a web page can rotate its model.

// Writes the members width, height, triangles, read_ms, frame_ms, camera, sphere, own_lights, color and warnings into
// the open JSON object. `read_ms` is the time that reading the model took, possibly for an earlier picture.
// `own_lights` is true if the picture uses the lights in the model's file, and no lights from --light. `color` is the
// diffuse colour of the first object's material.
void picture_json(struct json *json, const struct job *job, double read_ms);

// --- prints the section of a report about the user's settings file.

// Returns whether the settings file changed an option.
bool settings_are_used(const struct options *options);

// Prints "settings", which lists the options from the settings file with their values. Prints nothing if there are no
// such options.
void settings_json(struct json *json, const struct options *options);

// Prints the name and the value of an option.
void option_json(struct json *json, const char *name, const char *value);

// --- implements --dry-run: lists the pictures and files without drawing.

// Prints the plan.
void report_plan(FILE *out, const struct job *job);

int planned_samples(const struct options *options); // per pixel
bool plan_replaces(const struct job *job);          // true if the picture's file exists

// Calls `visit` for each option of the command line with its value (NULL for a switch), and once per value for a
// repeatable option.
typedef void option_visit(void *user, const char *name, const char *value);
void each_given_option(const struct options *options, option_visit *visit, void *user);

#endif
