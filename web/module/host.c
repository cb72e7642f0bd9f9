// host.c: implements the program's system interface for a page. The page cancels a call by a flag, and the browser is
// the sandbox.
#include "host.h"

#include "interrupt.h"
#include "sandbox_start.h"

static lam_cancel wanted;

lam_cancel *web_cancel_flag(void) { return &wanted; }

void interrupt_start(void) {}
const lam_cancel *interrupt_flag(void) { return &wanted; }
bool interrupted(void) { return false; }

const char *sandbox_advice(const lam_error *error)
{
    (void)error;
    return "";
}
