// devices.c: the command `devices`: lists the devices that can draw on this machine.
#include "command.h"

#include <stdio.h>

#include <lambent/gl.h>

#include "json.h"
#include "report.h"

enum { DEVICES_MOST = 64 };

static void print_json(const char *cpu, const lam_gl_device *list, int count, const lam_error *error)
{
    struct json json = {.file = stdout};
    json_open(&json, NULL, '{');
    json_text(&json, "cpu", cpu);
    json_open(&json, "gl", '[');
    for (int i = 0; i < count; i++) {
        const lam_gl_device *d = &list[i];
        json_put(&json, OBJECT(NULL, COUNT("number", d->number), TEXT("name", d->usable ? d->name : NULL),
                               TEXT("driver", d->usable ? d->driver : NULL), TEXT("place", d->path),
                               TEXT("kind", d->software ? "software" : "hardware"),
                               TEXT("versions", d->usable ? d->versions : NULL),
                               TEXT("reason", d->usable ? NULL : d->reason)));
    }
    json_close(&json, ']');
    json_text(&json, "gl_reason", count < 0 ? error->text : NULL);
    json_close(&json, '}');
    putchar('\n');
}

static void print_text(const char *cpu, const lam_gl_device *list, int count, const lam_error *error)
{
    printf("cpu   %s; the same bytes everywhere\n", cpu);
    for (int i = 0; i < count; i++) {
        const lam_gl_device *d = &list[i];
        const char *kind = d->software ? "software: runs on this processor" : "hardware";
        if (d->usable)
            printf("gl %d  %s; %s\n      %s; %s\n", d->number, d->name, kind, d->versions, d->driver);
        else
            printf("gl %d  cannot be used (%s)\n      %s\n", d->number, d->path, d->reason);
    }
    if (count < 0)
        printf("gl    cannot be used\n      %s\n", error->text);
}

int run_devices(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands;
    lam_error error = {0};
    lam_device *device = lam_device_cpu(NULL, &error);
    if (!device)
        return report_failure(&error, options);
    static lam_gl_device list[DEVICES_MOST];
    int count = lam_gl_devices(NULL, list, DEVICES_MOST, &error);
    if (options->report.json)
        print_json(lam_device_name(device), list, count, &error);
    else
        print_text(lam_device_name(device), list, count, &error);
    lam_device_free(device);
    return 0;
}
