// test_fixed_function.c: compares scene files with "gl1" with OpenGL's fixed-function lighting (glLight, glMaterial,
// glLightModel) of the same triangles, as linear floats.
#include "card.h"
#include "context.h"

#include <lambent/lambent.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { W = 128, H = 96, AROUND = 20, ALONG = 12, ROW = AROUND + 1, CORNERS = ROW * (ALONG + 1) };

// --- the functions of OpenGL 1

#define CLASSIC_FUNCTIONS(X)                                                                                           \
    X(Begin)                                                                                                           \
    X(End)                                                                                                             \
    X(Normal3f)                                                                                                        \
    X(Vertex3f)                                                                                                        \
    X(Lightfv)                                                                                                         \
    X(Lightf)                                                                                                          \
    X(LightModelfv)                                                                                                    \
    X(LightModeli)                                                                                                     \
    X(Materialfv)                                                                                                      \
    X(Materialf)                                                                                                       \
    X(MatrixMode)                                                                                                      \
    X(LoadMatrixd)                                                                                                     \
    X(MultMatrixd)                                                                                                     \
    X(ShadeModel)                                                                                                      \
    X(FrontFace)                                                                                                       \
    X(Enable)                                                                                                          \
    X(Disable)                                                                                                         \
    X(Clear)                                                                                                           \
    X(ClearColor)                                                                                                      \
    X(Viewport)                                                                                                        \
    X(ReadPixels)                                                                                                      \
    X(GetError)                                                                                                        \
    X(GenFramebuffers)                                                                                                 \
    X(BindFramebuffer)                                                                                                 \
    X(FramebufferRenderbuffer)                                                                                         \
    X(CheckFramebufferStatus)                                                                                          \
    X(GenRenderbuffers)                                                                                                \
    X(BindRenderbuffer)                                                                                                \
    X(RenderbufferStorage)

struct classic {
#define FIELD(name) __typeof__(&gl##name) name;
    CLASSIC_FUNCTIONS(FIELD)
#undef FIELD
    bool card;
};

static void classic_load(struct classic *gl, const struct gl_context *context)
{
#define FIND(name) assert_non_null(gl->name = (__typeof__(gl->name))context->egl.GetProcAddress("gl" #name));
    CLASSIC_FUNCTIONS(FIND)
#undef FIND
}

// --- a case

struct light {
    const char *frame;               // "world", "camera"
    float position[4], direction[3]; // w = 0: towards the light
    float ambient[3], diffuse[3], specular[3];
    float attenuation[3], cutoff, exponent; // cutoff 180: not a spot
};

struct classic_case {
    const char *name;
    bool flat, infinite, two_sided;
    double turn, scale[3], move[3]; // M = translate · rotate about y · scale
    float shininess;
    struct light lights[3];
    int count;
};

static const double eye[3] = {0.4, 1.1, 4.2}, target[3] = {0.1, 0, 0}, fovy = 38, near = 0.5, far = 50;
static const float global[4] = {0.1F, 0.2F, 0.15F, 1};
static const float front[4][4] = {
    {0.3F, 0.2F, 0.25F, 1}, {0.7F, 0.5F, 0.2F, 1}, {0.6F, 0.7F, 0.8F, 1}, {0.02F, 0.01F, 0.03F, 1}};
static const float back[4][4] = {{0.1F, 0.2F, 0.4F, 1}, {0.1F, 0.3F, 0.9F, 1}, {0.9F, 0.2F, 0.1F, 1}, {0, 0.05F, 0, 1}};

// --- the mesh: an open piece of a sphere, so that both sides are visible

static float corners[CORNERS][3]; // positions, which are also the normals
static unsigned indices[AROUND * ALONG * 2][3];
static char ply[CORNERS * 110 + AROUND * ALONG * 2 * 24 + 400];

static void make_mesh(void)
{
    char *at = ply;
    at += sprintf(at,
                  "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                  "property float nx\nproperty float ny\nproperty float nz\nelement face %d\n"
                  "property list uchar int vertex_indices\nend_header\n",
                  CORNERS, AROUND * ALONG * 2);
    for (int i = 0; i < CORNERS; i++) {
        double theta = 0.4 + 2.2 * (i / ROW) / ALONG, phi = 4.4 * (i % ROW) / AROUND;
        float *c = corners[i];
        c[0] = (float)(sin(theta) * cos(phi));
        c[1] = (float)cos(theta);
        c[2] = (float)(-sin(theta) * sin(phi));
        for (int k = 0; k < 6; k++)
            at += sprintf(at, "%.9g%c", (double)c[k % 3], k < 5 ? ' ' : '\n');
    }
    for (int i = 0; i < AROUND * ALONG; i++) {
        unsigned a = (unsigned)(i / AROUND * ROW + i % AROUND), b = a + ROW;
        const unsigned two[6] = {a, b, b + 1, a, b + 1, a + 1};
        memcpy(indices[2 * i], two, sizeof two);
        at += sprintf(at, "3 %u %u %u\n3 %u %u %u\n", two[0], two[1], two[2], two[3], two[4], two[5]);
    }
}

static bool open_mesh(void *user, const char *name, lam_bytes *bytes, lam_error *error)
{
    (void)user, (void)name, (void)error;
    bytes->size = strlen(ply);
    bytes->data = malloc(bytes->size);
    memcpy(bytes->data, ply, bytes->size);
    return true;
}

// --- Lambent's picture

static char *write_material(char *at, const char *key, const float m[4][4], float shininess)
{
    static const char *const names[4] = {"ambient", "diffuse", "specular", "emission"};
    at += sprintf(at, "\"%s\": {\"shininess\": %.9g", key, (double)shininess);
    for (int i = 0; i < 4; i++)
        at += sprintf(at, ", \"%s\": [%.9g, %.9g, %.9g]", names[i], (double)m[i][0], (double)m[i][1], (double)m[i][2]);
    return at + sprintf(at, "}, ");
}

static char *write_three(char *at, const char *key, const float *v)
{
    return at + sprintf(at, ", \"%s\": [%.9g, %.9g, %.9g]", key, (double)v[0], (double)v[1], (double)v[2]);
}

static char *write_light(char *at, const struct light *l)
{
    const float *p = l->position;
    at += sprintf(at, "{\"type\": \"%s\", \"frame\": \"%s\", \"position\": [%.9g, %.9g, %.9g, %.9g]",
                  p[3] == 0         ? "directional"
                  : l->cutoff < 180 ? "spot"
                                    : "point",
                  l->frame, (double)p[0], (double)p[1], (double)p[2], (double)p[3]);
    if (p[3] != 0)
        at = write_three(at, "attenuation", l->attenuation);
    if (l->cutoff < 180) {
        at = write_three(at, "direction", l->direction);
        at += sprintf(at, ", \"cutoff\": %.9g, \"exponent\": %.9g", (double)l->cutoff, (double)l->exponent);
    }
    at = write_three(at, "ambient", l->ambient);
    at = write_three(at, "diffuse", l->diffuse);
    at = write_three(at, "specular", l->specular);
    return at + sprintf(at, "}");
}

static void draw_lambent(const struct classic_case *k, lam_image *image, lam_image *facing)
{
    static char text[8192];
    char *at = text;
    at += sprintf(at,
                  "{\"lambent\": 1, \"image\": {\"size\": [%d, %d], \"samples\": 1, \"color\": \"raw\"}, \"camera\": "
                  "{\"eye\": [%.17g, %.17g, %.17g], \"target\": [%.17g, %.17g, %.17g], \"fovy\": %.17g, \"near\": "
                  "%.17g, \"far\": %.17g}, \"ambient\": [%.9g, %.9g, %.9g], \"gl1\": true, \"reflection\": "
                  "\"blinn-phong\", \"shading\": \"%s\", \"flat_normal\": \"vertex\", \"viewer\": \"%s\", \"objects\": "
                  "[{\"file\": \"m.ply\", \"two_sided\": %s, ",
                  W, H, eye[0], eye[1], eye[2], target[0], target[1], target[2], fovy, near, far, (double)global[0],
                  (double)global[1], (double)global[2], k->flat ? "flat" : "gouraud",
                  k->infinite ? "infinite" : "local", k->two_sided ? "true" : "false");
    at = write_material(at, "material", front, k->shininess);
    at = write_material(at, "back_material", back, k->shininess);
    at += sprintf(at,
                  "\"transform\": [[\"translate\", %.17g, %.17g, %.17g], [\"rotate\", %.17g, 0, 1, 0], [\"scale\", "
                  "%.17g, %.17g, %.17g]]}], \"lights\": [",
                  k->move[0], k->move[1], k->move[2], k->turn, k->scale[0], k->scale[1], k->scale[2]);
    for (int i = 0; i < k->count; i++)
        at = write_light(i ? at + sprintf(at, ", ") : at, &k->lights[i]);
    sprintf(at, "]}");
    lam_load_params params = {.threads = 1, .open = open_mesh};
    lam_error error = {0};
    lam_picture_settings settings;
    lam_scene *scene = lam_scene_load_memory(text, strlen(text), "s.json", &params, NULL, &error);
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, &error);
    if (!scene || !device)
        fail_msg("%s: %s", k->name, error.text);
    assert_true(lam_scene_picture_settings(scene, &settings));
    lam_image *const images[2] = {image, facing};
    for (int i = 0; i < 2; i++) {
        settings.draw.output = i ? LAM_OUTPUT_FACING : LAM_OUTPUT_PICTURE;
        assert_true(lam_image_make(images[i], W, H, LAM_RGBA32F, &error));
        if (!lam_draw(device, scene, &settings.camera, &settings.draw, images[i], NULL, &error))
            fail_msg("%s: %s", k->name, error.text);
    }
    lam_device_free(device);
    lam_scene_free(scene);
}

// --- OpenGL's picture

static void unit(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static void cross(const double a[3], const double b[3], double to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

// The matrices of gluLookAt and gluPerspective, by columns.
static void look_at(double m[16])
{
    double z[3] = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]}, x[3], y[3];
    unit(z);
    cross((double[3]){0, 1, 0}, z, x);
    unit(x);
    cross(z, x, y);
    const double *rows[3] = {x, y, z};
    memset(m, 0, 16 * sizeof *m);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m[4 * j + i] = rows[i][j];
            m[12 + i] -= rows[i][j] * eye[j];
        }
    }
    m[15] = 1;
}

static void perspective(double m[16])
{
    double f = 1 / tan(fovy * 3.14159265358979323846 / 360);
    memset(m, 0, 16 * sizeof *m);
    m[0] = f * H / W;
    m[5] = f;
    m[10] = (far + near) / (near - far);
    m[11] = -1;
    m[14] = 2 * far * near / (near - far);
}

static void set_light(const struct classic *gl, GLenum name, const struct light *l, const double view[16])
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    gl->LoadMatrixd(strcmp(l->frame, "camera") == 0 ? identity : view);
    gl->Lightfv(name, GL_POSITION, l->position);
    gl->Lightfv(name, GL_SPOT_DIRECTION, l->direction);
    gl->Lightfv(name, GL_AMBIENT, (float[4]){l->ambient[0], l->ambient[1], l->ambient[2], 1});
    gl->Lightfv(name, GL_DIFFUSE, (float[4]){l->diffuse[0], l->diffuse[1], l->diffuse[2], 1});
    gl->Lightfv(name, GL_SPECULAR, (float[4]){l->specular[0], l->specular[1], l->specular[2], 1});
    gl->Lightf(name, GL_CONSTANT_ATTENUATION, l->attenuation[0]);
    gl->Lightf(name, GL_LINEAR_ATTENUATION, l->attenuation[1]);
    gl->Lightf(name, GL_QUADRATIC_ATTENUATION, l->attenuation[2]);
    gl->Lightf(name, GL_SPOT_CUTOFF, l->cutoff);
    gl->Lightf(name, GL_SPOT_EXPONENT, l->exponent);
    gl->Enable(name);
}

static void draw_classic(const struct classic *gl, const struct classic_case *k, float *pixels)
{
    double view[16], lens[16], c = cos(k->turn * 3.14159265358979323846 / 180),
                               s = sin(k->turn * 3.14159265358979323846 / 180);
    const double *z = k->scale;
    const double model[16] = {c * z[0], 0, -s * z[0], 0, 0,          z[1],       0,          0,
                              s * z[2], 0, c * z[2],  0, k->move[0], k->move[1], k->move[2], 1};
    look_at(view);
    perspective(lens);
    gl->ClearColor(0, 0, 0, 0);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_LIGHTING);
    gl->Enable(GL_NORMALIZE);
    gl->ShadeModel(k->flat ? GL_FLAT : GL_SMOOTH);
    gl->FrontFace(z[0] * z[1] * z[2] < 0 ? GL_CW : GL_CCW);
    gl->LightModelfv(GL_LIGHT_MODEL_AMBIENT, global);
    gl->LightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, !k->infinite);
    gl->LightModeli(GL_LIGHT_MODEL_TWO_SIDE, k->two_sided);
    static const GLenum names[4] = {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION};
    for (int i = 0; i < 4; i++) {
        gl->Materialfv(GL_FRONT, names[i], front[i]);
        gl->Materialfv(GL_BACK, names[i], back[i]);
    }
    gl->Materialf(GL_FRONT_AND_BACK, GL_SHININESS, k->shininess);
    gl->MatrixMode(GL_PROJECTION);
    gl->LoadMatrixd(lens);
    gl->MatrixMode(GL_MODELVIEW);
    for (int i = 0; i < 3; i++)
        gl->Disable(GL_LIGHT0 + (GLenum)i);
    for (int i = 0; i < k->count; i++)
        set_light(gl, GL_LIGHT0 + (GLenum)i, &k->lights[i], view);
    gl->LoadMatrixd(view);
    gl->MultMatrixd(model);
    gl->Begin(GL_TRIANGLES);
    for (int t = 0; t < AROUND * ALONG * 2; t++)
        for (int i = 0; i < 3; i++) {
            const float *p = corners[indices[t][i]];
            gl->Normal3f(p[0], p[1], p[2]);
            gl->Vertex3f(p[0], p[1], p[2]);
        }
    gl->End();
    gl->ReadPixels(0, 0, W, H, GL_RGBA, GL_FLOAT, pixels);
    assert_int_equal(gl->GetError(), GL_NO_ERROR);
}

// --- the comparison

// Whether the pixel and its neighbours show the same side of the surface and, with flat shading, the same colour: flat
// colours jump at the edges of triangles.
static bool inside(const struct classic_case *k, const lam_image *image, const lam_image *facing, int x, int y)
{
    const float *side = facing->pixels, *color = image->pixels;
    int here = 4 * (y * W + x);
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++) {
            int there = 4 * (j * W + i);
            if (i < 0 || j < 0 || i >= W || j >= H || side[there] != side[here] || side[there] == 0 ||
                (k->flat && memcmp(color + there, color + here, 3 * sizeof *color) != 0))
                return false;
        }
    return true;
}

// Compares the two pictures. Returns the number of compared pixels that show the back of the surface.
static int compare(const struct classic *gl, const struct classic_case *k)
{
    static float pixels[H][W][4];
    lam_image image = {0}, facing = {0};
    draw_lambent(k, &image, &facing);
    draw_classic(gl, k, &pixels[0][0][0]);
    double largest = 0, total = 0;
    int counted = 0, back_pixels = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            if (!inside(k, &image, &facing, x, y))
                continue;
            const float *ours = (const float *)image.pixels + 4 * (y * W + x), *theirs = pixels[H - 1 - y][x];
            for (int c = 0; c < 3; c++) {
                double off = fabs((double)ours[c] - (double)theirs[c]);
                largest = off > largest ? off : largest;
                total += off;
            }
            counted++;
            back_pixels += ((const float *)facing.pixels)[4 * (y * W + x)] < 0;
        }
    print_message("%-32s %4d pixels, %4d of the back; largest difference %.2e, mean %.2e\n", k->name, counted,
                  back_pixels, largest, total / (3 * counted));
    assert_true(counted > 200);
    assert_true(largest <= (gl->card ? 5e-4 : 2e-4));
    assert_true(total / (3 * counted) <= (gl->card ? 2e-5 : 2e-6));
    lam_image_free(&image);
    lam_image_free(&facing);
    return back_pixels;
}

#define ONE         {1, 1, 1}
#define POINT_LIGHT {"world", {2, 3, 4, 1}, {0, 0, -1}, {0.1F, 0, 0.2F}, {0.8F, 0.7F, 0.6F}, ONE, {1, 0, 0}, 180, 0}
#define SUN         {"world", {1, 2, 1.5F, 0}, {0, 0, -1}, {0, 0.1F, 0}, {0.5F, 0.6F, 0.7F}, ONE, {1, 0, 0}, 180, 0}
#define FADING                                                                                                         \
    {"world", {1, 1.5F, 2, 1}, {0, 0, -1}, {0.3F, 0.2F, 0.2F}, ONE, {0.2F, 0.9F, 1}, {0.2F, 0.1F, 0.3F}, 180, 0}
#define SPOT   {"world", {0.5F, 2, 2.5F, 1}, {-0.2F, -0.9F, -1.1F}, {0.2F, 0.2F, 0}, ONE, ONE, {1, 0.1F, 0}, 30, 8}
#define TORCH  {"camera", {0.3F, 0.2F, 0, 1}, {0, 0, -1}, {0, 0, 0}, ONE, {0.5F, 0.5F, 0.5F}, {1, 0, 0.05F}, 90, 40}
#define EVENLY .scale = ONE, .shininess = 30

static void test_fixed_function(void **state)
{
    (void)state;
    static const struct classic_case cases[] = {
        {"point", EVENLY, .two_sided = true, .lights = {POINT_LIGHT}, .count = 1},
        {"point, infinite viewer", EVENLY, .infinite = true, .two_sided = true, .lights = {POINT_LIGHT}, .count = 1},
        {"directional", EVENLY, .turn = 60, .two_sided = true, .lights = {SUN}, .count = 1},
        {"directional, infinite viewer", EVENLY, .turn = 60, .infinite = true, .two_sided = true, .lights = {SUN},
         .count = 1},
        {"attenuated, with its ambient term", EVENLY, .two_sided = true, .lights = {FADING}, .count = 1},
        {"spot with an exponent", EVENLY, .two_sided = true, .lights = {SPOT}, .count = 1},
        {"torch of the camera", EVENLY, .turn = -40, .two_sided = true, .lights = {TORCH}, .count = 1},
        {"three lights, colours over 1", EVENLY, .turn = 20, .two_sided = true, .lights = {POINT_LIGHT, SUN, FADING},
         .count = 3},
        {"one-sided", EVENLY, .turn = 100, .two_sided = false, .lights = {POINT_LIGHT}, .count = 1},
        {"non-uniform scale", .turn = -50, .scale = {0.6, 1.3, 1.1}, .move = {0, 0.1, 0}, .shininess = 50,
         .two_sided = true, .lights = {POINT_LIGHT, TORCH}, .count = 2},
        {"mirrored", .turn = 20, .scale = {1, -1.2, 1}, .shininess = 10, .two_sided = true, .lights = {POINT_LIGHT},
         .count = 1},
        {"shininess 128", .turn = 20, .scale = ONE, .shininess = 128, .two_sided = true, .lights = {POINT_LIGHT, SUN},
         .count = 2},
        // Not 0, because Mesa has a special case that omits 0^0.
        {"shininess 0.01", .turn = 20, .scale = ONE, .shininess = 0.01F, .two_sided = true, .lights = {FADING},
         .count = 1},
        {"flat", EVENLY, .flat = true, .two_sided = true, .lights = {POINT_LIGHT, SPOT}, .count = 2},
    };
    struct gl_context context;
    struct gl_previous_context previous;
    struct classic gl;
    lam_error error = {0};
    if (!gl_context_make(&context, NULL, NULL, GL_PROFILE_COMPATIBILITY, false, &error)) {
        print_message("%s\n", error.text);
        skip();
    }
    print_message("%s: %s\n", context.renderer, context.driver);
    assert_true(gl_context_enter(&context, &previous, &error));
    classic_load(&gl, &context);
    gl.card = is_card(context.renderer);
    GLuint frame, color, depth;
    gl.GenFramebuffers(1, &frame);
    gl.BindFramebuffer(GL_FRAMEBUFFER, frame);
    gl.GenRenderbuffers(1, &color);
    gl.BindRenderbuffer(GL_RENDERBUFFER, color);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, W, H);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    gl.GenRenderbuffers(1, &depth);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, W, H);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    assert_int_equal(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl.Viewport(0, 0, W, H);
    make_mesh();
    int back_pixels = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        back_pixels += compare(&gl, &cases[i]);
    assert_true(back_pixels > 1000);
    gl_context_leave(&context, &previous);
    gl_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fixed_function)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
