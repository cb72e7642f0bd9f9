// test_textures.c: texels compared with a second evaluator in double, implemented from OpenGL's rules; mipmaps; maps of
// materials.

#include "test.h"

static uint32_t seed = 1;
static double random_unit(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (seed >> 8) / 16777216.0;
}

// --- a second evaluator

struct pyramid {
    int levels, width[16], height[16];
    double *texels[16]; // RGBA
};

static double linear_of(int byte)
{
    double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

// Each texel is the average of the area that it covers.
static void halve(struct pyramid *p, int to)
{
    int w = p->width[to - 1], h = p->height[to - 1], nw = w / 2 ? w / 2 : 1, nh = h / 2 ? h / 2 : 1;
    p->width[to] = nw, p->height[to] = nh;
    p->texels[to] = calloc((size_t)nw * (size_t)nh * 4, sizeof(double));
    for (int y = 0; y < nh; y++)
        for (int x = 0; x < nw; x++)
            for (int j = 0; j < h; j++)
                for (int i = 0; i < w; i++) {
                    double left = fmax(i, (double)x * w / nw), right = fmin(i + 1, (double)(x + 1) * w / nw);
                    double top = fmax(j, (double)y * h / nh), bottom = fmin(j + 1, (double)(y + 1) * h / nh);
                    double share = right > left && bottom > top ? (right - left) * (bottom - top) : 0;
                    for (int c = 0; c < 4; c++)
                        p->texels[to][(y * nw + x) * 4 + c] +=
                            p->texels[to - 1][(j * w + i) * 4 + c] * share * nw / w * nh / h;
                }
}

static struct pyramid pyramid_of(const uint8_t *bytes, int w, int h, bool color)
{
    struct pyramid p = {.levels = 1, .width = {w}, .height = {h}};
    p.texels[0] = malloc((size_t)w * (size_t)h * 4 * sizeof(double));
    for (int i = 0; i < w * h * 4; i++)
        p.texels[0][i] = color && i % 4 < 3 ? linear_of(bytes[i]) : bytes[i] / 255.0;
    for (int side = w > h ? w : h; side > 1; side /= 2)
        halve(&p, p.levels++);
    return p;
}

static void pyramid_free(struct pyramid *p)
{
    for (int i = 0; i < p->levels; i++)
        free(p->texels[i]);
}

// The texel of a coordinate in texels, after wrapping.
static int wrap_texel(int i, int size, lam_wrap wrap)
{
    if (wrap == LAM_WRAP_CLAMP)
        return i < 0 ? 0 : i >= size ? size - 1 : i;
    int period = wrap == LAM_WRAP_MIRROR ? 2 * size : size;
    i = (i % period + period) % period;
    return i < size ? i : 2 * size - 1 - i;
}

static double fetch(const struct pyramid *p, const lam_texture_map *m, int level, int x, int y, int c)
{
    x = wrap_texel(x, p->width[level], m->wrap_s);
    y = wrap_texel(y, p->height[level], m->wrap_t);
    return p->texels[level][(y * p->width[level] + x) * 4 + c];
}

static double in_level(const struct pyramid *p, const lam_texture_map *m, lam_filter filter, int level, double s,
                       double t, int c)
{
    double x = s * p->width[level], y = t * p->height[level];
    if (filter == LAM_FILTER_NEAREST)
        return fetch(p, m, level, (int)floor(x), (int)floor(y), c);
    x -= 0.5, y -= 0.5;
    int i = (int)floor(x), j = (int)floor(y);
    double a = x - i, b = y - j;
    return (fetch(p, m, level, i, j, c) * (1 - a) + fetch(p, m, level, i + 1, j, c) * a) * (1 - b) +
           (fetch(p, m, level, i, j + 1, c) * (1 - a) + fetch(p, m, level, i + 1, j + 1, c) * a) * b;
}

static double expected(const struct pyramid *p, const lam_texture_map *m, double s, double t, double detail, int c)
{
    int last = p->levels - 1;
    if (detail <= 0)
        return in_level(p, m, m->magnify, 0, s, t, c);
    if (m->mip == LAM_MIP_NONE)
        return in_level(p, m, m->minify, 0, s, t, c);
    if (m->mip == LAM_MIP_NEAREST)
        return in_level(p, m, m->minify, (int)fmin(last, ceil(detail + 0.5) - 1), s, t, c);
    if (detail >= last)
        return in_level(p, m, m->minify, last, s, t, c);
    int level = (int)floor(detail);
    double share = detail - level;
    return in_level(p, m, m->minify, level, s, t, c) * (1 - share) +
           in_level(p, m, m->minify, level + 1, s, t, c) * share;
}

// Every wrap, filter and mip mode, sizes that are not powers of two, coordinates far outside: no texel differs, for
// bytes and floats, with alpha and without, which uses three numbers per texel. Near the border between two texels, the
// nearest one may be either.
TEST(test_texels)
{
    static const int sizes[][2] = {{16, 16}, {13, 7}, {1, 9}, {32, 5}, {1, 1}};
    for (int n = 0; n < 5 * 2 * 3; n++) {
        int w = sizes[n / 2 % 5][0], h = sizes[n / 2 % 5][1];
        bool opaque = n >= 10, floats = n >= 20;
        uint8_t bytes[32 * 16 * 4];
        float numbers[32 * 16 * 4]; // of floats
        struct pyramid p;
        for (int i = 0; i < w * h * 4; i++)
            bytes[i] = opaque && i % 4 == 3 ? 255 : (uint8_t)(random_unit() * 256);
        p = pyramid_of(bytes, w, h, n % 2 == 0);
        for (int i = 0; i < w * h * 4; i++)
            numbers[i] = (float)p.texels[0][i];
        lam_image image = {.width = w, .height = h, .format = LAM_RGBA8, .pixels = bytes};
        if (floats)
            image = (lam_image){.width = w, .height = h, .format = LAM_RGBA32F, .pixels = numbers};
        lam_error error;
        lam_texture *texture = lam_texture_make(&image, n % 2 ? LAM_TEXTURE_NUMBERS : LAM_TEXTURE_COLOR, NULL, &error);
        assert_non_null(texture);
        uint64_t memory = 0;
        for (int level = 0; level < p.levels; level++)
            memory += (uint64_t)(p.width[level] * p.height[level]) * (opaque ? 3 : 4) * (level || floats ? 4 : 1);
        assert_int_equal(lam_texture_memory(texture), memory);
        assert_int_equal(lam_texture_levels(texture), p.levels);
        for (int level = 0; level < p.levels; level++)
            assert_true(lam_texture_width(texture, level) == p.width[level] &&
                        lam_texture_height(texture, level) == p.height[level]);
        for (int i = 0; i < 3000; i++) {
            lam_texture_map map = {.texture = texture,
                                   .wrap_s = (lam_wrap)(i % 3),
                                   .wrap_t = (lam_wrap)(i / 3 % 3),
                                   .magnify = (lam_filter)(i / 9 % 2),
                                   .minify = (lam_filter)(i / 18 % 2),
                                   .mip = (lam_mip)(i / 36 % 3)};
            double s = random_unit() * 5 - 2, t = random_unit() * 5 - 2, detail = random_unit() * 8 - 2;
            s = (float)s, t = (float)t, detail = (float)detail;
            if (fabs(detail + 0.5 - round(detail + 0.5)) < 1e-3)
                continue; // between two levels of LAM_MIP_NEAREST
            lam_rgba found = lam_texture_sample(&map, s, t, detail);
            const float *f = &found.r;
            bool same = true, beside = false;
            for (int c = 0; c < 4; c++)
                same &= fabs((double)f[c] - expected(&p, &map, s, t, detail, c)) < 2e-5;
            for (int k = 0; !same && k < 4; k++) { // one step to each side
                bool all = true;
                for (int c = 0; c < 4; c++)
                    all &= fabs((double)f[c] - expected(&p, &map, s + (k & 1 ? 1e-6 : -1e-6),
                                                        t + (k & 2 ? 1e-6 : -1e-6), detail, c)) < 2e-4;
                beside |= all;
            }
            if (!same && !beside)
                fail_msg("%d×%d, wraps %d %d, filters %d %d, mip %d at %g, %g, level %g: found %g, expected %g", w, h,
                         (int)map.wrap_s, (int)map.wrap_t, (int)map.magnify, (int)map.minify, (int)map.mip, s, t,
                         detail, (double)found.r, expected(&p, &map, s, t, detail, 0));
        }
        pyramid_free(&p);
        lam_texture_free(texture);
    }
}

static lam_texture *constant(float r, float g, float b, float a)
{
    float pixel[4] = {r * a, g * a, b * a, a}; // float pictures are premultiplied
    lam_image image = {.width = 1, .height = 1, .format = LAM_RGBA32F, .pixels = pixel};
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_NUMBERS, "constant", NULL);
    assert_non_null(texture);
    return texture;
}

enum { SIZE = 64 };

static lam_scene *lit_sphere(const lam_material *material)
{
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "sphere", NULL, &error);
    object.material = lam_scene_add_material(scene, material, &error);
    if (object.material < 0)
        fail_msg("%s", error.text);
    assert_true(lam_scene_add_object(scene, &object, &error) >= 0);
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    light.position = (lam_vec3){2, 3, 4};
    assert_true(lam_scene_add_light(scene, &light, &error) >= 0);
    lam_scene_set_ambient(scene, (lam_rgb){0.1f, 0.2f, 0.3f});
    return scene;
}

static lam_shading shading_in_use = LAM_SHADING_PHONG;

static void draw(const lam_material *material, lam_reflection reflection, float *pixels)
{
    lam_error error;
    AUTO_SCENE scene = lit_sphere(material);
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    lam_draw_params params = {.samples = 4, .rig = LAM_RIG_NONE, .reflection = reflection, .shading = shading_in_use};
    lam_image image = {.width = SIZE, .height = SIZE, .format = LAM_RGBA32F, .pixels = pixels};
    SUCCEEDS(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
}

static double largest_difference(const float *a, const float *b)
{
    double most = 0;
    for (int i = 0; i < SIZE * SIZE * 4; i++)
        most = fmax(most, fabs((double)a[i] - (double)b[i]));
    return most;
}

// Maps of one colour give the same picture as the numbers themselves, for physical materials, classic ones, and
// conversions.
TEST(test_constant_maps)
{
    static float with[SIZE * SIZE * 4], without[SIZE * SIZE * 4];
    static const lam_reflection models[] = {LAM_REFLECTION_AUTO, LAM_REFLECTION_PHONG, LAM_REFLECTION_BLINN_PHONG};
    lam_texture *color = constant(0.5f, 0.75f, 0.25f, 1), *numbers = constant(0.5f, 0.75f, 0.25f, 1);
    lam_texture *flat = constant(0.5f, 0.5f, 1, 1);
    lam_texture_map color_map = {.texture = color}, flat_map = {.texture = flat}, roughness = {numbers, .channel = 1};
    lam_texture_map metallic = {.texture = numbers, .channel = 2}, half = {.texture = numbers, .scale = 0.5f};
    for (int physical = 0; physical < 2; physical++)
        for (int model = 0; model < (physical ? 3 : 1); model++) {
            lam_material m = lam_material_default(), plain;
            m.diffuse = (lam_rgba){0.8f, 0.6f, 1, 1};
            m.ambient = (lam_rgb){0.8f, 0.6f, 1};
            m.emission = (lam_rgb){0.2f, 0.1f, 0};
            m.specular = (lam_rgb){0.5f, 0.5f, 0.5f};
            m.metallic = 1, m.roughness = 0.5f, m.shininess = 40;
            m.physical = physical;
            plain = m;
            plain.diffuse = (lam_rgba){0.4f, 0.45f, 0.25f, 1};
            plain.ambient = (lam_rgb){0.4f, 0.45f, 0.25f};
            plain.emission = (lam_rgb){0.1f, 0.075f, 0};
            m.maps[LAM_MAP_DIFFUSE] = m.maps[LAM_MAP_EMISSION] = &color_map;
            m.maps[LAM_MAP_NORMAL] = &flat_map;
            if (physical) {
                plain.metallic = 0.25f, plain.roughness = 0.375f;
                m.maps[LAM_MAP_METALLIC] = &metallic;
                m.maps[LAM_MAP_ROUGHNESS] = &roughness;
            } else {
                plain.specular = (lam_rgb){0.25f, 0.375f, 0.125f};
                plain.shininess = 10;
                m.maps[LAM_MAP_SPECULAR] = &color_map;
                m.maps[LAM_MAP_SHININESS] = &half;
            }
            draw(&m, models[model], with);
            draw(&plain, models[model], without);
            double most = largest_difference(with, without);
            if (!(most < 2e-5))
                fail_msg("physical %d, model %d: a channel differs by %g", physical, model, most);
        }
    lam_texture_free(color);
    lam_texture_free(numbers);
    lam_texture_free(flat);
}

// With Gouraud and flat shading, the diffuse map multiplies the interpolated colours, and the emission map is added to
// them.
TEST(test_vertex_shading)
{
    static float with[SIZE * SIZE * 4], without[SIZE * SIZE * 4];
    static const lam_shading methods[] = {LAM_SHADING_FLAT, LAM_SHADING_GOURAUD};
    lam_texture *color = constant(0.5f, 0.75f, 0.25f, 0.5f);
    lam_texture_map map = {.texture = color};
    for (int i = 0; i < 4; i++) {
        lam_material m = lam_material_default(), plain;
        m.physical = i / 2;
        m.metallic = 0.3f, m.roughness = 0.4f;
        m.diffuse = (lam_rgba){0.8f, 0.6f, 1, 1};
        m.ambient = (lam_rgb){0.8f, 0.6f, 1};
        m.emission = (lam_rgb){0.2f, 0.1f, 0};
        plain = m;
        if (!m.physical) // the highlight of a physical material also has the colour
            plain.diffuse = (lam_rgba){0.4f, 0.45f, 0.25f, 0.5f}, plain.ambient = (lam_rgb){0.4f, 0.45f, 0.25f};
        plain.emission = (lam_rgb){0.1f, 0.075f, 0};
        m.maps[LAM_MAP_EMISSION] = &map;
        if (!m.physical)
            m.maps[LAM_MAP_DIFFUSE] = &map;
        shading_in_use = methods[i % 2];
        draw(&m, LAM_REFLECTION_AUTO, with);
        draw(&plain, LAM_REFLECTION_AUTO, without);
        shading_in_use = LAM_SHADING_PHONG;
        double most = largest_difference(with, without);
        if (!(most < 2e-5))
            fail_msg("physical %d, shading %d: a channel differs by %g", i / 2, (int)methods[i % 2], most);
    }
    lam_texture_free(color);
}

// The alpha modes at an opacity of 0.3.
TEST(test_alpha_modes)
{
    static float pixels[SIZE * SIZE * 4];
    static const struct {
        lam_alpha_mode mode;
        float cutoff;
        double alpha;
    } rows[] = {{LAM_ALPHA_BLEND, 0, 1 - 0.7 * 0.7},
                {LAM_ALPHA_OPAQUE, 0, 1},
                {LAM_ALPHA_MASK, 0.25f, 1},
                {LAM_ALPHA_MASK, 0.35f, 0}};
    lam_texture *half = constant(1, 1, 1, 0.5f);
    lam_texture_map map = {.texture = half};
    for (int i = 0; i < 4; i++) {
        lam_material m = lam_material_default();
        m.diffuse.a = 0.6f;
        m.maps[LAM_MAP_DIFFUSE] = &map;
        m.alpha_mode = rows[i].mode;
        m.alpha_cutoff = rows[i].cutoff;
        draw(&m, LAM_REFLECTION_AUTO, pixels);
        double alpha = (double)pixels[(SIZE / 2 * SIZE + SIZE / 2) * 4 + 3];
        if (!(fabs(alpha - rows[i].alpha) < 1e-5))
            fail_msg("mode %d, cutoff %g: alpha %g, expected %g", (int)rows[i].mode, (double)rows[i].cutoff, alpha,
                     rows[i].alpha);
    }
    lam_texture_free(half);
}

TEST(test_refused)
{
    lam_error error;
    AUTO_SCENE scene = lam_scene_make(&error);
    lam_texture *texture = constant(1, 1, 1, 1);
    lam_texture_map maps[] = {{.texture = NULL},
                              {.texture = texture, .texcoords = 2},
                              {.texture = texture, .wrap_t = LAM_WRAP_COUNT},
                              {.texture = texture, .channel = 4},
                              {.texture = texture, .scale = INFINITY}};
    for (int i = 0; i < 5; i++) {
        lam_material m = lam_material_default();
        m.maps[LAM_MAP_OCCLUSION] = &maps[i];
        assert_int_equal(lam_scene_add_material(scene, &m, &error), -1);
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, "occlusion map"));
    }
    float nan[4] = {NAN, 0, 0, 1};
    lam_image image = {.width = 1, .height = 1, .format = LAM_RGBA32F, .pixels = nan};
    assert_null(lam_texture_make(&image, LAM_TEXTURE_NUMBERS, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    // A scene keeps the texture.
    lam_material m = lam_material_default();
    m.maps[LAM_MAP_DIFFUSE] = &(lam_texture_map){.texture = texture};
    assert_int_equal(lam_scene_add_material(scene, &m, &error), 0);
    lam_texture_free(texture);
    assert_string_equal(lam_texture_name(lam_scene_material(scene, 0)->maps[LAM_MAP_DIFFUSE]->texture), "constant");
}

// --- a plane seen at 4 degrees

enum { STRIPES = 256, VIEW = 64 };
static uint8_t stripes[STRIPES][STRIPES][3];

// The picture, bilinear in double; u and v in texels.
static double stripe_at(double u, double v)
{
    double x = floor(u - 0.5), y = floor(v - 0.5), s = u - 0.5 - x, t = v - 0.5 - y, sum = 0;
    for (int i = 0; i < 4; i++) {
        const uint8_t *at = stripes[((int)y + i / 2) & (STRIPES - 1)][((int)x + i % 2) & (STRIPES - 1)];
        sum += (i % 2 ? s : 1 - s) * (i / 2 ? t : 1 - t) * at[0] / 255;
    }
    return sum;
}

// Stripes that extend into the distance: a pixel is one texel wide and 14 texels long. With 16 probes, its value is
// close to the exact mean over its footprint, the integral in double; with one probe, it is the mean over a square of
// 14 texels.
TEST(test_slanted)
{
    const double slant = sin(4 * 3.14159265358979323846 / 180), side = 400;
    for (int y = 0; y < STRIPES; y++)
        for (int x = 0; x < STRIPES; x++)
            memset(stripes[y][x], (int)(128 + 100 * cos(0.78539816339 * x) + 20 * cos(0.09817477 * y)), 3);
    lam_error error;
    lam_image picture = {
        .width = STRIPES, .height = STRIPES, .format = LAM_RGB8, .pixels = stripes, .stride = 3 * STRIPES};
    lam_texture *texture = lam_texture_make(&picture, LAM_TEXTURE_NUMBERS, NULL, &error);
    lam_texture_map map = {.texture = texture};
    lam_material material = lam_material_default();
    material.unlit = true;
    material.diffuse = (lam_rgba){1, 1, 1, 1};
    material.maps[LAM_MAP_DIFFUSE] = &map;
    const float far = (float)(side / slant), end = (float)(side / STRIPES), length = far / STRIPES;
    const float positions[] = {-400, 0, far, 400, 0, far, 400, 0, -far, -400, 0, -far};
    const float texcoords[] = {-end, length, end, length, end, -length, -end, -length};
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    AUTO_SCENE scene = lam_scene_make(&error);
    const lam_part part = {.triangle_count = 2, .material = lam_scene_add_material(scene, &material, &error)};
    const lam_mesh mesh = {.positions = positions,
                           .vertex_count = 4,
                           .indices = indices,
                           .triangle_count = 2,
                           .texcoords = texcoords,
                           .texcoord_count = 4,
                           .parts = &part,
                           .part_count = 1};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    assert_true(part.material >= 0 && object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){0, 1000 * slant, 1000 * sqrt(1 - slant * slant)};
    camera.ortho_half_height = VIEW / 2.0; // one pixel is one unit, and one unit is one texel
    AUTO_DEVICE device = lam_device_cpu(NULL, &error);
    double off[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        AUTO_IMAGE image = {0};
        lam_draw_params params = {.samples = 1, .anisotropy = k ? 16 : 1};
        assert_true(lam_image_make(&image, VIEW, VIEW, LAM_RGBA32F, &error));
        SUCCEEDS(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
        for (int y = 0; y < VIEW; y++)
            for (int x = 0; x < VIEW; x++) {
                double exact = 0;
                for (int i = 0; i < 256; i++) // 4 x 64 points of the pixel
                    exact +=
                        stripe_at(x - VIEW / 2 + (i % 4 + 0.5) / 4, (y - VIEW / 2 + (i / 4 + 0.5) / 64) / slant) / 256;
                double apart = (double)((const float *)image.pixels)[4 * (y * VIEW + x)] - exact;
                off[k] += apart * apart / (VIEW * VIEW);
            }
    }
    print_message("a plane at 4 degrees: %.3f off with 1 probe, %.3f with 16\n", sqrt(off[0]), sqrt(off[1]));
    assert_true(sqrt(off[0]) > 0.15 && sqrt(off[1]) < 0.03);
    lam_texture_free(texture);
}
