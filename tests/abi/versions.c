// versions.c: a program that uses the library through fields that every version of the headers contains. It prints a
// hash of its picture and numbers of its explanation, reports and scene, including arrays. With NEWER, the headers
// contain a field `newest` in every struct, and each call is made once with that field set.
#include <lambent/check.h>
#include <lambent/lambent.h>
#include <stdio.h>
#include <string.h>

static void print_image(const char *name, const lam_image *image)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    const unsigned char *bytes = image->pixels;
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height * 4; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    printf("%s %dx%d %016llx\n", name, image->width, image->height, (unsigned long long)hash);
}

static bool build_scene(lam_scene *scene, lam_error *error)
{
    lam_material material = lam_material_named(LAM_MATERIAL_BRASS, LAM_COLOR_SRGB);
    lam_light lights[2] = {lam_light_default(LAM_LIGHT_POINT), lam_light_default(LAM_LIGHT_SPOT)};
    lights[0].position = (lam_vec3){3, 4, 5};
    lights[1].position = (lam_vec3){-3, 1, 5};
    lights[1].direction = (lam_vec3){3, -1, -5};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "torus", &(lam_shape_params){.radius = 2, .slices = 24}, error);
    object.material = lam_scene_add_material(scene, &material, error);
    return object.mesh >= 0 && object.material >= 0 && lam_scene_add_object(scene, &object, error) >= 0 &&
           lam_scene_add_light(scene, &lights[0], error) >= 0 && lam_scene_add_light(scene, &lights[1], error) >= 0;
}

static bool draw(lam_device *device, const lam_scene *scene, lam_error *error)
{
    lam_view view = {.from_angles = true, .azimuth_rad = 0.4, .elevation_rad = 0.5};
    lam_camera camera = lam_camera_fit(scene, 160, 120, &view);
    lam_draw_params params = {.samples = 8, .background = {0.2f, 0.3f, 0.4f, 1}, .exposure = 0.25};
    lam_image image = {0};
    if (!lam_image_make(&image, 160, 120, LAM_RGBA8, error) ||
        !lam_draw(device, scene, &camera, &params, &image, NULL, error))
        return false;
    print_image("picture", &image);
    lam_image_free(&image);
    lam_frame_report report;
    lam_device_report(device, &report);
    printf("report %llu %llu %llu\n", (unsigned long long)report.triangles, (unsigned long long)report.triangles_binned,
           (unsigned long long)report.pixels_covered);

    lam_explanation *explained = lam_explain(device, scene, &camera, &params, 160, 120, LAM_RGBA8, 80, 62, NULL, error);
    for (int i = 0; explained && i < explained->fragment_count; i++) {
        const lam_explained_fragment *fragment = &explained->fragments[i];
        printf("fragment %d %u %d\n", fragment->object, fragment->triangle, fragment->samples);
        for (int p = 0; p < fragment->point_count; p++)
            for (int k = 0; k < fragment->points[p].light_count; k++)
                printf("light %d at %.9g: %.9g\n", fragment->points[p].lights[k].light,
                       (double)fragment->points[p].lights[k].distance, (double)fragment->points[p].lights[k].n_dot_l);
    }
    lam_explanation_free(explained);
    lam_shader *shader = lam_shader_make(scene, &camera, &params, 160, 120, -1, NULL, error);
    for (int i = 0; shader && i < shader->draw_count; i++)
        printf("shader draw of object %d: %s, %s\n", shader->draws[i].object, shader->draws[i].uniforms[0].name,
               shader->draws[i].uniforms[1].name);
    bool ok = explained && shader;
    lam_shader_free(shader);
    return ok;
}

static bool use(const char *path, lam_error *error)
{
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, error);
    lam_load_params params = {.threads = 1, .color = LAM_COLOR_SRGB};
    lam_scene *scene = device ? lam_scene_load(path, &params, NULL, error) : NULL;
    bool ok = scene && build_scene(scene, error) && draw(device, scene, error);
    for (int i = 0; ok && i < lam_scene_mesh_count(scene); i++)
        if (lam_scene_mesh(scene, i)->parts)
            printf("the first parts of mesh %d: %u triangles\n", i, lam_scene_mesh(scene, i)->parts[0].triangle_count);
    lam_image image = {0};
    ok = ok && lam_render("torus-knot", &(lam_render_params){.threads = 1}, &image, NULL, error);
    if (ok)
        print_image("render", &image);
    lam_image_free(&image);
    lam_scene_free(scene);
    lam_device_free(device);
    return ok;
}

#ifdef NEWER
static void expect(const char *what, bool failed, const lam_error *error)
{
    bool ok = failed && error->code == LAM_BAD_ARGUMENT && strstr(error->text, "does not know");
    printf("%s: %s\n", what, ok ? "yes" : "no");
}

static void refusals(const char *path)
{
    lam_error error = {0};
    lam_device *device = lam_device_cpu(NULL, &error);
    lam_scene *scene = lam_scene_load(path, NULL, NULL, &error);
    lam_camera good = lam_camera_fit(scene, 64, 64, NULL);
    lam_image image = {0}, made = {0};
    lam_image_make(&image, 64, 64, LAM_RGBA8, &error);
    lam_bytes bytes;
    printf("refused:\n");
#define REFUSES(what, call) (error = (lam_error){0}, expect(what, !(call), &error))
    REFUSES("lam_draw_params", lam_draw(device, scene, &good, &(lam_draw_params){.newest = 1}, &image, NULL, &error));
    REFUSES("lam_control", lam_draw(device, scene, &good, NULL, &image, &(lam_control){.newest = 1}, &error));
    lam_camera camera = good;
    camera.newest = 1;
    REFUSES("lam_camera", lam_draw(device, scene, &camera, NULL, &image, NULL, &error));
    camera = lam_camera_fit(scene, 64, 64, &(lam_view){.newest = 1});
    REFUSES("lam_view", lam_draw(device, scene, &camera, NULL, &image, NULL, &error));
    lam_image other = image;
    other.newest = 1;
    REFUSES("lam_image", lam_draw(device, scene, &good, NULL, &other, NULL, &error));
    REFUSES("lam_save_params", lam_image_encode(&image, "png", &(lam_save_params){.newest = 1}, &bytes, &error));
    REFUSES("lam_image of lam_image_compare", lam_image_compare(&image, &other, &(lam_difference){0}, &error));
    REFUSES("lam_cpu_params", lam_device_cpu(&(lam_cpu_params){.newest = 1}, &error));
    REFUSES("lam_load_params", lam_scene_load(path, &(lam_load_params){.newest = 1}, NULL, &error));
    REFUSES("lam_control of lam_scene_load", lam_scene_load(path, NULL, &(lam_control){.newest = 1}, &error));
    REFUSES("lam_draw_params of lam_explain",
            lam_explain(device, scene, &good, &(lam_draw_params){.newest = 1}, 64, 64, LAM_RGBA8, 1, 1, NULL, &error));
    REFUSES("lam_shader_params",
            lam_shader_make(scene, &good, NULL, 64, 64, -1, &(lam_shader_params){.newest = 1}, &error));
    lam_material material = lam_material_default();
    material.newest = 1;
    REFUSES("lam_material", lam_scene_add_material(scene, &material, &error) >= 0);
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    light.newest = 1;
    REFUSES("lam_light", lam_scene_add_light(scene, &light, &error) >= 0);
    lam_object object = lam_object_default();
    object.newest = 1;
    REFUSES("lam_object", lam_scene_add_object(scene, &object, &error) >= 0);
    lam_mesh mesh = *lam_scene_mesh(scene, 0);
    mesh.newest = 1;
    REFUSES("lam_mesh", lam_scene_add_mesh(scene, &mesh, &error) >= 0);
    REFUSES("lam_shape_params", lam_scene_add_shape(scene, "cube", &(lam_shape_params){.newest = 1}, &error) >= 0);
    REFUSES("lam_parametric", lam_scene_add_parametric(scene, &(lam_parametric){.newest = 1}, NULL, &error) >= 0);
    REFUSES("lam_implicit", lam_scene_add_implicit(scene, &(lam_implicit){.newest = 1}, NULL, &error) >= 0);
    REFUSES("lam_picture_settings",
            lam_scene_save(scene, &(lam_picture_settings){.newest = 1}, "/nowhere/scene.json", &error));
    REFUSES("lam_render_params", lam_render(path, &(lam_render_params){.newest = 1}, &made, NULL, &error));
    lam_material mapped = lam_material_default();
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_COLOR, NULL, &error);
    mapped.maps[LAM_MAP_DIFFUSE] = &(lam_texture_map){.texture = texture, .newest = 1};
    REFUSES("lam_texture_map", lam_scene_add_material(scene, &mapped, &error) >= 0);
    lam_texture_free(texture);
    lam_mesh parted = *lam_scene_mesh(scene, 0);
    lam_part part = {.triangle_count = parted.triangle_count, .material = -1, .newest = 1};
    parted.parts = &part;
    parted.part_count = 1;
    REFUSES("lam_part", lam_scene_add_mesh(scene, &parted, &error) >= 0);
    REFUSES("lam_section",
            lam_scene_set_sections(scene, &(lam_section){.normal = {1, 0, 0}, .newest = 1}, 1, NULL, &error));
    lam_orbit orbit = lam_orbit_of(&good, scene);
    orbit.newest = 1;
    camera = lam_orbit_camera(&orbit);
    REFUSES("lam_orbit", lam_draw(device, scene, &camera, NULL, &image, NULL, &error));
    REFUSES("lam_animation_params", lam_animation_make("png", 8, 8, &(lam_animation_params){.newest = 1}, &error));
    REFUSES(
        "lam_save_params of lam_animation_make",
        lam_animation_make("png", 8, 8, &(lam_animation_params){.frames = &(lam_save_params){.newest = 1}}, &error));
    REFUSES("lam_export_params", lam_scene_export(scene, "glb", &(lam_export_params){.newest = 1}, &error));
    camera = good;
    camera.newest = 1;
    REFUSES("lam_camera of lam_scene_export",
            lam_scene_export(scene, "glb", &(lam_export_params){.camera = &camera}, &error));
    REFUSES("lam_image of lam_scene_export",
            lam_scene_export(scene, "glb", &(lam_export_params){.thumbnail = &other}, &error));
    REFUSES("lam_formula",
            lam_scene_add_formula(scene, &(lam_formula){.text = "x=u;y=v;z=0", .newest = 1}, NULL, &error) >= 0);
    REFUSES("lam_light_text_params",
            lam_scene_add_light_text(scene, "point", &(lam_light_text_params){.newest = 1}, &error) >= 0);
    REFUSES("lam_pick_pixel", lam_pick(scene, &good, NULL, &(lam_pick_pixel){.width = 8, .height = 8, .newest = 1},
                                       NULL, &(lam_picked){0}, &error));
    REFUSES("lam_gl_params", lam_device_gl(&(lam_gl_params){.newest = 1}, &error));
    REFUSES("lam_gl_params of lam_gl_devices", lam_gl_devices(&(lam_gl_params){.newest = 1}, NULL, 0, &error) >= 0);
    lam_image floats = {0};
    lam_image_make(&floats, 8, 8, LAM_RGBA32F, &error);
    REFUSES("lam_layer", lam_image_encode_layers(&(lam_layer){.image = &floats, .newest = 1}, 1, &bytes, &error));
    REFUSES("lam_check_params", lam_check_run(&(lam_check_params){.fragment = "void main() {}", .newest = 1},
                                              &(lam_check_report){0}, &error));
    REFUSES(
        "lam_check_params of lam_check_contract_write",
        lam_check_contract_write(&(lam_check_params){.fragment = "void main() {}", .newest = 1}, NULL, &bytes, &error));
    REFUSES("lam_camera of lam_pick",
            lam_pick(scene, &camera, NULL, &(lam_pick_pixel){.width = 8, .height = 8}, NULL, &(lam_picked){0}, &error));
    REFUSES("lam_camera of lam_shader_make", lam_shader_make(scene, &camera, NULL, 64, 64, -1, NULL, &error));
    REFUSES("lam_camera of lam_scene_add_light_text",
            lam_scene_add_light_text(scene, "point", &(lam_light_text_params){.camera = &camera}, &error) >= 0);
    lam_check_painter painter = {.newest = 1};
    REFUSES("lam_check_painter",
            lam_check_run(&(lam_check_params){.fragment = "#version 330 core\nout vec4 c; void main() { c = vec4(1); }",
                                              .painter = &painter},
                          &(lam_check_report){0}, &error));
    lam_image_free(&floats);
    lam_image_free(&image);
    lam_scene_free(scene);
    lam_device_free(device);
}
#endif

int main(int argc, char **argv)
{
    lam_error error = {LAM_BAD_ARGUMENT, "usage: versions MODEL"};
    if (argc != 2 || !use(argv[1], &error)) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
#ifdef NEWER
    refusals(argv[1]);
#endif
    return 0;
}
