// device_fixture.h: a CPU device for all tests of a group.
#ifndef DEVICE_FIXTURE_H
#define DEVICE_FIXTURE_H

#include <lambent/lambent.h>

static lam_device *device;

static int set_up(void **state)
{
    (void)state;
    device = lam_device_cpu(&(lam_cpu_params){.threads = 2}, NULL);
    return device ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    lam_device_free(device);
    return 0;
}

#endif
