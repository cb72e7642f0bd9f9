// view_windows.c: rejects the viewer on Windows, because the viewer draws in separate processes.
#include "command.h"

#include "console.h"
#include "report.h"

int run_view(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    (void)operand_count, (void)operands;
    complain(&error, LAM_UNSUPPORTED, "view: lambent for Windows does not include the viewer");
    return report_failure(&error, options);
}
