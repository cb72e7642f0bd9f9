// host.h: communication between the page and a drawing in progress.
#ifndef WEB_HOST_H
#define WEB_HOST_H

#include <lambent/base.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

// The address of the cancel flag. A page that shares the module's memory stores 1 there to end the running call with
// LAM_CANCELLED. Each call clears the flag when it starts.
lam_cancel *web_cancel_flag(void) WEB_EXPORT(web_cancel_flag);

// Implemented by the page. The module calls it at most 20 times a second, with the finished fraction of a drawing, 0
// to 1.
void web_progress(double share) __attribute__((import_module("env"), import_name("web_progress")));

#endif
