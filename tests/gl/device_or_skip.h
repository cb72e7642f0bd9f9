// device_or_skip.h: an OpenGL device for a test; the test is skipped if this machine has none.
#ifndef DEVICE_OR_SKIP_H
#define DEVICE_OR_SKIP_H

#include <lambent/lambent.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static inline lam_device *device_or_skip(lam_gl_api api)
{
    lam_error error = {0};
    lam_gl_params params = {.api = api, .debug = true};
    lam_device *device = lam_device_gl(&params, &error);
    if (!device) {
        print_message("%s\n", error.text);
        skip();
    }
    return device;
}

#endif
