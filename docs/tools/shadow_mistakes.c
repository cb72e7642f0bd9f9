// shadow_mistakes.c: draws the pictures of docs/lighting/left-out.md: what goes wrong with shadows and occlusion.
//
//   shadow-mistakes SCENE FOLDER     SCENE is examples/shadows.json; writes FOLDER/mistake-NAME.png: the mistake on the
//                                    left, the correct picture on the right
//
// The library has no shadow maps, so one is made here of its pictures: the distances that the light sees are compared
// with those of the points that the eye sees. The terms of the light are the library's own; they are put together rightly
// and wrongly.
#include <lambent/lambent.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 360, HEIGHT = 270, FINE = 2, MAP = 384, GAP = 8 };
static const double map_half = 4.5; // of the light's view, world units

enum mistake { ACNE, FLOATING, BLACK, DIRECT, MISTAKES };
static const char *const names[MISTAKES] = {"shadow-acne", "shadow-floating", "shadow-black", "occlusion-direct"};

// The terms of the picture, as floats; those of the direct light without and with shadows.
struct terms {
    lam_image depth, picture, ambient, bare[2], shadowed[2], occlusion;
};

struct study {
    const lam_scene *scene;
    lam_device *device;
    lam_camera camera, light;
    struct terms terms;
    lam_image map; // distances from the light
};

static bool draw(const struct study *s, const lam_camera *camera, lam_output output, bool shadows, int width,
                 int height, lam_image *image, lam_error *error)
{
    lam_draw_params params = {.output = output,
                              .shadows = shadows,
                              .samples = 1,
                              .occlusion =
                                  output == LAM_OUTPUT_AMBIENT_OCCLUSION ? LAM_OCCLUSION_SCREEN : LAM_OCCLUSION_OFF,
                              .occlusion_radius = 0.25f};
    return lam_image_make(image, width, height, LAM_RGBA32F, error) &&
           lam_draw(s->device, s->scene, camera, &params, image, NULL, error);
}

static bool draw_terms(struct study *s, lam_error *error)
{
    struct terms *t = &s->terms;
    const int w = WIDTH * FINE, h = HEIGHT * FINE;
    const lam_camera *c = &s->camera;
    return draw(s, c, LAM_OUTPUT_DEPTH, false, w, h, &t->depth, error) &&
           draw(s, c, LAM_OUTPUT_PICTURE, true, w, h, &t->picture, error) &&
           draw(s, c, LAM_OUTPUT_AMBIENT, false, w, h, &t->ambient, error) &&
           draw(s, c, LAM_OUTPUT_DIFFUSE, false, w, h, &t->bare[0], error) &&
           draw(s, c, LAM_OUTPUT_SPECULAR, false, w, h, &t->bare[1], error) &&
           draw(s, c, LAM_OUTPUT_DIFFUSE, true, w, h, &t->shadowed[0], error) &&
           draw(s, c, LAM_OUTPUT_SPECULAR, true, w, h, &t->shadowed[1], error) &&
           draw(s, c, LAM_OUTPUT_AMBIENT_OCCLUSION, false, w, h, &t->occlusion, error) &&
           draw(s, &s->light, LAM_OUTPUT_DEPTH, false, MAP, MAP, &s->map, error);
}

static void free_all(struct study *s)
{
    struct terms *t = &s->terms;
    lam_image *images[] = {&t->depth,       &t->picture,     &t->ambient,   &t->bare[0], &t->bare[1],
                           &t->shadowed[0], &t->shadowed[1], &t->occlusion, &s->map};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++)
        lam_image_free(images[i]);
    lam_device_free(s->device);
}

static const float *at(const lam_image *image, int x, int y)
{
    return (const float *)image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static lam_vec3 apply(const lam_mat4 *m, lam_vec3 p)
{
    return (lam_vec3){m->m[0][0] * p.x + m->m[0][1] * p.y + m->m[0][2] * p.z + m->m[0][3],
                      m->m[1][0] * p.x + m->m[1][1] * p.y + m->m[1][2] * p.z + m->m[1][3],
                      m->m[2][0] * p.x + m->m[2][1] * p.y + m->m[2][2] * p.z + m->m[2][3]};
}

// The point that a pixel shows.
static lam_vec3 point_of(const struct study *s, int x, int y)
{
    const lam_mat4 view = lam_camera_view_matrix(&s->camera);
    const int w = WIDTH * FINE, h = HEIGHT * FINE;
    const double depth = (double)at(&s->terms.depth, x, y)[0], t = tan(s->camera.fovy_rad / 2);
    const double e[3] = {((x + 0.5) / w * 2 - 1) * t * w / h * depth, (1 - (y + 0.5) / h * 2) * t * depth, -depth};
    double p[3];
    for (int i = 0; i < 3; i++) { // the view's rotation is transposed
        p[i] = i == 0 ? s->camera.eye.x : i == 1 ? s->camera.eye.y : s->camera.eye.z;
        for (int k = 0; k < 3; k++)
            p[i] += view.m[k][i] * e[k];
    }
    return (lam_vec3){p[0], p[1], p[2]};
}

// A shadow map's answer: whether the light sees something that is nearer by more than `bias`.
static bool in_map_shadow(const struct study *s, int x, int y, double bias)
{
    const lam_mat4 view = lam_camera_view_matrix(&s->light);
    const lam_vec3 p = apply(&view, point_of(s, x, y));
    const int i = (int)floor((p.x / map_half + 1) / 2 * MAP), k = (int)floor((1 - p.y / map_half) / 2 * MAP);
    if (i < 0 || k < 0 || i >= MAP || k >= MAP || at(&s->map, i, k)[3] == 0)
        return false;
    return (double)at(&s->map, i, k)[0] < -p.z - bias;
}

// A pixel's colour with a mistake, linear.
static double channel_of(const struct study *s, enum mistake mistake, int x, int y, int c)
{
    const struct terms *t = &s->terms;
    const double ambient = (double)at(&t->ambient, x, y)[c];
    const double bare = (double)at(&t->bare[0], x, y)[c] + (double)at(&t->bare[1], x, y)[c];
    const double shadowed = (double)at(&t->shadowed[0], x, y)[c] + (double)at(&t->shadowed[1], x, y)[c];
    const double a = (double)at(&t->occlusion, x, y)[0];
    switch (mistake) {
    case ACNE:
        return ambient + (in_map_shadow(s, x, y, 0) ? 0 : bare);
    case FLOATING:
        return ambient + (in_map_shadow(s, x, y, 0.45) ? 0 : bare);
    case BLACK: // the shadow takes everything
        return bare > 0 && shadowed < 0.5 * bare ? 0 : ambient + bare;
    case DIRECT: // occlusion takes from everything
        return (2 * ambient + shadowed) * a * a;
    default: // the picture; beside DIRECT: occlusion takes from the ambient light
        return mistake == MISTAKES ? ambient + shadowed : 2 * ambient * a + shadowed;
    }
}

static uint8_t encode(double x)
{
    x = x < 0 ? 0 : x > 1 ? 1 : x;
    return (uint8_t)(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055) + 0.5);
}

// Draws one half of a picture; pixels without the model are white.
static void draw_half(const struct study *s, enum mistake mistake, lam_image *out, int left)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < 3; c++) {
                double sum = 0;
                for (int k = 0; k < FINE * FINE; k++) {
                    const int fx = x * FINE + k % FINE, fy = y * FINE + k / FINE;
                    sum += at(&s->terms.picture, fx, fy)[3] > 0 ? channel_of(s, mistake, fx, fy, c) : 1;
                }
                ((uint8_t *)out->pixels)[4 * ((size_t)y * (size_t)out->width + (size_t)(left + x)) + (size_t)c] =
                    encode(sum / (FINE * FINE));
            }
}

static bool write_all(const struct study *s, const char *folder, lam_error *error)
{
    for (enum mistake mistake = 0; mistake < MISTAKES; mistake++) {
        lam_image image = {0};
        char path[512];
        snprintf(path, sizeof path, "%s/mistake-%s.png", folder, names[mistake]);
        if (!lam_image_make(&image, 2 * WIDTH + GAP, HEIGHT, LAM_RGBA8, error))
            return false;
        memset(image.pixels, 255, (size_t)image.width * HEIGHT * 4);
        draw_half(s, mistake, &image, 0);
        draw_half(s, mistake == DIRECT ? MISTAKES + 1 : MISTAKES, &image, WIDTH + GAP);
        const bool ok = lam_image_save(&image, path, NULL, error);
        lam_image_free(&image);
        if (!ok)
            return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: shadow-mistakes SCENE FOLDER\n");
        return 1;
    }
    lam_error error = {0};
    lam_scene *scene = lam_scene_load(argv[1], NULL, NULL, &error);
    struct study study = {.scene = scene, .device = lam_device_cpu(NULL, &error)};
    lam_picture_settings settings;
    bool ok = scene && study.device;
    if (ok && (!lam_scene_picture_settings(scene, &settings) || lam_scene_light_count(scene) != 1)) {
        snprintf(error.text, sizeof error.text, "%s: expected a scene file with one light", argv[1]);
        ok = false;
    }
    if (ok) {
        const lam_vec3 way = lam_scene_light(scene, 0)->direction;
        study.camera = settings.camera;
        study.light =
            (lam_camera){.eye = {-8 * way.x, -8 * way.y, -8 * way.z}, .up = {0, 1, 0}, .ortho_half_height = map_half};
        ok = draw_terms(&study, &error) && write_all(&study, argv[2], &error);
    }
    free_all(&study);
    lam_scene_free(scene);
    if (!ok)
        fprintf(stderr, "shadow-mistakes: %s\n", error.text);
    return ok ? 0 : 1;
}
