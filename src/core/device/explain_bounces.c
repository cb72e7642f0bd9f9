// explain_bounces.c: records the light of an explained pixel's paths by the number of reflections.
//
// A path that ends after k reflections has the same directions as a longer one, so that the difference of two pictures
// with k and k − 1 reflections is the light after k reflections, of the same paths. The standard error comes from
// several groups of paths.
#include "path_passes.h"

#include "fail.h"
#include "pixels.h"
#include "recorder.h"

enum { GROUPS = 16 };

static void put(lam_rgb *to, int channel, double value)
{
    float *const channels[3] = {&to->r, &to->g, &to->b};
    *channels[channel] = (float)value;
}

// Sets the mean and the standard error of a number of reflections from the light of each group.
static void set_bounce(lam_explained_bounce *out, double (*light)[3], int groups)
{
    for (int c = 0; c < 3; c++) {
        double sum = 0, squares = 0;
        for (int i = 0; i < groups; i++)
            sum += light[i][c];
        for (int i = 0; i < groups; i++)
            squares += (light[i][c] - sum / groups) * (light[i][c] - sum / groups);
        put(&out->light, c, sum / groups);
        put(&out->error, c, groups > 1 ? __builtin_sqrt(squares / groups / (groups - 1)) : 0);
    }
}

bool path_bounces_record(struct lam_device *device, const lam_image *target, struct call_control *call,
                         lam_error *error)
{
    struct frame *frame = &device->frame;
    struct recorder *recorder = device->recorder;
    const int pixel[2] = {recorder->out->x, recorder->out->y}, all = frame->settings.paths,
              most = frame->settings.bounces;
    const int groups = all < GROUPS ? all : GROUPS, each = all / groups;
    const lam_rgba background = frame->settings.background;
    double before[GROUPS][3] = {{0}}, light[GROUPS][3];
    lam_image picture = {0};
    lam_explained_bounce *bounces = recorder_alloc(recorder, (size_t)most + 1, sizeof *bounces);
    bool ok = bounces && lam_image_make(&picture, target->width, target->height, LAM_RGBA32F, error);
    device->recorder = NULL;
    frame->only_pixel = pixel;
    frame->settings.background = (lam_rgba){0, 0, 0, 0};
    frame->settings.paths = each;
    for (int k = 0; k <= most && ok; k++) {
        frame->path_bounces = k;
        for (int i = 0; i < groups && ok; i++) {
            frame->path_first = frame->path_position = i * each;
            ok = device->type->draw(device, frame, &picture, call, error);
            for (int c = 0; c < 3 && ok; c++) {
                double now = (double)((const float *)image_row(&picture, pixel[1]))[4 * pixel[0] + c];
                light[i][c] = now - before[i][c];
                before[i][c] = now;
            }
        }
        if (ok)
            set_bounce(&bounces[k], light, groups);
    }
    device->recorder = recorder;
    frame->settings.background = background;
    frame->settings.paths = all;
    frame->path_first = frame->path_position = 0;
    frame->only_pixel = NULL;
    lam_image_free(&picture);
    recorder->out->bounces = bounces;
    recorder->out->bounce_count = ok ? most + 1 : 0;
    recorder->out->bounce_paths = each * groups;
    return ok;
}
