// exit_codes.c: the program's exit codes.
#include "exit_codes.h"

#include <string.h>

const struct exit_code exit_codes[] = {
    {0, LAM_OK, "ok", "done"},
    {1, LAM_BAD_ARGUMENT, "usage", "the command line is wrong"},
    {2, LAM_CANNOT_READ, "cannot-read", "a model cannot be read or is not valid in its format"},
    {3, LAM_UNSUPPORTED, "unsupported", "a format, an instruction set or a feature is not supported"},
    {4, LAM_LIMIT, "limit",
     "a limit was exceeded, such as time, memory or the size of a picture; or the machine has no memory, file "
     "descriptors or processes left"},
    {5, LAM_CANNOT_WRITE, "cannot-write",
     "the output cannot be written, or would overwrite a file that lambent did not write"},
    {EXIT_DIFFERS, -1, NULL,
     "`diff`: the pictures differ by more than the tolerance; `hash --check`: pictures differ from the hashes in the "
     "file; `check`: the shader does not pass"},
    {EXIT_SOME_FAILED, -1, NULL,
     "`batch`, `diff` of folders, `hash`: some pictures failed (0 with `--failures-ok`, unless the machine failed); "
     "the "
     "messages and the journal name these pictures; `journal`: some pictures failed or are missing"},
    {EXIT_CRASHED, -1, "crashed", "`--isolate`: the process that drew the model ended without a result"},
    {130, LAM_CANCELLED, "cancelled", "interrupted (Ctrl-C); no partial files remain"},
    {0, -1, NULL, NULL},
};

const struct exit_code *exit_code_of(lam_code code)
{
    const struct exit_code *row = exit_codes;
    lam_code shown = code == LAM_MACHINE ? LAM_LIMIT : code;
    while (row->meaning && row->of != (int)shown)
        row++;
    return row;
}

const char *exit_code_name(const char *name)
{
    const struct exit_code *row = exit_codes;
    while (row->meaning && !(row->name && strcmp(row->name, name) == 0))
        row++;
    return row->meaning ? row->name : "failed";
}
