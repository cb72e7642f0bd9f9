// turning.c: what each place to light costs: a model turns in front of the OpenGL device, lit in the
// application, in the vertex shader and in the fragment shader. Writes the table of docs/opengl.md.
//
//   turning [SHAPE or MODEL [SIZE [FRAMES [DEVICE]]]]      teapot 512 25
#include <lambent/lambent.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct measured {
    uint64_t first_bytes, bytes;
    double lighting, upload, draw, read, total; // milliseconds, each the minimum of all frames
};

static lam_scene *scene_of(const char *name, lam_error *error)
{
    int shape = lam_shape_find(name);
    if (shape < 0)
        return lam_scene_load(name, NULL, NULL, error);
    lam_scene *scene = lam_scene_make(error);
    lam_object object = lam_object_default();
    object.mesh = scene ? lam_scene_add_shape(scene, name, NULL, error) : -1;
    if (object.mesh >= 0 && lam_scene_add_object(scene, &object, error) >= 0)
        return scene;
    lam_scene_free(scene);
    return NULL;
}

// Turns every object about the y axis.
static bool turn(lam_scene *scene, const lam_object *first, double angle, lam_error *error)
{
    double c = cos(angle), s = sin(angle);
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        lam_object o = first[i];
        for (int j = 0; j < 4; j++) {
            double x = first[i].transform.m[0][j], z = first[i].transform.m[2][j];
            o.transform.m[0][j] = c * x + s * z;
            o.transform.m[2][j] = c * z - s * x;
        }
        if (!lam_scene_set_object(scene, i, &o, error))
            return false;
    }
    return true;
}

// The first frame is apart; those after it turn, or stand still.
static bool measure(lam_device *device, lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
                    lam_image *image, int frames, double step, struct measured *out, lam_error *error)
{
    int objects = lam_scene_object_count(scene);
    lam_object *first = calloc((size_t)objects + 1, sizeof *first);
    bool ok = first != NULL;
    for (int i = 0; ok && i < objects; i++)
        first[i] = *lam_scene_object(scene, i);
    for (int frame = -1; ok && frame < frames; frame++) {
        lam_frame_report r;
        ok = turn(scene, first, (frame + 1) * step, error) &&
             lam_draw(device, scene, camera, params, image, NULL, error);
        lam_device_report(device, &r);
        if (frame < 0) {
            out->first_bytes = r.bytes_uploaded;
            continue;
        }
        out->bytes = r.bytes_uploaded;
        const double ms[5] = {r.lighting_ms, r.upload_ms, r.draw_ms, r.read_ms, r.total_ms};
        double *least[5] = {&out->lighting, &out->upload, &out->draw, &out->read, &out->total};
        for (int i = 0; i < 5; i++)
            *least[i] = frame && *least[i] < ms[i] ? *least[i] : ms[i];
    }
    ok = ok && turn(scene, first, 0, error);
    free(first);
    return ok;
}

int main(int argc, char **argv)
{
    lam_error error = {LAM_BAD_ARGUMENT, "usage: turning [SHAPE or MODEL [SIZE [FRAMES [DEVICE]]]]"};
    const char *name = argc > 1 ? argv[1] : "teapot";
    int size = argc > 2 ? atoi(argv[2]) : 512, frames = argc > 3 ? atoi(argv[3]) : 25;
    lam_gl_params of = {.device = argc > 4 ? argv[4] : NULL};
    bool ok = argc <= 5 && size > 0 && frames > 0;
    lam_scene *scene = ok ? scene_of(name, &error) : NULL;
    lam_image image = {0};
    ok = scene && lam_image_make(&image, size, size, LAM_RGBA8, &error);
    lam_camera camera = lam_camera_fit(scene, size, size, NULL);
    static const struct {
        const char *name;
        lam_stage stage;
        lam_shading shading;
    } ways[] = {{"application, Gouraud", LAM_STAGE_APPLICATION, LAM_SHADING_GOURAUD},
                {"vertex, Gouraud", LAM_STAGE_VERTEX, LAM_SHADING_GOURAUD},
                {"fragment, Phong", LAM_STAGE_FRAGMENT, LAM_SHADING_PHONG}};
    for (int i = 0; ok && i < 3; i++) {
        lam_draw_params params = {.samples = 1, .stage = ways[i].stage, .shading = ways[i].shading};
        struct measured turning, still;
        lam_device *device = lam_device_gl(&of, &error); // each with nothing sent yet
        if (device && i == 0)
            printf("%s, %d×%d pixels, 1 sample, the minimum of %d frames each, on %s\n\n"
                   "| lit in the | first frame | each frame | lighting | upload | draw | read | turning | "
                   "standing still |\n"
                   "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
                   name, size, size, frames, lam_device_name(device));
        ok = device && measure(device, scene, &camera, &params, &image, frames, 0.05, &turning, &error) &&
             measure(device, scene, &camera, &params, &image, frames, 0, &still, &error);
        if (ok)
            printf("| %s | %.2f MB | %" PRIu64
                   " bytes | %.2f ms | %.2f ms | %.2f ms | %.2f ms | %.2f ms | %.2f ms, %" PRIu64 " bytes |\n",
                   ways[i].name, (double)turning.first_bytes / 1e6, turning.bytes, turning.lighting, turning.upload,
                   turning.draw, turning.read, turning.total, still.total, still.bytes);
        lam_device_free(device);
    }
    if (!ok)
        fprintf(stderr, "turning: %s\n", error.text);
    lam_image_free(&image);
    lam_scene_free(scene);
    return ok ? 0 : error.code;
}
