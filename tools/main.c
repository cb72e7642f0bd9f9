// main.c: finds the command, parses its options, and runs it.
#include "command.h"

#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "console.h"
#include "exit_codes.h"
#include "help.h"
#include "page.h"
#include "report.h"
#include "sandbox.h"
#include "settings_file.h"
#include "settings_json.h"

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

// Returns whether the command reads the settings file. The pictures of a web page must not depend on the settings of
// the user who makes the page.
static bool reads_settings(const struct command *command, const struct options *options)
{
    return command->groups & 1ull << GROUP_SETTINGS && command != &command_table[COMMAND_config] &&
           !page_is_named(options->picture.output);
}

static int execute(const struct command *command, int operands, char **words, struct options *options)
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
    struct settings_source source;
    struct options before;
    if (reads_settings(command, options) && !settings_apply(options, &before, &source, &error))
        return report_failure(&error, options);
    options->limits.files_inside |= options->limits.sandbox == SANDBOX_REQUIRE && !options->limits.allow_paths.count;
#define RUN(name) run_##name,
    static command_fn *const functions[] = {COMMANDS(RUN)};
    int code = functions[command - command_table](operands, words, options);
    if (code == exit_code_of(LAM_BAD_ARGUMENT)->code && settings_are_used(options) && !options->report.quiet)
        say_plain("The settings of %s are in force; --no-config ignores them.\n", source.path);
    return code;
}

// Parses the options, unless the command receives its words verbatim. On failure, sets the error and returns −1.
// Otherwise, returns the number of operands.
static int parse(const struct command *command, int count, char **words, struct options *options, lam_error *error)
{
    bool help = count && (strcmp(words[0], "-h") == 0 || strcmp(words[0], "--help") == 0);
    return command->verbatim && !help ? count : options_parse(count, words, command->groups, options, error);
}

static int run(int count, char **words)
{
    struct options options = option_defaults();
    lam_error error = {0};
    struct options scanned = scan_report_options(count, words);
    const struct command *command = take_command(&count, words);
    int operands = parse(command, count, words, &options, &error);
    int code = operands < 0 ? report_failure(&error, &scanned) : execute(command, operands, words, &options);
    options_free(&options);
    return code;
}

// Disables glibc's lists of small freed blocks. glibc searches these lists whenever a large block becomes free, so
// reading a glTF file with 2 MB of JSON would need 12 % more processor time.
static void merge_freed_blocks(void)
{
#ifdef __GLIBC__
    mallopt(M_MXFAST, 0);
#endif
}

int main(int count, char **words)
{
    merge_freed_blocks();
    if (count == 3 && strcmp(words[1], CHECK_WORKER) == 0)
        check_worker(words[2]);
    signal(SIGXFSZ, SIG_IGN); // if a file exceeds the size limit, the write fails, but the program does not end
    console_start();
    option_table_fill();
    int code = run(count - (count > 0), words + (count > 0));
    lam_error error;
    writer_end();
    if (!finish_output(&error) && code == 0) { // an earlier failure has been reported
        say_error(error.text);
        code = exit_code_of(error.code)->code;
    }
    return code;
}
