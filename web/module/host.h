// host.h: what the page and a drawing tell each other while the drawing runs.
#ifndef WEB_HOST_H
#define WEB_HOST_H

#include <lambent/base.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name)))

// The flag that ends the running call with LAM_CANCELLED, for a page that shares the module's memory: it stores 1 there. Each call clears it first.
lam_cancel *web_cancel_flag(void) WEB_EXPORT(web_cancel_flag);

// The page's: gets the share of a drawing that is done, 0 to 1, at most 20 times a second.
void web_progress(double share) __attribute__((import_module("env"), import_name("web_progress")));

#endif
