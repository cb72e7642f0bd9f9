// job_scene.c: applies the options for materials, rotations and lights to a loaded model.
#include "job_steps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/light.h>
#include <lambent/words.h>

#include "options.h"
#include "console.h"
#include "environment_option.h"
#include "light_place.h"
#include "material_apply.h"

// --- materials

// Metals that are only named reflect the studio, unless an option requires the classic values.
static bool mirror_metals(const struct options *o, lam_scene *scene, lam_error *error)
{
    lam_draw_params draw = o->draw;
    bool lit = o->lighting.has_rig || o->lighting.lights.count || environment_option_is_none(o->shading.environment);
    draw.rig = lit ? LAM_RIG_STUDIO : LAM_RIG_AUTO;
    draw.color = (lam_color_mode)o->picture.color_mode;
    return lam_scene_mirror_metals(scene, &draw, error);
}

// Returns whether the materials of the options come from a look, and a scene file describes its own. These replace the
// look's, like --material.
static bool file_describes_materials(const struct options *o, const lam_scene *scene)
{
    bool described = false;
    for (int i = 0; i < lam_scene_object_count(scene); i++)
        described |= lam_scene_object(scene, i)->material >= 0;
    return described && o->by_look[option_find("material") - option_table] &&
           strcmp(lam_scene_format(scene), "scene") == 0;
}

static bool set_materials(const struct texts *texts, bool back, const char *name, const struct options *o,
                          lam_scene *scene, lam_error *error)
{
    for (int i = 0; i < texts->count; i++) {
        struct material_option option;
        if (!material_option_parse(texts->items[i], (lam_color_mode)o->picture.color_mode, &option, error))
            return false;
        if (!material_option_set(&option, back, name, scene, error))
            return false;
        material_option_warn(&option, name, scene);
    }
    return true;
}

// Warns that colours of vertices and triangles multiply the materials' colours.
static void warn_of_own_colors(lam_scene *scene)
{
    for (int i = 0; i < lam_scene_mesh_count(scene); i++)
        if (lam_scene_mesh(scene, i)->colors) {
            lam_scene_add_warning(scene, "option '--color': the model's own colours multiply this colour");
            return;
        }
}

static bool set_color(const struct options *o, lam_scene *scene, lam_error *error)
{
    char *text;
    struct material_option color;
    if (asprintf(&text, "color=%s", o->material.model_color) < 0)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = material_option_parse(text, (lam_color_mode)o->picture.color_mode, &color, error) &&
              material_option_set(&color, false, "color", scene, error);
    free(text);
    warn_of_own_colors(scene);
    return ok;
}

// Moves each object away from the middle of the visible objects (--explode).
static bool explode(lam_vec3 by, lam_scene *scene, lam_error *error)
{
    lam_vec3 low, high, middle;
    double radius;
    if ((by.x == 0 && by.y == 0 && by.z == 0) || !lam_scene_bounds(scene, &low, &high))
        return true;
    if (lam_scene_object_count(scene) < 2)
        lam_scene_add_warning(scene, "option '--explode' changes nothing: the model has only one part");
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        lam_object object = *lam_scene_object(scene, i);
        double(*m)[4] = object.transform.m;
        lam_scene_sphere(scene, i, &middle, &radius);
        const double at[3] = {middle.x, middle.y, middle.z}, factors[3] = {by.x, by.y, by.z},
                     from[3] = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)};
        for (int k = 0; k < 3; k++)
            m[k][3] += factors[k] * (m[k][0] * at[0] + m[k][1] * at[1] + m[k][2] * at[2] + m[k][3] - from[k]);
        if (!lam_scene_set_object(scene, i, &object, error))
            return false;
    }
    return true;
}

// Sets colour, shininess and opacity before the back materials, because some back materials are copies of front
// materials.
static bool apply_materials(const struct job *job, lam_error *error)
{
    const struct options *o = job->options;
    lam_scene *scene = job->scene;
    if ((!file_describes_materials(o, scene) &&
         !set_materials(&o->material.materials, false, "material", o, scene, error)) ||
        (o->material.model_color && !set_color(o, scene, error)))
        return false;
    char text[100] = "", *at = text;
    if (o->material.has_shininess)
        at += sprintf(at, "shininess=%.17g,", o->material.shininess);
    if (o->material.has_opacity)
        at += sprintf(at, "opacity=%.17g,", o->material.opacity);
    if (at > text) {
        at[-1] = 0;
        struct material_option plain;
        if (!material_option_parse(text, (lam_color_mode)o->picture.color_mode, &plain, error) ||
            !material_option_set(&plain, false, "shininess", scene, error))
            return false;
    }
    if (!set_materials(&o->material.back_materials, true, "back-material", o, scene, error) ||
        !mirror_metals(o, scene, error))
        return false;
    for (int i = 0; i < o->material.hidden.count; i++)
        if (!material_option_hide(o->material.hidden.items[i], job->one_of_many, scene, error))
            return false;
    return (!o->material.only.count || material_option_only(&o->material.only, job->one_of_many, scene, error)) &&
           explode(o->view.explode, scene, error);
}

static bool apply_sides(const struct options *o, lam_scene *scene, lam_error *error)
{
    if (!o->shading.two_sided && !o->shading.one_sided && !o->shading.has_cull)
        return true;
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        lam_object object = *lam_scene_object(scene, i);
        if (o->shading.two_sided || o->shading.one_sided)
            object.one_sided = o->shading.one_sided;
        if (o->shading.has_cull)
            object.cull = (lam_cull)o->shading.cull;
        if (!lam_scene_set_object(scene, i, &object, error))
            return false;
    }
    return true;
}

// --- the rig

// Adds the lights of the rig to the scene, and selects the rig's tone curve.
static bool add_rig(struct job *job, lam_error *error)
{
    lam_light lights[LAM_RIG_LIGHTS_MAX];
    lam_draw_params draw = draw_params_of(job->options, job->rig);
    job->own.draw.tone = lam_draw_tone(job->scene, &draw);
    int count = lam_scene_rig_lights(job->scene, job->rig, job->options->draw.ground, lights);
    for (int i = 0; i < count; i++)
        if (lam_scene_add_light(job->scene, &lights[i], error) < 0)
            return false;
    return true;
}

static bool lit_by_environment(const struct job *job)
{
    lam_light lights[LAM_RIG_LIGHTS_MAX];
    return job->rig == LAM_RIG_AUTO && lam_scene_light_count(job->scene) == 0 &&
           lam_scene_rig_lights(job->scene, LAM_RIG_AUTO, false, lights) == 0;
}

// Sets the studio environment. Drawing would not set this environment, because the options add lights to the scene.
static bool set_studio(const struct job *job, lam_error *error)
{
    return lam_scene_environment(job->scene) ||
           environment_cache_set(job->environments, "studio", LAM_COLOR_SRGB, job->scene, 0, NULL, error);
}

// Chooses between the model's lights and the lights of a rig. If no option changes the rig's lights, drawing adds them
// later. Otherwise this function adds them to the scene, around the model in its current position.
static bool apply_rig(struct job *job, lam_error *error)
{
    const struct options *o = job->options;
    bool replaces = false;
    for (int i = 0; i < o->lighting.lights.count; i++)
        replaces |= o->lighting.lights.items[i][0] != '+';
    job->rig = o->lighting.has_rig && o->lighting.rig < RIG_DARK ? (lam_rig)o->lighting.rig : LAM_RIG_AUTO;
    if (option_given(o, "rig") && o->lighting.rig == (int)LAM_RIG_NONE && lam_scene_light_count(job->scene) == 0 &&
        o->lighting.lights.count == 0 && !lam_scene_environment(job->scene))
        lam_scene_add_warning(job->scene, "option '--rig file': the model has no lights");
    // A scene file with lights sets the rig, unless the command line does.
    bool by_file = (job->settings.present & LAM_SETTING_LIGHTS) && !option_given(o, "rig");
    bool dark = o->lighting.rig == RIG_DARK || (replaces && (!o->lighting.has_rig || by_file));
    bool named = o->lighting.has_rig && job->rig != LAM_RIG_AUTO && job->rig != LAM_RIG_NONE;
    if (dark || named || o->lighting.rig == RIG_DEFAULT)
        lam_scene_clear_lights(job->scene);
    if (dark)
        job->rig = LAM_RIG_NONE;
    bool classic =
        o->draw.reflection != LAM_REFLECTION_AUTO && !lam_reflection_describe(o->draw.reflection)->microfacet;
    bool no_environment = environment_option_is_none(o->shading.environment);
    if (job->rig == LAM_RIG_AUTO && (classic || no_environment) && lam_scene_light_count(job->scene) == 0)
        job->rig = LAM_RIG_STUDIO; // otherwise, the studio environment would light physical models
    const char *format = lam_scene_format(job->scene);
    job->file_lights = lam_scene_light_count(job->scene) > 0 &&
                       (strcmp(format, "gltf") == 0 ||
                        (strcmp(format, "scene") == 0 && !(job->settings.present & LAM_SETTING_LIGHTS)));
    job->studio = lit_by_environment(job);
    bool as_it_is = !o->lighting.lights.count && !o->lighting.has_light_scale && !o->shading.rotations.count &&
                    !o->animation.place_lights;
    if (job->rig == LAM_RIG_NONE || as_it_is)
        return true;
    bool ok = (!job->studio || set_studio(job, error)) && add_rig(job, error);
    job->rig = LAM_RIG_NONE;
    return ok;
}

bool job_turn_axis(const struct options *o, lam_vec3 *axis)
{
    int own = o->shading.rotations.count, count = own + o->shading.sheet_rotations.count;
    for (int i = 0; i < count; i++) {
        lam_vec3 one;
        double angle_deg;
        rotation_parse(i < own ? o->shading.rotations.items[i] : o->shading.sheet_rotations.items[i - own], &one,
                       &angle_deg);
        if (i == 0)
            *axis = one;
        else if (one.x != axis->x || one.y != axis->y || one.z != axis->z)
            *axis = (lam_vec3){0, 0, 0};
    }
    return count > 0;
}

bool job_turn(struct job *job, const struct model_sphere *sphere, lam_error *error)
{
    const struct options *o = job->options;
    for (int i = 0; i < o->shading.rotations.count; i++) {
        lam_vec3 axis;
        double angle_deg;
        // The text is always valid, because store_rotation has parsed it.
        rotation_parse(o->shading.rotations.items[i], &axis, &angle_deg);
        if (!lam_scene_rotate(job->scene, sphere->centre, axis, radians(angle_deg), error))
            return false;
    }
    return true;
}

// Warns if the camera sees no cut surface.
static void warn_unseen(const struct job *job, const lam_section *section, const char *text)
{
    const lam_vec3 n = section->normal, eye = job->camera.eye, target = job->camera.target;
    lam_vec3 low, high;
    if (eye.x == target.x && eye.y == target.y && eye.z == target.z) // no camera yet
        return;
    lam_scene_bounds(job->scene, &low, &high);
    const double beyond = n.x * (eye.x - (n.x > 0 ? high.x : low.x)) + n.y * (eye.y - (n.y > 0 ? high.y : low.y)) +
                          n.z * (eye.z - (n.z > 0 ? high.z : low.z));
    const char *sign = *text == '-' ? "" : "-";
    char note[160];
    snprintf(note, sizeof note, "the camera does not see the section %.40s; %s%.40s removes the other side", text, sign,
             text + (*text == '-'));
    if (beyond < 0 && !strchr(text, ',') && job->view_count <= 1)
        lam_scene_add_warning(job->scene, note);
}

bool job_section(struct job *job, const lam_control *control, lam_error *error)
{
    const struct texts *texts = &job->options->model.sections;
    lam_section sections[LAM_SECTIONS_MAX] = {0};
    int count = 0;
    if (!texts->count)
        return !job->settings.section_count ||
               lam_scene_set_sections(job->scene, job->settings.sections, job->settings.section_count, control, error);
    for (int i = 0; i < texts->count; i++) // "none" removes those before it
        if (strcmp(texts->items[i], "none") == 0)
            count = 0;
        else if (!lam_section_parse(texts->items[i], (lam_color_mode)job->options->picture.color_mode,
                                    &sections[count++], error))
            return false;
    if (!lam_scene_set_sections(job->scene, sections, count, control, error))
        return false;
    if (count == 1)
        warn_unseen(job, &sections[0], texts->items[texts->count - 1]);
    return true;
}

bool job_apply_options(struct job *job, const lam_control *control, struct model_sphere *sphere, lam_error *error)
{
    const struct options *o = job->options;
    lam_scene *scene = job->scene;
    *sphere = (struct model_sphere){.radius = 1};
    lam_vec3 axis;
    if (o->lighting.lights.count || job_turn_axis(o, &axis))
        lam_scene_sphere(scene, -1, &sphere->centre, &sphere->radius);
    if (!(sphere->radius > 0))
        sphere->radius = 1;
    bool threads = lam_reflection_describe(o->draw.reflection)->tangents;
    return apply_materials(job, error) && apply_sides(o, scene, error) && apply_rig(job, error) &&
           (!threads || lam_scene_make_tangents(scene, control, error));
}

// --- lights that may depend on the camera

static bool scale_lights(lam_scene *scene, double factor, lam_error *error)
{
    for (int i = 0; i < lam_scene_light_count(scene); i++) {
        lam_light light = *lam_scene_light(scene, i);
        light_brighten(&light, factor);
        if (!lam_scene_set_light(scene, i, &light, error))
            return false;
    }
    return true;
}

bool job_light(struct job *job, const struct model_sphere *sphere, lam_error *error)
{
    const struct options *o = job->options;
    lam_light_text_params params = {.color = (lam_color_mode)o->picture.color_mode,
                                    .camera = &job->camera,
                                    .centre = sphere->centre,
                                    .radius = sphere->radius};
    for (int i = 0; i < o->lighting.lights.count; i++) {
        const char *text = o->lighting.lights.items[i];
        lam_error reason;
        if (strcmp(text, "none") != 0 &&
            lam_scene_add_light_text(job->scene, text + (*text == '+'), &params, &reason) < 0)
            return complain(error, reason.code, "option '--light': %s", reason.text);
    }
    if (o->lighting.ambient) {
        lam_rgba color;
        if (!lam_color_parse(o->lighting.ambient, (lam_color_mode)o->picture.color_mode, &color, error))
            return false;
        lam_scene_set_ambient(job->scene, (lam_rgb){color.r, color.g, color.b});
    }
    return !o->lighting.has_light_scale || scale_lights(job->scene, o->lighting.light_scale, error);
}

// --- notes about glass

static bool is_grey(float r, float g, float b) { return r == g && g == b; }

static bool colors_light(const lam_material *m)
{
    return m->physical && m->transmission > 0 && m->metallic < 1 &&
           (!is_grey(m->diffuse.r, m->diffuse.g, m->diffuse.b) || m->maps[LAM_MAP_DIFFUSE] ||
            (m->thickness > 0 && m->attenuation_distance > 0 &&
             !is_grey(m->attenuation_color.r, m->attenuation_color.g, m->attenuation_color.b)));
}

static bool is_shown(const lam_draw_params *draw)
{
    bool other = draw->reflection != LAM_REFLECTION_AUTO && !lam_reflection_describe(draw->reflection)->microfacet;
    return draw->shading == LAM_SHADING_PHONG && !other;
}

// Warns that only some drawing methods show glass, or that the tint of glass is only correct over white.
void job_note_glass(struct job *job, const lam_draw_params *draw)
{
    for (int i = 0; !is_shown(draw) && i < lam_scene_material_count(job->scene); i++)
        if (lam_scene_material(job->scene, i)->physical && lam_scene_material(job->scene, i)->transmission > 0) {
            lam_scene_add_warning(
                job->scene, "glass is drawn opaque: only Phong shading with a physical reflection model shows it");
            return;
        }
    if (draw->background.a > 0 || draw->background_environment > 0 || draw->output != LAM_OUTPUT_PICTURE)
        return;
    for (int i = 0; i < lam_scene_material_count(job->scene); i++)
        if (colors_light(lam_scene_material(job->scene, i))) {
            lam_scene_add_warning(job->scene, "the transparent picture of coloured glass is correct only over white; "
                                              "for another background, add --background COLOUR");
            return;
        }
}

// --- drawing

// Returns the colour in `text`, which the command line has checked, or `otherwise` if `text` is NULL. Ignores
// everything after a comma.
static lam_rgba color_or(const char *text, int mode, lam_rgba otherwise)
{
    lam_rgba color;
    lam_error unused;
    char alone[80];
    snprintf(alone, sizeof alone, "%.*s", text ? (int)strcspn(text, ",") : 0, text ? text : "");
    return text && lam_color_parse(alone, (lam_color_mode)mode, &color, &unused) ? color : otherwise;
}

lam_draw_params draw_params_of(const struct options *o, lam_rig rig)
{
    lam_draw_params draw = o->draw;
    bool by_vertex = draw.stage == LAM_STAGE_APPLICATION || draw.stage == LAM_STAGE_VERTEX;
    if (!o->shading.has_shading)
        draw.shading = by_vertex ? LAM_SHADING_GOURAUD : LAM_SHADING_PHONG;
    draw.color = (lam_color_mode)o->picture.color_mode;
    draw.exposure = o->picture.exposure_kind == EXPOSURE_LITERAL ? o->picture.exposure : 0;
    // If the user chooses an exposure or a colour, the picture uses exactly that value.
    if (o->picture.exposure_kind != EXPOSURE_BY_FILE || o->material.model_color || o->material.materials.count)
        draw.brighten = LAM_BRIGHTEN_OFF;
    if (o->shader.lecture_device && !draw.tone)
        draw.tone = LAM_TONE_NONE; // lecture shaders have no tone curve
    draw.rig = rig;
    if (o->picture.background && !background_environment(o->picture.background, &draw.background_environment))
        draw.background_environment = 0;
    draw.edge_color = color_or(o->shading.edge_color, o->picture.color_mode, draw.edge_color);
    draw.wireframe_color = color_or(o->shading.wireframe_color, o->picture.color_mode, draw.wireframe_color);
    lam_rgba ground = {draw.ground_color.r, draw.ground_color.g, draw.ground_color.b, 1};
    ground = color_or(o->shading.ground_color, o->picture.color_mode, ground);
    draw.ground_color = (lam_rgb){ground.r, ground.g, ground.b};
    return draw;
}
