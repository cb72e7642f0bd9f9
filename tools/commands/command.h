// command.h: the commands of the program, one table; one file for each command.
#ifndef COMMAND_H
#define COMMAND_H

#include "options.h"

// Runs a command. Returns the program's exit code; whatever failed has been told.
typedef int command_fn(int operand_count, char **operands, const struct options *options);

struct command {
    const char *name;
    const char *operands; // as the help shows them; NULL: none
    const char *summary;  // one sentence
    unsigned groups;      // bit g: takes the options of group g; TAKES_…: single ones
    int least, most;      // count of operands; most −1: any
    command_fn *run;
};

unsigned find_groups(const char *name); // of a command; 0: no such command (help.c)

extern const struct command command_table[]; // the first one is what runs when no command is named; ends with NULL

command_fn run_render, run_shapes, run_lights, run_formats, run_help, run_generate, run_diff, run_plot, run_compare,
    run_explain, run_shader;
command_fn run_check, run_materials, run_devices;

// Examples: a command line and what it does. Ends with NULL.
struct example {
    const char *line, *meaning;
};
extern const struct example examples[];

// More to read for the man page and the docs: a title and its paragraphs, with `code` in back quotes. Ends
// with NULL.
struct topic {
    const char *title, *text;
};
extern const struct topic topics[];

#endif
