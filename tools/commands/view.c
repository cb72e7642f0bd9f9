// view.c: the command `view`: shows a model, or the gallery of a folder, in the browser.
#include "command.h"

#include "console.h"
#include "report.h"

#ifdef HAVE_MICROHTTPD
#include "view.h"
#endif

int run_view(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    (void)operand_count;
#ifdef HAVE_MICROHTTPD
    bool ok = view_run(operands[0], options, &error);
#else
    (void)operands;
    bool ok = complain(&error, LAM_UNSUPPORTED,
                       "this build does not include the viewer; the Debian package libmicrohttpd-dev was missing");
#endif
    return ok ? 0 : report_failure(&error, options);
}
