// picture_options.h: the inputs of the targets that draw: OPTIONS bytes of options, in the order of read_options, then a
// model or a scene file of any format. Bytes after a zero byte of a text file are its MTL file.
#ifndef PICTURE_OPTIONS_H
#define PICTURE_OPTIONS_H

#include "small_files.h"
#include "target.h"

#include <lambent/light.h>

#include <string.h>

enum { OPTIONS = 24, SIDE_MAX = 48 };

enum way {
    SHADOWS = 1,
    FLAT_TERMINATOR = 2,
    GL1 = 4,
    SINGLE_SCATTERING = 8,
    MATCH_HIGHLIGHTS = 16,
    RAW = 32,
    FLOATS = 64,
    TWICE = 128,
};
enum addition {
    CAMERA_INSIDE = 1,
    FILE_CAMERA = 2,
    ENVIRONMENT = 4,
    MAPS = 8,
    BALL_LIGHT = 16,
    NORMALS_WHEN_DRAWN = 32,
    REFERENCE = 64,
    ORTHOGRAPHIC = 128,
};

struct options {
    lam_load_params load;
    lam_draw_params draw;
    lam_view view;
    lam_image image;
    int way, addition;
    int threads[2];
    lam_isa isa[2];
};

static inline lam_isa isa_of(int number)
{
    lam_isa isa = (lam_isa)(number % LAM_ISA_COUNT);
    return lam_isa_usable(isa) ? isa : LAM_ISA_SCALAR;
}

static inline struct options read_options(const uint8_t *o)
{
    struct options options = {
        .way = o[0],
        .addition = o[1],
        .load = {.normals = (lam_normals)(o[2] % 3),
                 .up = (lam_up)(o[2] / 3 % LAM_UP_COUNT),
                 .crease_angle_rad = o[3] / 255.0 * 3.14,
                 .threads = 1 + (o[15] >> 7),
                 .lenient = o[15] & 64,
                 .open = open_small},
        .draw = {.shading = (lam_shading)(o[4] % 3),
                 .stage = (lam_stage)(o[4] / 3 % 4),
                 .viewer = (lam_viewer)(o[4] / 12 % 2),
                 .flat_normal = (lam_flat_normal)(o[4] / 24 % 2),
                 .reflection = (lam_reflection)(o[5] % LAM_REFLECTION_COUNT),
                 .rig = (lam_rig)(o[6] % (LAM_RIG_LECTURE + 1)),
                 .output = o[7] < 128 ? LAM_OUTPUT_PICTURE : (lam_output)(o[7] % LAM_OUTPUT_COUNT),
                 .output_light = o[8] % 4,
                 .tone = (lam_tone)(o[8] / 4 % LAM_TONE_COUNT),
                 .samples = 1 << o[9] % 5,
                 .anisotropy = o[9] / 5 % 17,
                 .occlusion = (lam_occlusion)(o[10] % LAM_OCCLUSION_COUNT),
                 .occlusion_radius = (float)(o[10] / LAM_OCCLUSION_COUNT) / 10,
                 .shadow_samples = o[11] % 20,
                 .light_cutoff = o[11] > 200 ? -1 : (float)(o[11] / 20) / 10,
                 .background = {(float)o[12] / 255, 0.5f, 0.25f, (float)(o[12] % 3) / 2},
                 .line_width = (float)o[13] / 8,
                 .point_size = (float)o[13] / 4,
                 .exposure = (o[14] - 128) / 16.0},
        .view = {.from_angles = o[16] & 1,
                 .azimuth_rad = o[16] * 0.05,
                 .elevation_rad = (o[17] - 128) / 128.0 * 1.57,
                 .zoom = o[18] < 200 ? 0 : (o[18] - 199) * 3.0,
                 .fovy_rad = o[18] < 200 ? 0 : 2.5},
        .image = {.width = 1 + o[19] % SIDE_MAX, .height = 1 + o[20] % SIDE_MAX},
        .threads = {1 + o[15] % 2, 1 + o[15] / 2 % 2},
        .isa = {isa_of(o[21]), isa_of(o[22])},
    };
    options.draw.shadows = o[0] & SHADOWS;
    options.draw.flat_terminator = o[0] & FLAT_TERMINATOR;
    options.draw.gl1 = o[0] & GL1;
    options.draw.single_scattering = o[0] & SINGLE_SCATTERING;
    options.draw.match_highlights = o[0] & MATCH_HIGHLIGHTS;
    options.draw.color = options.load.color = o[0] & RAW ? LAM_COLOR_RAW : LAM_COLOR_SRGB;
    options.image.format = o[0] & FLOATS ? LAM_RGBA32F : LAM_RGBA8;
    options.draw.reference = o[1] & REFERENCE ? 16 : 0;
    options.load.normals_when_drawn = o[1] & NORMALS_WHEN_DRAWN;
    options.view.orthographic = o[1] & ORTHOGRAPHIC;
    return options;
}

// Six faces of 2×2 floats, made once; the first frame computes the data for lighting with them and keeps it.
static inline const lam_environment *small_environment(void)
{
    static lam_environment *environment;
    if (environment)
        return environment;
    static float texels[6][4][4];
    lam_image faces[6];
    const lam_image *list[6];
    for (int f = 0; f < 6; f++) {
        for (int i = 0; i < 16; i++)
            texels[f][i / 4][i % 4] = i % 4 == 3 ? 1 : (float)((f * 16 + i) % 7) / 3;
        faces[f] = (lam_image){.width = 2, .height = 2, .format = LAM_RGBA32F, .pixels = texels[f]};
        list[f] = &faces[f];
    }
    environment = lam_environment_make(list, LAM_COLOR_SRGB, NULL);
    if (!environment)
        abort();
    return environment;
}

// A diffuse, a normal and an occlusion map on every material.
static inline void add_maps(lam_scene *scene, int transform)
{
    static lam_texture *texture;
    static const uint8_t texels[4][4] = {{255, 0, 0, 255}, {0, 255, 0, 128}, {128, 128, 255, 0}, {90, 200, 250, 255}};
    if (!texture)
        texture = lam_texture_make(&(lam_image){.width = 2, .height = 2, .pixels = (void *)(uintptr_t)texels},
                                   LAM_TEXTURE_COLOR, NULL, NULL);
    lam_texture_map map = {.texture = texture, .texcoords = transform & 1, .wrap_s = (lam_wrap)(transform % 3)};
    if (transform & 8)
        map.transform[0][1] = map.transform[1][0] = 1e3f;
    for (int i = 0; i < lam_scene_material_count(scene); i++) {
        lam_material material = *lam_scene_material(scene, i);
        material.maps[LAM_MAP_DIFFUSE] = material.maps[LAM_MAP_NORMAL] = material.maps[LAM_MAP_OCCLUSION] = &map;
        lam_scene_set_material(scene, i, &material, NULL);
    }
}

static inline lam_camera camera_of(const lam_scene *scene, const struct options *options)
{
    lam_camera camera = lam_camera_fit(scene, options->image.width, options->image.height, &options->view);
    lam_vec3 low, high;
    if (options->addition & FILE_CAMERA)
        lam_scene_camera(scene, 0, &camera); // without one, the default camera
    else if (options->addition & CAMERA_INSIDE && lam_scene_bounds(scene, &low, &high))
        camera.eye =
            (lam_vec3){low.x + 0.5 * (high.x - low.x), low.y + 0.4 * (high.y - low.y), low.z + 0.6 * (high.z - low.z)};
    return camera;
}

// Reads the options and loads the scene. Returns NULL if there is no scene.
static inline lam_scene *scene_of_input(const uint8_t *data, size_t size, struct options *options)
{
    if (size < OPTIONS)
        return NULL;
    *options = read_options(data);
    data += OPTIONS;
    size -= OPTIONS;
    static struct small_files files;
    files = (struct small_files){0};
    const uint8_t *zero = size > 4 && data[0] > ' ' && data[1] > 0 ? memchr(data, 0, size) : NULL;
    if (zero && memmem(data, (size_t)(zero - data), "mtllib", 6)) {
        files = (struct small_files){zero + 1, size - (size_t)(zero - data) - 1};
        size = (size_t)(zero - data);
    }
    options->load.user = &files;
    const lam_control control = {.memory_limit_bytes = 256 << 20};
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(data, size, "fuzz", &options->load, &control, &error);
    if (!scene && (error.code == LAM_OK || !error.text[0]))
        abort();
    note_sentence(scene ? "" : error.text);
    if (!scene)
        return NULL;
    // The built-in environments take most of a second, so no input uses them.
    if (options->addition & ENVIRONMENT || options->draw.rig == LAM_RIG_AUTO || lam_scene_environment(scene))
        lam_scene_set_environment(scene, small_environment(), 0.3, NULL);
    if (options->addition & MAPS)
        add_maps(scene, data[-1]);
    lam_light ball = lam_light_default(LAM_LIGHT_POINT);
    ball.position = (lam_vec3){0.5, 0.7, 0.9};
    ball.radius = 0.3f;
    ball.occluded = 0.5f;
    if (options->addition & BALL_LIGHT)
        lam_scene_add_light(scene, &ball, NULL);
    return scene;
}

#endif
