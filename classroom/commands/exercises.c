// exercises.c: the command `exercises`: writes exercises for a class. Each exercise is a shader in the lecture style with
// a known mistake, every third with two, and its picture beside the right one. A page for students, and a key for the teacher, list them.
#include "commands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/check.h>
#include <lambent/gl.h>
#include <lambent/lambent.h>
#include <lambent/shader.h>
#include <lambent/words.h>

#include "console.h"
#include "drawing.h"
#include "failure.h"
#include "file_io.h"
#include "foreign.h"
#include "output.h"
#include "writer.h"

// SIDE: the size of a picture. A mistake is visible if at least VISIBLE of the pixels differ by more than 2/255.
enum { SIDE = 256, GAP = 16, INK = 0x222222, MISTAKES_MAX = 128 };
#define VISIBLE 0.02

static const char *const shapes[] = {"sphere", "torus", "torus-knot", "gyroid", "metaballs"};
// Every light reaches the shapes from the side, so that a part of each shape is unlit.
static const char *const lights[] = {
    "point:position=2r/1.5r/1r,attenuation=0.3/0.1r/0.15r,ambient=0.2",
    "directional:direction=-2/-1/-0.5,ambient=0.15",
    "spot:position=1.5r/2r/2r,cutoff=22,exponent=6,attenuation=0.3/0.1r/0.1r,ambient=0.2",
};
static const char *const paints[] = {"ambient=0.3/0.12/0.08,diffuse=0.75/0.3/0.2,specular=0.5,shininess=20",
                                     "ambient=0.1/0.2/0.3,diffuse=0.25/0.5/0.75,specular=0.5,shininess=12",
                                     "ambient=0.15/0.25/0.1,diffuse=0.4/0.7/0.3,specular=0.4,shininess=30"};
enum { SHAPES = 5, LIGHTS = 3, PAINTS = 3, SCENES = SHAPES * LIGHTS * PAINTS };

struct exercise {
    char name[32];
    const char *mistakes[2]; // the second is NULL if the exercise contains one mistake
    char both[128];          // the mistakes as of --mistake
    lam_scene *scene;
    lam_camera camera;
    double visible; // the share of the pixels that show a mistake, the least of both
};

// A linear congruential generator (Knuth, MMIX), so that a seed gives the same exercises everywhere.
static unsigned pick(uint64_t *seed, unsigned count)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(*seed >> 33) % count;
}

static bool make_scene(struct exercise *e, unsigned choice, lam_error *error)
{
    lam_material paint = lam_material_default();
    lam_object object = lam_object_default();
    e->scene = lam_scene_make(error);
    object.mesh = e->scene ? lam_scene_add_shape(e->scene, shapes[choice % SHAPES],
                                                 &(lam_shape_params){.slices = 48, .stacks = 24}, error)
                           : -1;
    if (object.mesh < 0 || lam_scene_add_object(e->scene, &object, error) < 0 ||
        lam_scene_add_light_text(e->scene, lights[choice / SHAPES % LIGHTS], NULL, error) < 0 ||
        !lam_material_parse(paints[choice / SHAPES / LIGHTS], LAM_COLOR_SRGB, &paint, error) ||
        !lam_scene_set_default_material(e->scene, &paint, error))
        return false;
    e->camera = lam_camera_fit(e->scene, SIDE, SIDE, NULL);
    return true;
}

static const lam_draw_params draw_params = {.background = {1, 1, 1, 1}, .tone = LAM_TONE_NONE};

static bool draw(const struct exercise *e, const char *mistake, lam_image *image, lam_error *error)
{
    lam_device *device = lam_device_gl(&(lam_gl_params){.lecture = true, .mistake = mistake}, error);
    bool ok = device && lam_image_make(image, SIDE, SIDE, LAM_RGBA8, error);
    if (ok && !lam_draw(device, e->scene, &e->camera, &draw_params, image, NULL, error)) {
        lam_image_free(image);
        ok = false;
    }
    lam_device_free(device);
    return ok;
}

static double difference(const lam_image *a, const lam_image *b)
{
    const uint8_t *p = a->pixels, *q = b->pixels;
    int count = 0;
    for (int i = 0; i < SIDE * SIDE; i++, p += 4, q += 4)
        count += abs(p[0] - q[0]) > 2 || abs(p[1] - q[1]) > 2 || abs(p[2] - q[2]) > 2;
    return (double)count / (SIDE * SIDE);
}

// Draws the wrong and the right picture side by side.
static bool save_pictures(const lam_image pictures[2], const char *path, const struct options *o, lam_error *error)
{
    static const char *const titles[] = {"the program's picture", "the right picture"};
    struct drawing d;
    if (!drawing_open(&d, 2 * SIDE + 3 * GAP, SIDE + 2 * GAP + 24, false, !o->captions.no_captions, o->captions.font,
                      error))
        return false;
    bool ok = true;
    for (int i = 0; ok && i < 2; i++) {
        int left = GAP + i * (SIDE + GAP);
        draw_text(&d, (struct point){left, GAP + 10}, 14, ALIGN_LEFT, INK, titles[i]);
        ok = draw_image(&d, &pictures[i], left, GAP + 24, titles[i], error);
    }
    ok = ok && drawing_write(&d, path, error);
    drawing_free(&d);
    return ok;
}

static bool save_text(const char *path, const char *text, lam_error *error)
{
    return writer_save(path, &(lam_bytes){(void *)(uintptr_t)text, strlen(text)}, false, error);
}

static bool save_exercise(const struct exercise *e, const lam_shader *shader, const lam_image pictures[2],
                          const struct options *o, lam_error *error)
{
    static const char *const endings[] = {".vert", ".frag", ".png"};
    char path[4096];
    bool ok = true;
    for (int i = 0; ok && i < 3; i++) {
        ok = snprintf(path, sizeof path, "%s/%s%s", o->picture.output, e->name, endings[i]) < (int)sizeof path ||
             complain(error, LAM_BAD_ARGUMENT, "the folder's name is too long");
        ok = ok && (i == 2 ? save_pictures(pictures, path, o, error)
                           : save_text(path, i ? shader->fragment : shader->vertex, error));
    }
    return ok;
}

// Sets `visible` to 0 if the check does not name exactly the mistakes.
static bool check_names(struct exercise *e, const lam_shader *shader, lam_error *error)
{
    lam_check_report report = {0};
    bool ok =
        lam_check_run(&(lam_check_params){.fragment = shader->fragment, .vertex = shader->vertex}, &report, error);
    int named = 0, wanted = e->mistakes[1] ? 2 : 1;
    for (int i = 0; ok && i < report.finding_count; i++)
        for (int k = 0; k < wanted; k++)
            named += strcmp(report.findings[i].mistake, e->mistakes[k]) == 0;
    e->visible = named == wanted && report.finding_count == wanted ? e->visible : 0;
    lam_check_report_free(&report);
    return ok;
}

// Draws the scene with the mistakes, without them and with one of two, and saves the exercise if each changes the picture
// of the other and the right picture, and the check names them.
static bool try_scene(struct exercise *e, const lam_shader *shader, const struct options *o, lam_error *error)
{
    const char *const drawn[] = {e->both, NULL, e->mistakes[0], e->mistakes[1]};
    lam_image pictures[4] = {{0}};
    int count = e->mistakes[1] ? 4 : 2, made = 0;
    while (made < count && draw(e, drawn[made], &pictures[made], error))
        made++;
    bool ok = made == count;
    e->visible = ok;
    for (int i = 1; ok && i < count; i++)
        for (int k = 0; k < 2; k++)
            e->visible = i == k ? e->visible : fmin(e->visible, difference(&pictures[k], &pictures[i]));
    ok = ok && (e->visible < VISIBLE || check_names(e, shader, error));
    ok = ok && (e->visible < VISIBLE || save_exercise(e, shader, pictures, o, error));
    while (made > 0)
        lam_image_free(&pictures[--made]);
    return ok;
}

// Makes an exercise with the mistakes, in the first scene from `first` on that shows them. Sets `visible` to 0 if
// none of several scenes does.
static bool make_exercise(struct exercise *e, unsigned first, const struct options *o, lam_error *error)
{
    enum { TRIES = 4 };
    bool ok = true;
    e->visible = 0;
    for (unsigned i = 0, tries = 0; ok && i < SCENES && tries < TRIES && e->visible < VISIBLE; i++) {
        lam_shader_params params = {.style = LAM_SHADER_STYLE_LECTURE, .mistake = e->both};
        lam_error unsupported;
        ok = make_scene(e, (first + 7 * i) % SCENES, error);
        lam_shader *shader =
            ok ? lam_shader_make(e->scene, &e->camera, &draw_params, SIDE, SIDE, -1, &params, &unsupported) : NULL;
        if (shader) {
            tries++;
            ok = try_scene(e, shader, o, error);
        }
        lam_shader_free(shader);
        lam_scene_free(e->scene);
    }
    return ok;
}

// --- the pages

static const char *explanation_of(const char *mistake)
{
    int i = 0;
    while (lam_check_mistake(i) && strcmp(lam_check_mistake(i), mistake) != 0)
        i++;
    return lam_check_mistake(i) ? lam_check_mistake_explanation(i) : "";
}

static bool save_page(const char *name, const struct exercise *list, int count, bool key, const struct options *o,
                      lam_error *error)
{
    char path[4096], *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return complain(error, LAM_MACHINE, "out of memory");
    const char *title = o->captions.title ? o->captions.title : "Find the mistake";
    fputs("<!doctype html>\n<meta charset=\"utf-8\">\n<title>", file);
    html_text(file, FOREIGN(title));
    fputs("</title>\n<style>body{font:16px sans-serif;max-width:48em;margin:2em auto}img{max-width:100%}</style>\n<h1>",
          file);
    html_text(file, FOREIGN(title));
    fprintf(file, "%s</h1>\n", key ? ": key" : "");
    if (!key)
        fputs("<p>Each program contains one or two mistakes. Find the lines, explain what they do, and correct "
              "them.</p>\n",
              file);
    for (int i = 0; i < count; i++) {
        fprintf(file, "<h2>%s</h2>\n<p><img src=\"%s.png\" alt=\"the program's picture, and the right picture\"></p>\n",
                list[i].name, list[i].name);
        for (int k = 0; key && k < 2 && list[i].mistakes[k]; k++)
            fprintf(file, "<p><b>%s</b>: %s.</p>\n", list[i].mistakes[k], explanation_of(list[i].mistakes[k]));
        if (key)
            fprintf(file, "<p>Visible in %.0f %% of the pixels.</p>\n", 100 * list[i].visible);
        else
            fprintf(file, "<p><a href=\"%s.vert\">vertex shader</a>, <a href=\"%s.frag\">fragment shader</a></p>\n",
                    list[i].name, list[i].name);
    }
    bool ok = fclose(file) == 0 || complain(error, LAM_MACHINE, "out of memory");
    snprintf(path, sizeof path, "%s/%s", o->picture.output, name);
    ok = ok && save_text(path, text, error);
    free(text);
    return ok;
}

// Mistakes that differ from the reference only in the highlight's model are no mistakes for a course that teaches the
// other model.
static int list_mistakes(uint64_t *seed, const char *mistakes[MISTAKES_MAX])
{
    lam_shader_mistake row;
    int count = 0;
    for (int i = 0; count < MISTAKES_MAX && lam_shader_mistake_row(i, &row); i++)
        if (!strstr(row.id, "-lobe"))
            mistakes[count++] = row.id;
    for (int i = count - 1; i > 0; i--) { // Fisher and Yates
        unsigned k = pick(seed, (unsigned)i + 1);
        const char *other = mistakes[k];
        mistakes[k] = mistakes[i];
        mistakes[i] = other;
    }
    return count;
}

int run_exercises(int operand_count, char **operands, const struct options *o)
{
    (void)operand_count, (void)operands;
    const char *mistakes[MISTAKES_MAX];
    uint64_t seed = (uint64_t)o->exercises.seed;
    lam_error error = {0};
    int available = list_mistakes(&seed, mistakes), made = 0, next = 0;
    struct exercise *list = calloc((size_t)o->exercises.count, sizeof *list);
    bool ok = (list || complain(&error, LAM_MACHINE, "out of memory")) &&
              (o->picture.output || complain(&error, LAM_BAD_ARGUMENT, "exercises: expected a folder: -o class/")) &&
              output_make_folder(o->picture.output, &error);
    for (; ok && made < o->exercises.count && (next < available || made); next++) {
        struct exercise *e = &list[made];
        e->mistakes[0] = mistakes[next % available];
        e->mistakes[1] = made % 3 == 2 ? mistakes[(next + 1 + pick(&seed, (unsigned)available - 1)) % available] : NULL;
        snprintf(e->both, sizeof e->both, "%s%s%s", e->mistakes[0], e->mistakes[1] ? "+" : "",
                 e->mistakes[1] ? e->mistakes[1] : "");
        snprintf(e->name, sizeof e->name, "exercise-%02d", made + 1);
        ok = make_exercise(e, pick(&seed, SCENES), o, &error);
        made += e->visible >= VISIBLE;
    }
    ok = ok && (made || complain(&error, LAM_UNSUPPORTED, "no scene shows a mistake")) &&
         save_page("students.html", list, made, false, o, &error) && save_page("key.html", list, made, true, o, &error);
    for (int i = 0; ok && !o->report.quiet && i < made; i++)
        printf("%s  %s\n", list[i].name, list[i].both);
    free(list);
    return ok ? 0 : report_failure(&error, o);
}
