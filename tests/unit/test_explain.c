// test_explain.c: an explained pixel equals the picture's pixel, bit for bit, and follows from its numbers.
#include "test.h"
#include "scenes.h"
#include "share.h"

static uint32_t random_state = 1;

static int random_below(int n)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((uint64_t)random_state * (uint64_t)n >> 32);
}

static lam_device *make_device(lam_isa isa)
{
    lam_error error = {0};
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = 2, .isa = isa}, &error);
    SUCCEEDS(device);
    return device;
}

// --- consistency of the explanation: every number follows from the previous ones

static void add(float sum[3], lam_rgb x)
{
    sum[0] += x.r;
    sum[1] += x.g;
    sum[2] += x.b;
}

static void assert_rgb(lam_rgb reported, const float expected[3])
{
    assert_memory_equal(&reported, expected, sizeof reported);
}

static double dot(lam_vec3 a, lam_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static bool soft_scene; // something that blocks a light's middle does not determine how much light passes

static int reflections; // points whose reflection term was checked and is not 0

static void check_light(const lam_explained_fragment *f, const lam_explained_point *p, const lam_explained_light *l)
{
    bool cosine = strcmp(lam_reflection_describe(f->reflection)->diffuse, "max(n·l, 0)") == 0;
    float weak = l->attenuation * l->spot * l->passed.r;
    if (!l->casts_shadows)
        assert_true(l->passed.r == 1 && l->passed.g == 1 && l->passed.b == 1);
    assert_true(soft_scene || (l->shadow_object < 0) == (l->passed.r == 1));
    const bool toned = lam_reflection_describe(f->reflection)->toned;
    const float warm = (1 + l->n_dot_l) / 2, tone[3] = {warm, warm, 1 - warm}; // Gooch's second term
    for (int c = 0; c < 3; c++) {
        float kd = (&f->surface.diffuse.r)[c] * (&l->diffuse.r)[c],
              ks = (&f->surface.specular.r)[c] * (&l->specular.r)[c];
        assert_true((&l->kd_Ld.r)[c] == kd && (toned || (&l->ks_Ls.r)[c] == ks));
        if (toned)
            assert_true(fabs((double)((&l->ks_Ls.r)[c] - ks * tone[c])) < 1e-6);
        ks = (&l->ks_Ls.r)[c];
        assert_true((&l->diffuse_term.r)[c] == kd * (weak * l->occlusion * l->D));
        assert_true((&l->specular_term.r)[c] == ks * (weak * l->occlusion * l->S));
    }
    if (cosine)
        assert_true(l->D == (l->n_dot_l > 0 ? l->n_dot_l : 0));
    if (l->n_dot_l > 0 && l->S > 0)
        assert_true(fabs((double)l->S - pow((double)l->base, (double)l->power)) < 3e-6);
    if (isnan(l->theta_rad))
        return;
    assert_true(fabs(cos(l->theta_rad) - (double)l->n_dot_l) < 2e-6);
    assert_true(fabs(dot(p->n, l->l) - cos(l->theta_rad)) < 1e-6);
    if (f->reflection == LAM_REFLECTION_BLINN_PHONG && l->base > 0)
        assert_true(fabs(cos(l->psi_rad) - (double)l->base) < 1e-5);
    if (f->reflection == LAM_REFLECTION_PHONG && l->base > 0)
        assert_true(fabs(cos(l->phi_rad) - (double)l->base) < 1e-5);
    if (l->type != LAM_LIGHT_DIRECTIONAL) {
        double d = (double)l->distance;
        assert_true(fabs(p->position.x + d * l->l.x - l->position.x) < 1e-5 * (1 + d));
        double sum = (double)l->attenuation_terms.constant +
                     ((double)l->attenuation_terms.linear + (double)l->attenuation_terms.quadratic * d) * d;
        if (l->range == 0)
            assert_true(fabs((double)l->attenuation * sum - 1) < 1e-5);
    } else {
        assert_true(l->attenuation == 1 && l->spot == 1 && l->distance == 0);
    }
}

// The mirrored eye vector, the environment's light from there, and its effect.
static void check_environment(const lam_explanation *e, const lam_explained_fragment *f, const lam_explained_point *p,
                              const lam_environment *environment)
{
    assert_true(e->has_environment == (environment != NULL));
    bool looks = environment && f->reflection != LAM_REFLECTION_NONE && dot(p->n, p->n) > 0;
    lam_rgb light = {0, 0, 0};
    if (looks) {
        double n_v = dot(p->n, p->v), length = dot(p->environment_direction, p->environment_direction);
        for (int c = 0; c < 3; c++)
            assert_true(fabs((&p->reflected.x)[c] - (2 * n_v * (&p->n.x)[c] - (&p->v.x)[c])) < 2e-6);
        assert_true(fabs(length - 1) < 1e-5);
        // The public call normalizes the direction again, so the last digits differ.
        lam_rgb near = lam_environment_sample(environment, p->environment_direction);
        light = p->environment_light;
        for (int c = 0; c < 3; c++)
            assert_true(fabs((double)((&light.r)[c] - (&near.r)[c])) < 1e-4 * (1 + (double)(&near.r)[c]));
        reflections += light.r > 0 && p->reflection.r > 0;
    } else {
        assert_true(dot(p->reflected, p->reflected) == 0);
    }
    assert_memory_equal(&p->environment_light, &light, sizeof light);
    for (int c = 0; c < 3; c++)
        assert_true((&p->reflection.r)[c] == (&f->surface.reflectivity.r)[c] * (&light.r)[c]);
}

static int layered_lights, layered_surroundings; // checked

static void assert_near(float a, float b) { assert_true(fabsf(a - b) <= 4e-6f * (1 + fabsf(b))); }

// The contributions of the layers of a physical material add up to the terms.
static void check_layers(const lam_explained_point *p)
{
    const lam_explained_layers *all = p->layers;
    float under = 1 - all->coat;
    for (int i = 0; i < p->light_count; i++) {
        const lam_explained_light *l = &p->lights[i];
        const lam_explained_light_layers *layers = l->layers;
        assert_non_null(layers);
        assert_near(l->D, under * layers->sheen_left * layers->base_diffuse);
        for (int c = 0; c < 3; c++) {
            float base = (&layers->base.r)[c], sheen = (&layers->sheen.r)[c];
            float returned = under * (layers->sheen_left * base + sheen) + layers->coat;
            assert_near(l->S * (&l->ks_Ls.r)[c], (&l->specular.r)[c] * returned);
            if (layers->S > 0)
                assert_near(base, (&l->fresnel.r)[c] * layers->S);
            layered_lights += returned > 0;
        }
        if (l->distribution > 0)
            assert_near(3.14159265f * l->distribution * l->visibility * l->n_dot_l / layers->S, 1);
    }
    if (p->environment_scale + p->environment_bias == 0)
        return;
    for (int c = 0; c < 3; c++) {
        float parts = (&all->mirrored_part.r)[c] + (&all->sheen_part.r)[c] + (&all->coat_part.r)[c];
        assert_near(parts, (&p->environment_specular.r)[c]);
        assert_true((&p->reflection.r)[c] == 0);
        layered_surroundings += parts > 0;
    }
}

static bool is_plain(const lam_explained_fragment *f)
{
    bool plain = !f->surface.physical;
    for (int i = 0; i < LAM_MAP_COUNT; i++)
        plain &= !f->surface.maps[i];
    return plain;
}

static void check_point(const lam_explanation *e, const lam_explained_fragment *f, const lam_explained_point *p,
                        const lam_environment *environment)
{
    // Other tests (textures, split-sum) cover the effect of maps and the Fresnel factor on the products of a point; the
    // sum of the terms holds for every material.
    bool plain = is_plain(f);
    if (plain)
        check_environment(e, f, p, environment);
    if (p->layers)
        check_layers(p);
    if (plain && f->reflection != LAM_REFLECTION_NONE) {
        float ambient[3] = {p->ambient_term.r, p->ambient_term.g, p->ambient_term.b}, diffuse[3] = {0},
              specular[3] = {0};
        for (int i = 0; i < p->hemisphere_count; i++)
            add(ambient, p->hemispheres[i].term);
        for (int i = 0; i < p->light_count; i++) {
            check_light(f, p, &p->lights[i]);
            add(ambient, p->lights[i].ambient_term);
            add(diffuse, p->lights[i].diffuse_term);
            add(specular, p->lights[i].specular_term);
        }
        for (int c = 0; c < 3; c++) {
            ambient[c] *= p->unoccluded;
            ambient[c] *= (&p->color.r)[c];
            diffuse[c] *= (&p->color.r)[c];
        }
        assert_rgb(p->ambient, ambient);
        assert_rgb(p->diffuse, diffuse);
        assert_rgb(p->specular, specular);
    }
    float sum[3] = {p->emission.r, p->emission.g, p->emission.b};
    add(sum, p->ambient);
    add(sum, p->diffuse);
    add(sum, p->specular);
    add(sum, p->reflection);
    assert_rgb(p->sum, sum);
    assert_true(fabs(dot(p->n, p->n) - 1) < 1e-5 || dot(p->n, p->n) == 0);
    assert_true(fabs(dot(p->v, p->v) - 1) < 1e-5 || dot(p->v, p->v) == 0);
}

static float between(const float w[3], float a, float b, float c) { return a + ((b - a) * w[1] + (c - a) * w[2]); }

static void check_fragment(const lam_explanation *e, const lam_explained_fragment *f,
                           const lam_environment *environment)
{
    assert_true(f->samples >= 1 && f->samples <= e->samples && f->lit_sample < e->samples);
    assert_true(fabs(f->picture_x - e->x - 0.5) <= 0.5 && fabs(f->picture_y - e->y - 0.5) <= 0.5);
    assert_int_equal(f->point_count, e->shading == LAM_SHADING_GOURAUD ? 3 : 1);
    for (int i = 0; i < f->point_count; i++)
        check_point(e, f, &f->points[i], environment);
    const lam_explained_point *p = f->points;
    if (f->ground == LAM_GROUND_SHADOW) { // black, with the missing light as alpha
        float y = (0.2126f * p->sum.r + 0.7152f * p->sum.g) + 0.0722f * p->sum.b;
        assert_true(f->received == y && f->unobstructed > 0);
        assert_true(f->color.r == 0 && f->color.g == 0 && f->color.b == 0);
        assert_true(f->color.a <= 1 - f->received / f->unobstructed + 1e-6f);
        assert_true(f->object == -1 && f->mesh == -1 && f->material == -1);
        return;
    }
    float color[3] = {p->result.r, p->result.g, p->result.b};
    if (f->point_count == 3)
        for (int c = 0; c < 3; c++)
            color[c] = between(f->weights, color[c], (&p[1].result.r)[c], (&p[2].result.r)[c]);
    if (e->shading == LAM_SHADING_PHONG || is_plain(f)) // otherwise a map multiplies the values of vertices and
                                                        // triangles
        assert_memory_equal(&f->color, color, sizeof color);
}

// Masked surfaces also count as layers, even if nothing of them remains.
static bool masked_scene;

static void check_numbers(const lam_explanation *e, const lam_environment *environment)
{
    float sum[4] = {0};
    // then each sample is blended separately, and the sum of the contributions is the same except for rounding
    bool layered = masked_scene, tinted = false;
    for (int i = 0; i < e->fragment_count; i++) {
        const lam_explained_fragment *f = &e->fragments[i];
        check_fragment(e, f, environment);
        float alpha = f->color.a * f->weight;
        add(sum, (lam_rgb){f->color.r * alpha, f->color.g * alpha, f->color.b * alpha});
        sum[3] += alpha;
        layered |= f->color.a < 1 || f->ground;
        tinted |= f->surface.transmission > 0;
        double through = 0;
        for (int s = 0; s < e->samples; s++)
            through += f->sample_mask >> s & 1 ? (double)f->transmittance[s] : 0;
        assert_true(fabs(through / e->samples - (double)f->weight) < 1e-6);
        assert_int_equal(__builtin_popcount(f->sample_mask), f->samples);
    }
    if (tinted) // each channel has its own fraction, and the weight is their mean
        layered = true;
    for (int c = 0; layered && !tinted && c < 4; c++)
        assert_true(fabs((double)(sum[c] - (&e->sum.r)[c])) < 2e-6 * (1 + fabs((double)sum[c])));
    if (layered)
        memcpy(sum, &e->sum, sizeof sum);
    assert_memory_equal(&e->sum, sum, sizeof sum);
    for (int c = 0; c < 3; c++) {
        float clear = 1 - sum[3], straight = e->result.a > 0 ? (&e->result.r)[c] / e->result.a : 0;
        assert_true((&e->result.r)[c] == sum[c] * e->exposure + clear * ((&e->background.r)[c] * e->background.a));
        assert_true((&e->straight.r)[c] == straight);
        assert_int_equal(e->bytes[c], (int)floorf((&e->encoded.r)[c] * 255 + 0.5f));
    }
}

// --- the explanation compared with the picture

static void check_pixel(lam_device *device, const struct demo *demo, const lam_image *image, int x, int y,
                        const char *name)
{
    lam_error error = {0};
    lam_explanation *e = lam_explain(device, demo->scene, &demo->camera, &demo->params, image->width, image->height,
                                     image->format, x, y, NULL, &error);
    if (!e)
        fail_msg("%s: %s", name, error.text);
    size_t size = image->format == LAM_RGBA8 ? 4 : 16;
    const char *pixel = (const char *)image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * size;
    const void *reported = image->format == LAM_RGBA8 ? (const void *)e->bytes : (const void *)&e->result;
    if (memcmp(pixel, reported, size) != 0)
        fail_msg("%s: pixel %d,%d is not the one explained", name, x, y);
    check_numbers(e, lam_scene_environment(demo->scene));
    lam_explanation_free(e);
}

static int alpha_of(const lam_image *image, int x, int y)
{
    size_t at = 4 * ((size_t)y * (size_t)image->width + (size_t)x) + 3;
    float alpha = image->format == LAM_RGBA8 ? ((uint8_t *)image->pixels)[at] / 255.0f : ((float *)image->pixels)[at];
    return alpha == 0 ? 0 : alpha < 1 ? 1 : 2;
}

// Some pixels of each kind: without triangles, partly covered, and fully covered.
static void check_pixels(lam_device *drawing, lam_device *explaining, const struct demo *demo, const char *name)
{
    AUTO_IMAGE image = {0};
    lam_error error = {0};
    masked_scene = strcmp(name, "masked") == 0 || strcmp(name, "shadows-leaves") == 0;
    soft_scene = strcmp(name, "shadows-soft") == 0 || strncmp(name, "ground", 6) == 0;
    assert_true(lam_image_make(&image, demo->width, demo->height, demo->format, NULL));
    if (!lam_draw(drawing, demo->scene, &demo->camera, &demo->params, &image, NULL, &error))
        fail_msg("%s: %s", name, error.text);
    int wanted[3] = {1, 3, 3};
    for (int tries = 0; tries < 3000; tries++) {
        int x = random_below(image.width), y = random_below(image.height), kind = alpha_of(&image, x, y);
        if (wanted[kind] > 0) {
            wanted[kind]--;
            check_pixel(explaining, demo, &image, x, y, name);
        }
    }
}

static const lam_shading shadings[] = {LAM_SHADING_PHONG, LAM_SHADING_GOURAUD, LAM_SHADING_FLAT};
static const int sample_counts[] = {1, 4, 16};

TEST(test_scenes)
{
    lam_device *widest = make_device(LAM_ISA_AUTO), *plain = make_device(LAM_ISA_SCALAR);
    for (int i = 0; i < demo_count; i++) {
        struct demo demo;
        lam_error error = {0};
        SUCCEEDS(demo_build(&demos[i], &demo, &error));
        if (demo.params.bounces) { // explanations are of local lighting
            lam_scene_free(demo.scene);
            continue;
        }
        lam_device *a = i & 1 ? widest : plain, *b = i & 1 ? plain : widest;
        check_pixels(a, b, &demo, demos[i].name); // unchanged
        for (int s = 0; s < 3; s++) {
            if (!is_taken((size_t)(i + s), 3))
                continue;
            bool pixels =
                demo.params.ground || demo.params.occlusion > LAM_OCCLUSION_OFF; // these require Phong shading
            demo.params.shading = pixels ? LAM_SHADING_PHONG : shadings[s];
            demo.params.samples = sample_counts[(s + i) % 3];
            demo.format = (lam_pixel_format)((s + i) & 1);
            check_pixels(a, b, &demo, demos[i].name);
        }
        lam_scene_free(demo.scene);
    }
    assert_true(reflections > 20);
    printf("layers: %d channels of lights, %d of environments\n", layered_lights, layered_surroundings);
    assert_true(layered_lights > 100 && layered_surroundings > 50);
    lam_device_free(widest);
    lam_device_free(plain);
}

TEST(test_models)
{
    static const char *const models[] = {"obj/koala/koala.obj", "obj/spot/spot_triangulated.obj",
                                         "obj/kaykit_hexagon/building_castle_blue.obj",
                                         "ply/derived/spot_colour_le.ply"};
    const char *folder = getenv("LAMBENT_MODELS");
    lam_device *device = make_device(LAM_ISA_AUTO);
    int found = 0;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder ? folder : "../shared/models", models[i]);
        struct demo demo = {.scene = lam_scene_load(path, NULL, NULL, NULL), .width = 300, .height = 200};
        if (!demo.scene)
            continue;
        found++;
        demo.camera = lam_camera_fit(demo.scene, demo.width, demo.height, NULL);
        for (int s = 0; s < 9; s++) {
            demo.params = (lam_draw_params){.shading = shadings[s % 3],
                                            .samples = sample_counts[s / 3],
                                            .background = {0.2f, 0.4f, 0.6f, s < 5 ? 0 : 0.5f}};
            demo.params.reflection = s & 1 ? LAM_REFLECTION_PHONG : LAM_REFLECTION_BLINN_PHONG;
            demo.format = s & 1 ? LAM_RGBA32F : LAM_RGBA8;
            check_pixels(device, device, &demo, models[i]);
        }
        lam_scene_free(demo.scene);
    }
    lam_device_free(device);
    if (!found) {
        print_message("none of the shared models is there\n");
        skip();
    }
}

// gl1, matched highlights, an infinite viewer: each changes a number, and the explanation contains it.
TEST(test_ways)
{
    AUTO_DEVICE device = make_device(LAM_ISA_AUTO);
    for (int i = 0; i < demo_count; i++) {
        if (strcmp(demos[i].name, "lights") != 0)
            continue;
        struct demo demo;
        assert_true(demo_build(&demos[i], &demo, NULL));
        for (int way = 0; way < 6; way++) {
            demo.params.gl1 = way & 1;
            demo.params.match_highlights = way & 2;
            demo.params.viewer = way & 4 ? LAM_VIEWER_INFINITE : LAM_VIEWER_LOCAL;
            demo.params.shading = shadings[way % 3];
            demo.params.exposure = 0.75 * way - 1.5;
            check_pixels(device, device, &demo, "lights");
        }
        lam_scene_free(demo.scene);
    }
}

// Maps, and their effect on a material: the numbers equal the pictures of --show, and S = pi D V n.l.
TEST(test_values)
{
    AUTO_DEVICE device = make_device(LAM_ISA_AUTO);
    struct demo demo;
    assert_true(demo_build_named("textured", &demo, NULL));
    demo.params.samples = 1;
    static const lam_output outputs[] = {LAM_OUTPUT_BASE_COLOR, LAM_OUTPUT_ROUGHNESS, LAM_OUTPUT_METALLIC,
                                         LAM_OUTPUT_OCCLUSION, LAM_OUTPUT_LOD};
    lam_image images[5] = {{0}};
    for (int i = 0; i < 5; i++) {
        lam_draw_params params = demo.params;
        params.output = outputs[i];
        params.shading = (lam_shading)(i % 3); // without effect
        params.reflection = i % 2 ? LAM_REFLECTION_PHONG : LAM_REFLECTION_AUTO;
        assert_true(lam_image_make(&images[i], demo.width, demo.height, LAM_RGBA32F, NULL));
        assert_true(lam_draw(device, demo.scene, &demo.camera, &params, &images[i], NULL, NULL));
    }
    int seen = 0;
    for (int k = 0; k < 2000 && seen < 20; k++) {
        int x = random_below(demo.width), y = random_below(demo.height);
        size_t at = 4 * ((size_t)y * (size_t)demo.width + (size_t)x);
        lam_explanation *e = lam_explain(device, demo.scene, &demo.camera, &demo.params, demo.width, demo.height,
                                         LAM_RGBA8, x, y, NULL, NULL);
        assert_non_null(e);
        const lam_explained_fragment *f = e->fragment_count ? &e->fragments[0] : NULL;
        if (f) {
            const lam_explained_values *v = f->values;
            assert_memory_equal(&v->base_color, (float *)images[0].pixels + at, 12);
            assert_true(v->roughness == ((float *)images[1].pixels)[at] &&
                        v->metallic == ((float *)images[2].pixels)[at]);
            assert_true(v->occlusion == ((float *)images[3].pixels)[at]);
            assert_int_equal(f->map_count, 6);
            for (int i = 0; i < f->map_count; i++) {
                const lam_explained_map *m = &f->maps[i];
                assert_true(m->column >= 0 && m->column <= 48 && m->row >= 0 && m->row <= 48 && m->width == 48);
                if (m->map == LAM_MAP_DIFFUSE) {
                    assert_true(m->level == ((float *)images[4].pixels)[at]);
                    assert_memory_equal(&m->texel, &v->base_color, 12); // the material's own colour is white
                }
                if (m->map == LAM_MAP_ROUGHNESS)
                    assert_true(m->texel.g == v->roughness);
            }
            assert_true(fabs(dot(v->mesh_normal, v->mesh_normal) - 1) < 1e-5 && dot(v->tangent, v->tangent) > 0.1);
            const lam_explained_light *l = &f->points[0].lights[0];
            float product = 3.14159265f * l->distribution * l->visibility * l->n_dot_l;
            assert_true(l->S == 0 ? l->distribution == 0 : fabsf(product / l->S - 1) < 1e-5f);
            assert_true(l->fresnel.r >= 0.04f && l->fresnel.r < 2.5f);
            seen++;
        }
        lam_explanation_free(e);
    }
    assert_int_equal(seen, 20);
    for (int i = 0; i < 5; i++)
        lam_image_free(&images[i]);
    lam_scene_free(demo.scene);
}

// A picture filled by one surface: each pixel of a tile is one fragment, and no sum is stored while it is drawn.
TEST(test_filled)
{
    AUTO_DEVICE device = make_device(LAM_ISA_AUTO);
    struct demo demo = {.width = 130, .height = 130, .camera = lam_camera_default()};
    demo.scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(demo.scene, "sphere", &(lam_shape_params){.slices = 200, .stacks = 100}, NULL);
    assert_true(lam_scene_add_object(demo.scene, &object, NULL) >= 0);
    demo.camera.eye = (lam_vec3){0, 0.3, 1.2};
    demo.camera.target = (lam_vec3){0, 0, 0};
    for (int way = 0; way < 6; way++) {
        demo.params.samples = way & 1 ? 4 : 1;
        demo.params.shading = shadings[way / 2];
        demo.format = way & 2 ? LAM_RGBA32F : LAM_RGBA8;
        check_pixels(device, device, &demo, "filled");
    }
    lam_scene_free(demo.scene);
}

// A known point: the sphere's middle under the headlight, seen straight from the front.
TEST(test_known)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_material material = lam_material_default();
    material.name = "chalk";
    material.ambient = (lam_rgb){0, 0, 0};
    material.diffuse = (lam_rgba){0.5f, 0.25f, 0.125f, 1};
    material.specular = (lam_rgb){0.25f, 0.25f, 0.25f};
    material.shininess = 8;
    lam_object object = lam_object_default();
    object.name = "ball";
    object.mesh = lam_scene_add_shape(scene, "sphere", NULL, NULL);
    object.material = lam_scene_add_material(scene, &material, NULL);
    assert_int_equal(lam_scene_add_object(scene, &object, NULL), 0);
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    light.name = "lamp";
    light.position = (lam_vec3){0, 0, 3};
    light.attenuation = (lam_attenuation){0, 0, 1};
    assert_int_equal(lam_scene_add_light(scene, &light, NULL), 0);
    lam_camera camera = lam_camera_default();
    AUTO_DEVICE device = make_device(LAM_ISA_AUTO);
    lam_explanation *e = lam_explain(device, scene, &camera, NULL, 101, 101, LAM_RGBA32F, 50, 50, NULL, NULL);
    assert_non_null(e);
    assert_true(e->fragment_count >= 1);
    const lam_explained_fragment *f = &e->fragments[0];
    assert_string_equal(f->object_name, "ball");
    assert_string_equal(f->surface.name, "chalk");
    const lam_explained_light *l = &f->points[0].lights[0];
    assert_string_equal(l->name, "lamp");
    assert_true(fabs((double)l->distance - 2) < 1e-3 && fabs((double)l->attenuation - 0.25) < 1e-3);
    assert_true(l->theta_rad < 0.02 && l->phi_rad < 0.03 && l->psi_rad < 0.02);
    assert_true(fabs(f->points[0].world_position.z - 1) < 1e-3);
    assert_true(fabs((double)e->result.r - 0.25 * (0.5 + 0.25)) < 1e-3);
    lam_explanation_free(e);

    lam_error error;
    assert_null(lam_explain(device, scene, &camera, NULL, 101, 101, LAM_RGBA8, 101, 50, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, "101,50"));
    assert_null(lam_explain(device, scene, &camera, NULL, 0, 101, LAM_RGBA8, 0, 0, NULL, &error));
    assert_null(lam_explain(device, NULL, &camera, NULL, 10, 10, LAM_RGBA8, 0, 0, NULL, &error));
    assert_null(lam_explain(NULL, scene, &camera, NULL, 10, 10, LAM_RGBA8, 0, 0, NULL, &error));
    AUTO_DEVICE null = lam_device_null(NULL);
    assert_null(lam_explain(null, scene, &camera, NULL, 10, 10, LAM_RGBA8, 0, 0, NULL, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    lam_explanation_free(NULL);
}

// A picture drawn after an explanation equals the picture before it.
TEST(test_device_unchanged)
{
    struct demo demo;
    assert_true(demo_build(&demos[0], &demo, NULL));
    AUTO_DEVICE device = make_device(LAM_ISA_AUTO);
    lam_image before = {0}, after = {0};
    assert_true(lam_image_make(&before, 200, 150, LAM_RGBA8, NULL) &&
                lam_image_make(&after, 200, 150, LAM_RGBA8, NULL));
    assert_true(lam_draw(device, demo.scene, &demo.camera, &demo.params, &before, NULL, NULL));
    lam_explanation *e =
        lam_explain(device, demo.scene, &demo.camera, &demo.params, 64, 64, LAM_RGBA32F, 30, 30, NULL, NULL);
    assert_non_null(e);
    lam_explanation_free(e);
    assert_true(lam_draw(device, demo.scene, &demo.camera, &demo.params, &after, NULL, NULL));
    assert_memory_equal(before.pixels, after.pixels, 200 * 150 * 4);
    lam_image_free(&before);
    lam_image_free(&after);
    lam_scene_free(demo.scene);
}
