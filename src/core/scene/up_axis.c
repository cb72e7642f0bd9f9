// up_axis.c: names of up axes, and rotations to and from y up.
#include "up_axis.h"

#include "linear.h"

#include <strings.h>

// The components are only permuted and negated, so nothing is rounded.
lam_vec3 from_y_up(lam_up up, lam_vec3 d)
{
    switch (up) {
    case LAM_UP_X:
        return v3(d.y, -d.x, d.z);
    case LAM_UP_Z:
        return v3(d.x, -d.z, d.y);
    case LAM_UP_NEGATIVE_X:
        return v3(-d.y, d.x, d.z);
    case LAM_UP_NEGATIVE_Y:
        return v3(-d.x, -d.y, d.z);
    case LAM_UP_NEGATIVE_Z:
        return v3(-d.x, -d.z, -d.y);
    default:
        return d;
    }
}

lam_vec3 to_y_up(lam_up up, lam_vec3 d)
{
    if (up == LAM_UP_Z)
        return v3(d.x, d.z, -d.y);
    // Opposite quarter turns undo each other; half turns undo themselves.
    return from_y_up(up == LAM_UP_X ? LAM_UP_NEGATIVE_X : up == LAM_UP_NEGATIVE_X ? LAM_UP_X : up, d);
}

static const char *const names[LAM_UP_COUNT] = {
    [LAM_UP_AUTO] = "auto",     [LAM_UP_X] = "x",           [LAM_UP_Y] = "y",           [LAM_UP_Z] = "z",
    [LAM_UP_NEGATIVE_X] = "-x", [LAM_UP_NEGATIVE_Y] = "-y", [LAM_UP_NEGATIVE_Z] = "-z", [LAM_UP_FILE] = "file",
};

const char *lam_up_name(lam_up up) { return (unsigned)up < LAM_UP_COUNT ? names[up] : NULL; }

lam_up lam_up_find(const char *name)
{
    int up = 0;
    if (name && *name == '+' && name[1] != '-')
        name++;
    while (up < LAM_UP_COUNT && (!name || strcasecmp(names[up], name) != 0))
        up++;
    return (lam_up)up;
}
