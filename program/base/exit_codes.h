// exit_codes.h: the program's exit codes. main(), the reports, the help, the man page and the docs use the same table.
// The numbers are independent of lam_code.
#ifndef EXIT_CODES_H
#define EXIT_CODES_H

#include <lambent/base.h>

enum { EXIT_DIFFERS = 6, EXIT_SOME_FAILED = 7, EXIT_CRASHED = 8 };

struct exit_code {
    int code;
    int of;              // the corresponding lam_code, or −1
    const char *name;    // the name in reports, or NULL
    const char *meaning; // NULL at the end of the table
};
extern const struct exit_code exit_codes[];

const struct exit_code *exit_code_of(lam_code code);

// Returns the table's string that equals `name`, or "failed" if the table does not contain this name.
const char *exit_code_name(const char *name);

#endif
