// command_table.h: the program's commands, and the options that each command accepts.
#ifndef COMMAND_TABLE_H
#define COMMAND_TABLE_H

#include "options.h"

// Commands in the order of the help, with the program that contains each. The first command is the default.
#define COMMANDS(row)                                                                                                  \
    row(render, LAMBENT) row(batch, LAMBENT) row(journal, LAMBENT) row(sheet, LAMBENT) row(compare, LAMBENT)           \
        row(explain, LAMBENT) row(info, LAMBENT) row(check, CLASSROOM) row(shader, LAMBENT) row(diff, LAMBENT)         \
            row(hash, LAMBENT) row(convert, LAMBENT) row(plot, CLASSROOM) row(exercises, CLASSROOM)                    \
                row(lights, LAMBENT) row(shape, LAMBENT) row(view, LAMBENT) row(shapes, LAMBENT) row(formats, LAMBENT) \
                    row(looks, LAMBENT) row(materials, LAMBENT) row(config, LAMBENT) row(devices, LAMBENT)             \
                        row(help, LAMBENT) row(complete, LAMBENT) row(generate, LAMBENT)

#define COMMAND_INDEX(name, program) COMMAND_##name,
enum command_index { COMMANDS(COMMAND_INDEX) COMMAND_COUNT };

// A command's own default for a shared option. A list ends with a NULL option.
struct own_default {
    const char *option;
    const char *standard; // NULL means the option's own default.
    const char *brief;    // The text that -h shows; NULL means the option's own text.
};

struct command {
    const char *name;
    const char *operands;               // the operands as shown in the help; NULL for a command without operands
    const char *summary;                // one sentence
    uint64_t groups;                    // the accepted options: bit g for group g, and TAKES_… for single options
    int min_operands, max_operands;     // −1 in max_operands means no limit
    const struct own_default *defaults; // NULL if the command has no defaults of its own
    const char *one_more;               // a hint for the error about too many operands; may be NULL
    const char *also;                   // other names of the command, separated by spaces; may be NULL
    bool verbatim;                      // only -h and --help, as the first argument, are parsed as options
};

// Runs a command and reports its errors. Returns the program's exit code.
typedef int command_fn(int operand_count, char **operands, const struct options *options);

extern const struct command command_table[]; // in the order of COMMANDS, ends with a NULL name

// Returns the text that a command's -h shows for an option.
const char *brief_of(const struct command *command, const struct option *option);

const struct command *find_command(const char *name); // returns NULL if there is no such command
uint64_t find_groups(const char *name);               // returns the groups of a command, or 0 if there is no such
                                                      // command

// Returns the text of an option's default for a command: the command's own default, otherwise the option's default.
// Returns NULL if the help shows no default.
const char *default_of(const struct command *command, const struct option *option);

// An example: a command line and its effect. The list ends with NULL.
struct example {
    const char *line, *meaning;
    bool brief; // also shown by -h
};
extern const struct example examples[];

#endif
