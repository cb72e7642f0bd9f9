// main.c: runs the command of a command line with the user's settings.
#include <malloc.h>
#include <string.h>

#include "classroom.h"
#include "command.h"
#include "console.h"
#include "failure.h"
#include "page.h"
#include "run.h"
#include "sandbox_start.h"
#include "settings_file.h"
#include "report.h"

// Returns whether the command reads the settings file. The pictures of a web page must not depend on the settings of
// the user who makes the page.
static bool reads_settings(const struct command *command, const struct options *options)
{
    return command->groups & 1ull << GROUP_SETTINGS && command != &command_table[COMMAND_config] &&
           !page_is_named(options->picture.output);
}

#define IN_LAMBENT(name)   run_##name,
#define IN_CLASSROOM(name) classroom_run,
#define RUN(name, program) IN_##program(name)

static int run(const struct command *command, int operands, char **words, struct options *options)
{
    static command_fn *const functions[] = {COMMANDS(RUN)};
    lam_error error = {0};
    struct settings_source source;
    struct options before;
    if (reads_settings(command, options) && !settings_apply(options, &before, &source, &error))
        return report_failure(&error, options);
    options->limits.files_inside |= options->limits.sandbox == SANDBOX_REQUIRE && !options->limits.allow_paths.count;
    if ((command->groups & 1ull << GROUP_LIMITS || command == &command_table[COMMAND_journal]) &&
        !sandbox_hold(options, words, operands, &error))
        return report_failure(&error, options);
    int code = functions[command - command_table](operands, words, options);
    if (code == exit_code_of(LAM_BAD_ARGUMENT)->code && settings_are_used(options) && !options->report.quiet)
        say_plain("The settings of %s are in force; --no-config ignores them.\n", source.path);
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
#ifdef CLASSROOM_INSIDE
    if (count && strcmp(words[0], CLASSROOM_PROGRAM) == 0)
        return classroom_main(count, words);
#endif
    return run_program(count, words, run);
}
