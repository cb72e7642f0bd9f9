// check_process_windows.c: rejects checks on Windows, where Lambent has no OpenGL.
#include "check.h"

#include <stdlib.h>

#include "console.h"

void check_worker(const char *memory)
{
    (void)memory;
    exit(EXIT_FAILURE);
}

lam_check_draw_status check_process(void *user, const lam_bytes *request, lam_bytes *drawn, lam_error *error)
{
    (void)user, (void)request, (void)drawn;
    complain(error, LAM_UNSUPPORTED, "check: on Windows, Lambent cannot draw shaders, because it has no OpenGL there");
    return LAM_CHECK_DRAW_FAILED;
}
