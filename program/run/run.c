// run.c: finds the command, parses its options, and runs it.
#include "run.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "console.h"
#include "failure.h"
#include "help.h"
#include "joined_models.h"
#include "sandbox.h"
#include "synonyms.h"
#include "writer.h"

// Scans a command line for --json and -o -, which determine how an error in the command line is reported.
static struct options scan_report_options(int count, char **words)
{
    struct options options = {0};
    for (int i = 0; i < count && strcmp(words[i], "--") != 0; i++) {
        bool output =
            strcmp(words[i], "-o") == 0 || strcmp(words[i], "--output") == 0 || strcmp(words[i], "--out") == 0;
        if (strcmp(words[i], "--json") == 0)
            options.report.json = true;
        if ((output && i + 1 < count && strcmp(words[i + 1], "-") == 0) || strcmp(words[i], "-o-") == 0 ||
            strcmp(words[i], "--output=-") == 0 || strcmp(words[i], "--out=-") == 0)
            options.picture.output = "-";
    }
    return options;
}

// Removes the command's name, which may follow options, from the words. Returns the default command if the words
// contain no command.
static const struct command *take_command(int *count, char **words)
{
    int first = options_first_operand(*count, words);
    const struct command *command = first >= 0 ? find_command(words[first]) : NULL;
    if (!command)
        return command_table;
    memmove(words + first, words + first + 1, (size_t)(--*count - first) * sizeof *words);
    return command;
}

// Returns whether a stream is a file or a pipe, as after `cat a.stl |` and before `> p.png`.
static bool is_redirected(int stream)
{
    struct stat found;
    return fstat(stream, &found) == 0 && (S_ISREG(found.st_mode) || S_ISFIFO(found.st_mode));
}

// Joins the words `a.stl + b.stl` to one operand. `*joined` receives the memory of all such operands.
static int join_models(int count, char **operands, char **joined)
{
    size_t size = 1;
    int kept = 0;
    for (int i = 0; i < count; i++)
        size += strlen(operands[i]) + sizeof JOINED_MODELS;
    char *at = *joined = malloc(size);
    for (int i = 0; at && i < count; kept++) {
        char *start = at;
        at += sprintf(at, "%s", operands[i++]);
        while (i + 1 < count && strcmp(operands[i], "+") == 0) {
            at += sprintf(at, JOINED_MODELS "%s", operands[i + 1]);
            i += 2;
        }
        operands[kept] = start;
        at++;
    }
    return at ? kept : count;
}

// Takes what new users write without an option: `a.stl 800x600`, `a.stl p.png`, and a model or a picture in a pipe.
// Returns the number of operands that remain.
static int take_plain_operands(int count, char **operands, struct options *o)
{
    lam_error unused;
    lam_pixel_format format;
    const struct option *size = option_find("size");
    if (count > 1 && strchr(operands[count - 1], 'x') && access(operands[count - 1], F_OK) != 0 &&
        size->store(size, operands[count - 1], o, &unused))
        o->given[size - option_table] = (o->values[size - option_table] = operands[--count]);
    if (count == 2 && !o->picture.output && lam_image_format_for(operands[1], &format, NULL))
        o->picture.output = operands[--count];
    if (count == 0 && !o->batch.lists.count && is_redirected(STDIN_FILENO))
        operands[count++] = "-";
    bool prints = o->report.json || o->report.dry_run || o->batch.view_count > 1 || o->batch.size_count > 1;
    if (count == 1 && strcmp(operands[0], "-") == 0 && !o->picture.output && !prints && is_redirected(STDOUT_FILENO))
        o->picture.output = "-";
    return count;
}

static bool check_operands(const struct command *command, int count, char **operands, const struct options *options,
                           lam_error *error)
{
    if (options->batch.lists.count) // the lists contain the models
        return true;
    if (count < command->min_operands && command == command_table)
        return complain(error, LAM_BAD_ARGUMENT, "no model given, expected a file, a shape's name or -");
    if (count < command->min_operands)
        return complain(error, LAM_BAD_ARGUMENT, "%s: missing argument: %s", command->name, command->operands);
    if (command->max_operands >= 0 && count > command->max_operands)
        return complain(error, LAM_BAD_ARGUMENT, "%s: unexpected argument '%s'%s%s", command->name,
                        operands[command->max_operands], command->one_more ? "; " : "",
                        command->one_more ? command->one_more : "");
    return true;
}

static int execute(const struct command *command, int operands, char **words, struct options *options,
                   run_command_fn *run)
{
    lam_error error = {0};
    if (options->report.help) {
        (options->report.brief_help ? print_brief_help : print_help)(command);
        return 0;
    }
    if (options->report.version) {
        char sandbox[SANDBOX_TEXT_SIZE];
        struct sandbox_state offered = sandbox_offered();
        printf("lambent %s\n%s\nsandbox %s\n", lam_version(), lam_build_info(), sandbox_text(&offered, sandbox));
        return 0;
    }
    if (options->picture.output && strcmp(options->picture.output, "/dev/stdout") == 0)
        options->picture.output = "-"; // standard output is reserved for the picture
    if (!check_operands(command, operands, words, options, &error))
        return report_failure(&error, options);
    return run(command, operands, words, options);
}

// Parses the options, unless the command receives its words verbatim. On failure, sets the error and returns −1.
// Otherwise, returns the number of operands.
static int parse(const struct command *command, int count, char **words, struct options *options, lam_error *error)
{
    bool help = count && (strcmp(words[0], "-h") == 0 || strcmp(words[0], "--help") == 0);
    return command->verbatim && !help ? count : options_parse(count, words, command->groups, options, error);
}

// Runs a command line without the program's name. Changes the order of `words`. `line` is for options->line.
static int run_words(int count, char **words, char **line, run_command_fn *run)
{
    struct options options = option_defaults();
    lam_error error = {0};
    struct options scanned = scan_report_options(count, words);
    char **own = synonyms_replace(&count, words, &error);
    const struct command *command = own ? take_command(&count, own) : command_table;
    int operands = own ? parse(command, count, own, &options, &error) : -1;
    if (operands >= 0 && command == command_table && !options.report.help && !options.report.version)
        operands = take_plain_operands(operands, own, &options);
    char *joined = NULL;
    if (operands > 2 && !command->verbatim)
        operands = join_models(operands, own, &joined);
    options.line = line;
    int code = operands < 0 ? report_failure(&error, &scanned) : execute(command, operands, own, &options, run);
    options_free(&options);
    free(own);
    free(joined);
    return code;
}

int run_program(int count, char **words, run_command_fn *run)
{
    lam_error error;
    signal(SIGXFSZ, SIG_IGN); // if a file exceeds the size limit, the write fails, but the program does not end
    console_start();
    option_table_fill();
    char **line = calloc((size_t)count + 2, sizeof *line);
    if (!line) {
        say_error("out of memory");
        return exit_code_of(LAM_MACHINE)->code;
    }
    memcpy(line, words, (size_t)count * sizeof *line);
    int code = run_words(count - (count > 0), words + (count > 0), line, run);
    free(line);
    writer_end();
    if (!finish_output(&error) && code == 0) { // an earlier failure has been reported
        say_error(error.text);
        code = exit_code_of(error.code)->code;
    }
    return code;
}
