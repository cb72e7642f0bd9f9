// plain_picture.c: draws pictures that need no effects, and prints a hash of each. Linked with the whole library it is
// `plain-picture`, and with the library without effects `plain-picture-without`; tests/effects/run.py compares both.
// With an argument, it asks for each effect and prints the error.
#include <lambent/lambent.h>

#include <stdio.h>
#include <stdlib.h>

#include "fnv.h"

enum { SIDE = 96 };

static lam_error error;

static lam_scene *teapot(bool lights)
{
    lam_scene *scene = lam_scene_make(&error);
    lam_object object = lam_object_default();
    lam_material material = lam_material_default();
    material.diffuse = (lam_rgba){0.8f, 0.3f, 0.2f, 1};
    object.material = lam_scene_add_material(scene, &material, &error);
    object.mesh = lam_scene_add_shape(scene, "teapot", NULL, &error);
    lam_scene_add_object(scene, &object, &error);
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    for (int i = 0; lights && i < 3; i++) {
        light.position = (lam_vec3){4 - 3 * i, 3 + i, 4};
        light.diffuse = (lam_rgb){1, 0.5f * (float)i, 0.3f};
        lam_scene_add_light(scene, &light, &error);
    }
    return scene;
}

static bool draw(bool lights, const lam_draw_params *params, lam_isa isa, uint64_t *hash)
{
    lam_scene *scene = teapot(lights);
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.isa = isa}, &error);
    lam_camera camera = lam_camera_fit(scene, SIDE, SIDE, NULL);
    lam_image image = {0};
    bool ok = device && lam_image_make(&image, SIDE, SIDE, LAM_RGBA8, &error) &&
              lam_draw(device, scene, &camera, params, &image, NULL, &error);
    if (ok && hash)
        *hash = hash_of(image.pixels, (size_t)SIDE * SIDE * 4);
    lam_image_free(&image);
    lam_device_free(device);
    lam_scene_free(scene);
    return ok;
}

// Prints what becomes of a request for an effect.
static void ask(const char *what, bool ok)
{
    printf("%s: %d %s\n", what, ok ? 0 : (int)error.code, ok ? "" : error.text);
}

static void ask_for_effects(void)
{
    ask("shadows", draw(true, &(lam_draw_params){.shadows = true}, LAM_ISA_AUTO, NULL));
    ask("ground", draw(true, &(lam_draw_params){.ground = LAM_GROUND_CHECKER}, LAM_ISA_AUTO, NULL));
    ask("edges", draw(true, &(lam_draw_params){.edges = LAM_EDGES_CREASE}, LAM_ISA_AUTO, NULL));
    ask("wireframe", draw(true, &(lam_draw_params){.wireframe = true}, LAM_ISA_AUTO, NULL));
    ask("occlusion", draw(true, &(lam_draw_params){.occlusion = LAM_OCCLUSION_SCREEN}, LAM_ISA_AUTO, NULL));
    ask("bounces", draw(true, &(lam_draw_params){.bounces = 1, .paths = 1}, LAM_ISA_AUTO, NULL));
    ask("rays", draw(true, &(lam_draw_params){.occlusion = LAM_OCCLUSION_RAYS}, LAM_ISA_AUTO, NULL));
    ask("cavity", draw(true, &(lam_draw_params){.cavity = LAM_CAVITY_ON}, LAM_ISA_AUTO, NULL));
    lam_environment *environment = lam_environment_built_in("studio", &error);
    ask("environment", environment != NULL);
    lam_environment_free(environment);
}

int main(int argc, char **argv)
{
    (void)argv;
    static const lam_shading shadings[] = {LAM_SHADING_PHONG, LAM_SHADING_GOURAUD, LAM_SHADING_FLAT};
    for (int isa = LAM_ISA_AUTO; isa < LAM_ISA_COUNT; isa++)
        for (int i = 0; i < 3 && lam_isa_usable((lam_isa)isa); i++)
            for (int model = LAM_REFLECTION_AUTO; model < LAM_REFLECTION_COUNT; model++) {
                lam_draw_params params = {.shading = shadings[i],
                                          .reflection = (lam_reflection)model,
                                          .occlusion = LAM_OCCLUSION_OFF,
                                          .cavity = LAM_CAVITY_OFF};
                uint64_t hash = 0;
                if (!draw(true, &params, (lam_isa)isa, &hash))
                    return fprintf(stderr, "%s\n", error.text), 1;
                printf("%s %d %d %016llx\n", lam_isa_name((lam_isa)isa), i, model, (unsigned long long)hash);
            }
    if (argc > 1)
        ask_for_effects();
    ask("default look", draw(false, NULL, LAM_ISA_AUTO, NULL));
    return 0;
}
