// view_list.c: lists of views as text: sides by name, and directions evenly distributed on a sphere or a ring.
#include <lambent/camera.h>

#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "number.h"
#include "spelling.h"

#include <stdio.h>
#include <string.h>

enum { VIEWS_MAX = 10000, ITEM_SIZE = 48 };

// An item of a list: a side, or a number of directions.
struct item {
    lam_side side; // LAM_SIDE_COUNT if the item is a number of directions
    int count;
    bool ring;
    double elevation_deg;
};

// Reads a whole number from 1 to VIEWS_MAX. Returns the rest of the text, or NULL.
static const char *read_count(const char *at, int *count)
{
    const char *start = at;
    for (*count = 0; *at >= '0' && *at <= '9' && *count <= VIEWS_MAX; at++)
        *count = 10 * *count + (*at - '0');
    return at > start && *count >= 1 && *count <= VIEWS_MAX ? at : NULL;
}

static bool read_item(const char *text, struct item *item, lam_error *error)
{
    const char *names[LAM_SIDE_COUNT], *end;
    for (int i = 0; i < LAM_SIDE_COUNT; i++)
        names[i] = lam_side_name((lam_side)i);
    *item = (struct item){lam_side_find(text), .count = 1, .elevation_deg = 20};
    if (item->side < LAM_SIDE_COUNT)
        return true;
    item->ring = strncmp(text, "ring:", 5) == 0;
    end = read_count(text + (item->ring ? 5 : strncmp(text, "sphere:", 7) == 0 ? 7 : 0), &item->count);
    if (end && *end == '@' && item->ring) {
        const char *number = end + 1, *stop = end + strlen(end);
        end = (const char *)number_double((const uint8_t *)number, (const uint8_t *)stop, &item->elevation_deg);
        if (end == number || !(item->elevation_deg >= -90 && item->elevation_deg <= 90))
            end = NULL;
    }
    if (end && !*end)
        return true;
    const char *nearest = *text >= '0' && *text <= '9' ? NULL : meant_word(text, names, LAM_SIDE_COUNT);
    return fail(error, LAM_BAD_ARGUMENT,
                "found '%.40s', expected three-quarter, front, back, left, right, top, bottom, iso, a number of "
                "directions from 1 to %d, sphere:N or ring:N@ELEVATION%s%s%s",
                text, VIEWS_MAX, nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
}

// Direction i of a ring, or of a spherical Fibonacci lattice: N slices of equal height, one direction in the middle of
// each, from the top to the bottom. Each is turned by the golden angle, 180 (3 - √5) degrees, against the one above.
static lam_view direction(const struct item *item, int i)
{
    if (item->side < LAM_SIDE_COUNT)
        return lam_view_of_side(item->side);
    const uint64_t state = float_state_enter();
    const double y = 1 - (2 * i + 1) / (double)item->count, turns = i * (0.5 * (3 - math_sqrt(5)));
    const lam_view view = {.from_angles = true,
                           .azimuth_rad = 2 * PI * (item->ring ? i / (double)item->count : turns - (double)(int)turns),
                           .elevation_rad =
                               item->ring ? math_radians(item->elevation_deg) : math_atan2(y, math_sqrt(1 - y * y))};
    float_state_leave(state);
    return view;
}

int lam_views_parse(const char *text, int index, lam_view *view, char name[LAM_VIEW_NAME_SIZE], lam_error *error)
{
    int count = 0, digits = 1;
    const char *side = NULL;
    if (!text)
        return fail(error, LAM_BAD_ARGUMENT, "lam_views_parse: text is NULL"), -1;
    for (const char *at = text;; at++) {
        char copy[ITEM_SIZE];
        struct item item;
        const size_t length = strcspn(at, ",");
        snprintf(copy, sizeof copy, "%.*s", (int)(length < ITEM_SIZE ? length : ITEM_SIZE - 1), at);
        if (!read_item(copy, &item, error))
            return -1;
        if (index >= count && index - count < item.count) {
            side = lam_side_name(item.side);
            if (view)
                *view = direction(&item, index - count);
        }
        if ((count += item.count) > VIEWS_MAX)
            return fail(error, LAM_BAD_ARGUMENT, "'%.100s' has more than %d views", text, VIEWS_MAX), -1;
        at += length;
        if (!*at)
            break;
    }
    for (int last = count - 1; last >= 10; last /= 10)
        digits++;
    if (name && side)
        snprintf(name, LAM_VIEW_NAME_SIZE, "%s", side);
    else if (name)
        snprintf(name, LAM_VIEW_NAME_SIZE, "%0*d", digits, index);
    return count;
}
