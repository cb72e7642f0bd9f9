// command_table.h: the commands of the program, and the options that each accepts.
#ifndef COMMAND_TABLE_H
#define COMMAND_TABLE_H

#include "options.h"

// In the order of the help. The first one runs when the command line names none.
#define COMMANDS(row)                                                                                                  \
    row(render) row(batch) row(journal) row(compare) row(explain) row(info) row(check) row(shader) row(diff) row(hash) \
        row(convert) row(plot) row(lights) row(shape) row(view) row(shapes) row(formats) row(looks) row(materials)     \
            row(config) row(devices) row(help) row(complete) row(generate)

#define COMMAND_INDEX(name) COMMAND_##name,
enum command_index { COMMANDS(COMMAND_INDEX) COMMAND_COUNT };

// A command's own default of an option that others take too. Ends with a NULL option.
struct own_default {
    const char *option;
    const char *standard; // NULL: the option's
    const char *brief;    // for -h, in place of the option's; NULL: the option's
};

struct command {
    const char *name;
    const char *operands;               // as the help shows them; NULL: none
    const char *summary;                // one sentence
    uint64_t groups;                    // bit g: accepts the options of group g; TAKES_…: single options
    int min_operands, max_operands;     // max −1: no limit
    const struct own_default *defaults; // NULL: none of its own
    const char *one_more;               // the correct spelling, for the error about surplus operands; NULL: none
    bool verbatim;                      // its words are no options, but for -h and --help as the first
};

extern const struct command command_table[]; // in the order of COMMANDS; ends with a NULL name

// Returns the text of an option for the command's -h.
const char *brief_of(const struct command *command, const struct option *option);

const struct command *find_command(const char *name); // NULL: no such command
uint64_t find_groups(const char *name);               // of a command; 0: no such command

// Returns the default of an option in words, for a command: its own, else the option's. NULL: none is shown.
const char *default_of(const struct command *command, const struct option *option);

// Examples: a command line and its effect. Ends with NULL.
struct example {
    const char *line, *meaning;
    bool brief; // shown by -h too
};
extern const struct example examples[];

#endif
