// test_brute_force.c: compares pictures of traced paths (lam_draw_params.bounces) with an evaluator in double precision.
#include "test.h"
#include "brute_force.h"
#include "quad.h"
#include "share.h"

enum { FLOOR, WALL, LEFT, RIGHT, SOLID, PANEL, LAMP };
enum { BLOCK = 6, BLOCKS = SIZE / BLOCK }; // pixels of a block per side, blocks per side

// --- the room

static void add_board(struct world *w, vector corner, vector along, vector up, int material)
{
    assert_true(w->board_count < SURFACES);
    w->boards[w->board_count++] = (struct board){corner, along, up, material};
}

static void paint(struct world *w, int i, float r, float g, float b)
{
    w->paints[i] = (struct paint){.m = lam_material_default()};
    w->paints[i].m.specular = (lam_rgb){0, 0, 0};
    w->paints[i].m.diffuse = (lam_rgba){r, g, b, 1};
}

static lam_material *physical(struct world *w, int i, float roughness, float metallic)
{
    lam_material *m = &w->paints[i].m;
    m->physical = true;
    m->roughness = roughness;
    m->metallic = metallic;
    return m;
}

// A room that is open in front and above, with a block and a panel.
static void make_room(struct world *w)
{
    static const float colors[][3] = {{0.7f, 0.7f, 0.7f},  {0.6f, 0.6f, 0.5f}, {0.8f, 0.2f, 0.15f}, {0.2f, 0.6f, 0.25f},
                                      {0.5f, 0.55f, 0.8f}, {0.8f, 0.7f, 0.4f}, {0.1f, 0.1f, 0.1f}};
    *w = (struct world){.sky = 0.6, .bounces = 2, .random = 0x9e3779b97f4a7c15u};
    for (int i = 0; i < 7; i++)
        paint(w, i, colors[i][0], colors[i][1], colors[i][2]);
    vector x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    add_board(w, (vector){-2, 0, -2}, times(6, z), times(4, x), FLOOR);
    add_board(w, (vector){-2, 0, -2}, times(4, x), times(4, y), WALL);
    add_board(w, (vector){-2, 0, -2}, times(4, y), times(6, z), LEFT);
    add_board(w, (vector){2, 0, -2}, times(6, z), times(4, y), RIGHT);
    vector low = {-1.3, 0, -1.2}, side = {0.9, 0, 0.35}, deep = {-0.35, 0, 0.9}, high = {0, 1.3, 0};
    add_board(w, sum(low, deep), side, high, SOLID);
    add_board(w, sum(low, side), deep, high, SOLID);
    add_board(w, low, deep, high, SOLID);
    add_board(w, low, side, high, SOLID);
    add_board(w, sum(low, high), deep, side, SOLID);
    add_board(w, (vector){0.2, 0.1, 0.3}, (vector){1.1, 0, -0.5}, (vector){0.1, 1.4, -0.2}, PANEL);
    for (int i = 0; i < 3 * TEXELS * TEXELS; i++)
        for (int c = 0; c < 4; c++) {
            int at = i % (TEXELS * TEXELS), column = at % TEXELS, row = at / TEXELS;
            w->texels[i / (TEXELS * TEXELS)][at][c] =
                (uint8_t)(c == 3 ? 40 + 27 * ((column * 3 + row * 5) % 8) : 30 + (column + row) % 2 * 150 + 25 * c);
        }
}

// --- the same scene for the library

static lam_texture_map map_of(const uint8_t (*texels)[4], int channel)
{
    lam_error error;
    lam_image image = {0};
    assert_true(lam_image_make(&image, TEXELS, TEXELS, LAM_RGBA8, &error));
    memcpy(image.pixels, texels, TEXELS * TEXELS * 4);
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_NUMBERS, NULL, &error);
    assert_non_null(texture);
    lam_image_free(&image);
    return (lam_texture_map){.texture = texture,
                             .magnify = LAM_FILTER_NEAREST,
                             .minify = LAM_FILTER_NEAREST,
                             .mip = LAM_MIP_NONE,
                             .channel = channel};
}

static int add_paint(lam_scene *scene, const struct paint *p)
{
    lam_error error;
    lam_material m = p->m;
    lam_texture_map maps[4];
    const struct {
        lam_map map;
        int channel;
        const uint8_t (*texels)[4];
    } rows[4] = {{LAM_MAP_DIFFUSE, 0, p->color},
                 {LAM_MAP_ROUGHNESS, 1, p->rough},
                 {LAM_MAP_METALLIC, 2, p->rough},
                 {LAM_MAP_EMISSION, 0, p->glow}};
    for (int i = 0; i < 4; i++)
        if (rows[i].texels) {
            maps[i] = map_of(rows[i].texels, rows[i].channel);
            m.maps[rows[i].map] = &maps[i];
        }
    int material = lam_scene_add_material(scene, &m, &error);
    for (int i = 0; i < 4; i++)
        if (rows[i].texels)
            lam_texture_free((lam_texture *)(uintptr_t)maps[i].texture);
    if (material < 0)
        fail_msg("%s", error.text);
    return material;
}

static void put(float *out, vector a)
{
    out[0] = (float)a.x;
    out[1] = (float)a.y;
    out[2] = (float)a.z;
}

static void add_environment_to(const struct world *w, lam_scene *scene)
{
    lam_error error;
    AUTO_IMAGE image = {0};
    assert_true(lam_image_make(&image, 256, 128, LAM_RGBA32F, &error));
    for (int i = 0; i < 256 * 128; i++) {
        double light[3];
        sky_light(w, (vector){0, cos((i / 256 + 0.5) / 128 * PI), 0}, light);
        for (int c = 0; c < 4; c++)
            ((float *)image.pixels)[4 * i + c] = c < 3 ? (float)(light[c] - w->sky) : 1;
    }
    lam_environment *environment = lam_environment_from_image(&image, LAM_COLOR_SRGB, &error);
    SUCCEEDS(environment && lam_scene_set_environment(scene, environment, 0, &error));
    lam_environment_free(environment);
}

static lam_scene *scene_of(const struct world *w)
{
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    int materials[7];
    for (int i = 0; i < 7; i++)
        materials[i] = add_paint(scene, &w->paints[i]);
    for (int i = 0; i < w->board_count; i++) {
        const struct board *b = &w->boards[i];
        float positions[12], normals[12], texcoords[8] = {0, 0, 1, 0, 1, 1, 0, 1};
        const vector corners[4] = {b->corner, sum(b->corner, b->along), sum(sum(b->corner, b->along), b->up),
                                   sum(b->corner, b->up)};
        for (int k = 0; k < 4; k++) {
            put(positions + 3 * k, corners[k]);
            put(normals + 3 * k, unit(across(b->along, b->up)));
        }
        lam_object object = lam_object_default();
        const lam_mesh mesh = quad_mesh(positions, normals, texcoords, NULL, NULL);
        object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
        object.material = materials[b->material];
        SUCCEEDS(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    }
    for (int i = 0; i < w->lamp_count; i++)
        SUCCEEDS(lam_scene_add_light(scene, &w->lamps[i], &error) >= 0);
    lam_scene_set_ambient(scene, (lam_rgb){(float)w->sky, (float)w->sky, (float)w->sky});
    if (w->gradient > 0)
        add_environment_to(w, scene);
    return scene;
}

static lam_image draw(const struct world *w)
{
    lam_error error;
    lam_image image = {0};
    AUTO_SCENE scene = scene_of(w);
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    lam_camera camera = {
        .eye = {eye.x, eye.y, eye.z}, .target = {target.x, target.y, target.z}, .up = {0, 1, 0}, .fovy_rad = FOVY_RAD};
    lam_draw_params params = {.samples = 1,
                              .background = {0, 0, 0, 1},
                              .rig = LAM_RIG_NONE,
                              .reflection = LAM_REFLECTION_AUTO,
                              .bounces = w->bounces,
                              .paths = is_long() ? 4096 : 1024,
                              .denoise = LAM_DENOISE_OFF};
    assert_true(lam_image_make(&image, SIZE, SIZE, LAM_RGBA32F, &error));
    SUCCEEDS(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    return image;
}

// --- the comparison

struct sums {
    double light, square;
    long count;
};

static double mean_of(const struct sums *s) { return s->light / (double)s->count; }
static double error_of(const struct sums *s)
{
    return sqrt(fmax(s->square / (double)s->count - mean_of(s) * mean_of(s), 0) / (double)s->count);
}

enum { ROUND = 16, ROUNDS_MAX = 400 };
#define WANTED_ERROR (is_long() ? 0.0012 : 0.002) // of the mean

// Adds paths until the standard error of the mean is small.
static void evaluate(struct world *w, struct sums *whole, struct sums blocks[BLOCKS * BLOCKS])
{
    for (int round = 0; round < ROUNDS_MAX; round++) {
        for (int i = 0; i < SIZE * SIZE * ROUND; i++) {
            int x = i / ROUND % SIZE, y = i / ROUND / SIZE;
            double light[3] = {0};
            add_sample(w, x, y, light);
            double all = (light[0] + light[1] + light[2]) / 3;
            struct sums *const to[2] = {whole, &blocks[y / BLOCK * BLOCKS + x / BLOCK]};
            for (int k = 0; k < 2; k++) {
                to[k]->light += all;
                to[k]->square += all * all;
                to[k]->count++;
            }
        }
        if (round >= 7 && error_of(whole) < WANTED_ERROR * mean_of(whole))
            return;
    }
}

static void compare(const char *name, struct world *w)
{
    static struct sums blocks[BLOCKS * BLOCKS];
    struct sums whole = {0};
    double drawn[BLOCKS * BLOCKS] = {0}, total = 0;
    AUTO_IMAGE image = draw(w);
    memset(blocks, 0, sizeof blocks);
    evaluate(w, &whole, blocks);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float *pixel = (const float *)image.pixels + 4 * i;
        double light = ((double)pixel[0] + (double)pixel[1] + (double)pixel[2]) / 3;
        drawn[i / SIZE / BLOCK * BLOCKS + i % SIZE / BLOCK] += light / (BLOCK * BLOCK);
        total += light / (SIZE * SIZE);
    }
    double mean = mean_of(&whole), off = (total - mean) / mean;
    print_message("%-32s mean %.5f, Lambent %+.3f %%, standard error %.3f %%\n", name, mean, 100 * off,
                  100 * error_of(&whole) / mean);
    if (fabs(off) > 0.005)
        fail_msg("%s: the mean is %.6f, expected %.6f within 0.5 %%", name, total, mean);
    for (int i = 0; i < BLOCKS * BLOCKS; i++)
        if (fabs(drawn[i] - mean_of(&blocks[i])) > 5 * error_of(&blocks[i]) + 0.01 * mean_of(&blocks[i]))
            fail_msg("%s, block %d: the mean is %.5f, expected %.5f, standard error %.5f", name, i, drawn[i],
                     mean_of(&blocks[i]), error_of(&blocks[i]));
}

// --- the scenes

static void plain(struct world *w) { w->bounces = 4; }
static void one_bounce(struct world *w) { w->bounces = 1; }
static void textured(struct world *w)
{
    w->paints[FLOOR].color = w->paints[SOLID].color = w->texels[0];
    w->paints[FLOOR].m.alpha_mode = w->paints[SOLID].m.alpha_mode = LAM_ALPHA_OPAQUE;
}
static void ceiling(struct world *w)
{
    w->sky = 0;
    w->bounces = 3;
    w->paints[LAMP].m.emission = (lam_rgb){4, 3, 2};
    add_board(w, (vector){-1.5, 3, -1.5}, (vector){3, 0, 0}, (vector){0, 0, 3}, LAMP);
}
static void textured_glow(struct world *w)
{
    ceiling(w);
    w->paints[LAMP].glow = w->texels[0];
}
static lam_light *add_lamp(struct world *w, lam_light_type type, double x, double y, double z, float light)
{
    lam_light *lamp = &w->lamps[w->lamp_count++];
    *lamp = lam_light_default(type);
    lamp->position = (lam_vec3){x, y, z};
    lamp->diffuse = lamp->specular = (lam_rgb){light, 0.8f * light, 0.6f * light};
    lamp->attenuation = (lam_attenuation){0.1f, 0, 1};
    return lamp;
}
static void lamps(struct world *w)
{
    w->sky = 0.05;
    for (int i = 0; i < 12; i++)
        add_lamp(w, LAM_LIGHT_POINT, -1.7 + 0.3 * i, 1.8 + 0.1 * (i % 4), 2.5 - 0.35 * i, 0.4f);
}
static void spots(struct world *w)
{
    w->sky = 0.05;
    for (int i = 0; i < 100; i++) {
        lam_light *lamp = add_lamp(w, LAM_LIGHT_SPOT, -1.8 + 0.4 * (i % 10), 2.5, 2.2 - 0.42 * (i / 10), 0.5f);
        lamp->direction = (lam_vec3){0.2 * (i % 3 - 1), -1, 0.2 * (i % 5 - 2)};
        lamp->inner_rad = 0.1f;
        lamp->outer_rad = 0.3f;
    }
}
static void sun(struct world *w)
{
    add_lamp(w, LAM_LIGHT_DIRECTIONAL, 0, 0, 0, 1)->direction = (lam_vec3){0.4, -1, -0.6};
    w->sky = 0.2;
}
static void metal(struct world *w)
{
    physical(w, SOLID, 0.4f, 1);
    physical(w, PANEL, 0.5f, 1);
}
static void dielectric(struct world *w)
{
    physical(w, FLOOR, 0.4f, 0);
    physical(w, SOLID, 0.8f, 0);
}
static void textured_metal(struct world *w)
{
    physical(w, FLOOR, 1, 1);
    physical(w, PANEL, 1, 1);
    w->paints[FLOOR].rough = w->paints[PANEL].rough = w->texels[1];
}
static void coat(struct world *w)
{
    lam_material *m = physical(w, SOLID, 0.8f, 0.5f);
    m->clearcoat = 0.8f;
    m->clearcoat_roughness = 0.4f;
    w->paints[FLOOR].m = *m;
}
static void sheen(struct world *w)
{
    lam_material *m = physical(w, FLOOR, 0.7f, 0);
    m->sheen_color = (lam_rgb){0.8f, 0.6f, 0.4f};
    m->sheen_roughness = 0.6f;
    w->paints[PANEL].m = *m;
}
static void film(struct world *w)
{
    lam_material *m = physical(w, FLOOR, 0.5f, 0.6f);
    m->iridescence = 0.9f;
    m->iridescence_ior = 1.6f;
    w->paints[SOLID].m = *m;
}
static void strong(struct world *w)
{
    lam_material *m = physical(w, FLOOR, 0.6f, 0);
    m->ior = 2;
    m->specular_weight = 0.7f;
    m->f0_color = (lam_rgb){1, 0.8f, 0.5f};
}
static void masked(struct world *w)
{
    textured(w);
    w->paints[PANEL].color = w->texels[0];
    w->paints[PANEL].m.alpha_mode = LAM_ALPHA_MASK;
    w->paints[PANEL].m.alpha_cutoff = 0.45f;
}
static void half(struct world *w)
{
    sun(w);
    w->paints[PANEL].m.diffuse.a = 0.4f;
}
static void textured_half(struct world *w)
{
    lamps(w);
    w->paints[PANEL].color = w->texels[0];
}
static void shiny(struct world *w)
{
    sun(w);
    for (int i = FLOOR; i <= PANEL; i++) {
        w->paints[i].m.specular = (lam_rgb){0.2f, 0.2f, 0.3f};
        w->paints[i].m.shininess = 12;
    }
}
static void around(struct world *w)
{
    w->sky = 0;
    w->gradient = 1;
    for (int i = FLOOR; i <= PANEL; i++)
        physical(w, i, 0.5f + 0.05f * (float)i, 0.1f * (float)i);
}
static void everything(struct world *w)
{
    textured_glow(w);
    coat(w);
    masked(w);
    add_lamp(w, LAM_LIGHT_POINT, 1.2, 2.2, 2, 0.6f);
    w->sky = 0.1;
    physical(w, WALL, 0.5f, 0.3f);
}
static void all_lamps(struct world *w)
{
    spots(w);
    sun(w);
    ceiling(w);
    w->bounces = 2;
    w->sky = 0.1;
    dielectric(w);
}

static const struct {
    const char *name;
    void (*change)(struct world *);
    bool quick; // also in `make test`
} scenes[] = {
    {"matt, four bounces", plain, false},
    {"matt, one bounce", one_bounce, false},
    {"textures", textured, false},
    {"an emitting ceiling", ceiling, false},
    {"an emission map", textured_glow, false},
    {"12 lamps", lamps, false},
    {"100 spots", spots, false},
    {"a sun", sun, false},
    {"metals", metal, false},
    {"dielectrics", dielectric, false},
    {"a metallic-roughness map", textured_metal, false},
    {"a clear coat", coat, true},
    {"sheen", sheen, false},
    {"a thin film", film, false},
    {"ior, specular weight and colour", strong, false},
    {"an alpha mask", masked, false},
    {"opacity", half, true},
    {"an opacity map and lamps", textured_half, false},
    {"Blinn-Phong", shiny, false},
    {"an environment", around, false},
    {"maps, coat, mask, lamp", everything, false},
    {"spots, a sun and a ceiling", all_lamps, true},
};

TEST(test_scenes)
{
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        static struct world w;
        if (!scenes[i].quick && !is_long())
            continue;
        make_room(&w);
        scenes[i].change(&w);
        compare(scenes[i].name, &w);
    }
}
