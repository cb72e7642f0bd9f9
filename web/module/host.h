// host.h: communication between the page and a drawing in progress.
#ifndef WEB_HOST_H
#define WEB_HOST_H

#include <lambent/base.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

// The flag that ends the running call with LAM_CANCELLED, for a page that shares the module's memory: the page stores 1
// there. Each call clears it first.
lam_cancel *web_cancel_flag(void) WEB_EXPORT(web_cancel_flag);

// Implemented by the page: gets the completed fraction of a drawing, 0 to 1, at most 20 times a second.
void web_progress(double share) __attribute__((import_module("env"), import_name("web_progress")));

#endif
