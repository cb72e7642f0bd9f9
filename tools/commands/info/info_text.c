// info_text.c: prints a model as text on one screen. If a list has more than ROWS + 1 rows, prints only the first ROWS
// rows and the number of omitted rows.
#include "info.h"

#include <inttypes.h>
#include <string.h>

#include <lambent/light.h>
#include <lambent/material.h>
#include <lambent/text.h>

#include "foreign.h"
#include "option_names.h"
#include "vectors.h"

enum { ROWS = 8, NAME_BYTES = 40, LINE_BYTES = 120 };

// Returns text from a file for a terminal, truncated to fewer than `bytes` bytes. Returns "" for NULL.
static const char *plain(const char *name, size_t bytes, char *out)
{
    lam_utf8_show(name ? name : "", out, bytes);
    return out;
}

// Returns a name in quotes, or "" for NULL.
static const char *shown(const char *name, char out[NAME_BYTES + 12])
{
    if (!name)
        return "";
    out[0] = '\'';
    plain(name, NAME_BYTES, out + 1);
    return strcat(out, "'");
}

static const char *label(const char *text, int index) { return index == 0 ? text : ""; }

// Returns whether the row `index` of a long list is omitted. At the first omitted row, prints how many rows are
// omitted.
static bool omitted(int index, int count)
{
    if (index == ROWS && count > ROWS + 1) {
        printf("%-12s… %d more (--json lists all)\n", "", count - ROWS);
        return true;
    }
    return index > ROWS && count > ROWS + 1;
}

static const char *plural(uint64_t count) { return count == 1 ? "" : "s"; }

static void print_color(lam_rgb c)
{
    if (c.r == c.g && c.g == c.b)
        printf("%.3g", (double)c.r);
    else
        printf("%.3g/%.3g/%.3g", (double)c.r, (double)c.g, (double)c.b);
}

// --- the sections

// Returns the millimetres of a unit for a model of this size, for lengths or for areas and volumes.
static double readable_unit(double largest_mm, bool length, const char **symbol)
{
    static const char *const symbols[] = {" µm", " mm", " cm", " m", " km"};
    static const double millimetres[] = {1e-3, 1, 10, 1e3, 1e6};
    int unit = largest_mm < 1                     ? 0
               : largest_mm < (length ? 1e3 : 10) ? 1
               : largest_mm < 1e3                 ? 2
               : largest_mm < 1e6                 ? 3
                                                  : 4;
    *symbol = symbols[unit];
    return millimetres[unit];
}

// Prints areas and volumes, in the model's units if the file defines none (`largest_mm` is then 0).
static void print_measure(const lam_scene *scene, double millimetres, double largest_mm)
{
    struct info_measure measure = info_measure(scene);
    const char *unit = " units";
    double scale = largest_mm > 0 ? millimetres / readable_unit(largest_mm, false, &unit) : 1;
    const char *shape = measure.exact ? " (of the exact shape)" : "";
    if (!lam_scene_triangle_count(scene))
        return;
    printf("%-12sarea %.4g%s²", "surface", measure.area * scale * scale, unit);
    if (measure.closed)
        printf(", closed: volume %.4g%s³%s\n", measure.volume * scale * scale * scale, unit, shape);
    else
        printf(", not closed%s\n", shape);
}

static void print_sections(const struct info *info, double millimetres)
{
    double scale = millimetres > 0 ? millimetres : 1;
    for (int i = 0; i < info->section_count; i++) {
        const lam_section *s = &info->sections[i];
        printf("%-12snormal %.4g %.4g %.4g, distance %.6g%s: area %.6g%s²\n", label("sections", i), s->normal.x,
               s->normal.y, s->normal.z, s->distance * (s->relative ? 100 : 1), s->relative ? " %" : "",
               info->section_areas[i] * scale * scale, millimetres > 0 ? " mm" : " units");
    }
}

static void print_check(const struct info_print *p, double millimetres)
{
    const double scale = millimetres > 0 ? millimetres : 1;
    const char *unit = millimetres > 0 ? "mm" : "units";
    printf("%-12s%s\n", "print", p->printable ? "closed; can be printed" : "cannot be printed as it is:");
    if (!p->triangles)
        printf("%-12sit has no triangles\n", "");
    if (p->open_edges)
        printf("%-12s%d hole%s: %" PRIu64 " edge%s of only one face\n", "", p->holes, plural((uint64_t)p->holes),
               p->open_edges, plural(p->open_edges));
    for (int i = 0; i < p->holes && i < INFO_HOLES; i++)
        printf("%-12s  at %.5g %.5g %.5g, %.4g %s around\n", "", p->longest[i].middle.x, p->longest[i].middle.y,
               p->longest[i].middle.z, p->longest[i].length * scale, unit);
    if (p->holes > INFO_HOLES)
        printf("%-12s  and %d more\n", "", p->holes - INFO_HOLES);
    if (p->shared_edges)
        printf("%-12s%" PRIu64 " edge%s of more than two faces\n", "", p->shared_edges, plural(p->shared_edges));
    if (p->turned_edges)
        printf("%-12s%" PRIu64 " edge%s between faces that point to opposite sides\n", "", p->turned_edges,
               plural(p->turned_edges));
    if (p->triangles && !p->open_edges && !p->turned_edges && p->volume <= 0)
        printf("%-12sthe surface is inside out\n", "");
    printf("%-12soverhangs above %g°: %.4g %s²\n", "", p->overhang_deg, p->overhang_area * scale * scale, unit);
    if (p->printable)
        printf("%-12scentre of mass %.5g %.5g %.5g\n", "", p->mass.x, p->mass.y, p->mass.z);
}

static void print_geometry(const struct info *info)
{
    const struct job *job = info->job;
    const lam_scene *scene = job->scene;
    struct info_counts stored = info_count(scene);
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    struct info_unit unit = info_unit(scene);
    lam_vec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    double mm = unit.millimetres, largest = size.x > size.y ? size.x : size.y;
    largest = (largest > size.z ? largest : size.z) * mm;
    const char *symbol;
    double in = mm / readable_unit(largest, true, &symbol);
    printf("%-12s%.4g × %.4g × %.4g%s%s", "size", size.x, size.y, size.z, unit.name ? " " : " (unit unknown)",
           unit.name ? unit.symbol : "");
    if (largest > 0 && in != 1)
        printf(" (%.4g × %.4g × %.4g%s)", size.x * in, size.y * in, size.z * in, symbol);
    printf(", %s up\n", lam_up_name(lam_scene_up(scene)));
    printf("%-12sfrom %.6g %.6g %.6g to %.6g %.6g %.6g\n", "", low.x, low.y, low.z, high.x, high.y, high.z);
    print_measure(scene, mm, largest);
    print_sections(info, mm);
    if (info->print)
        print_check(info->print, mm);
    uint64_t triangles = lam_scene_triangle_count(scene), vertices = lam_scene_vertex_count(scene);
    uint64_t lines = lam_scene_line_count(scene), points = lam_scene_point_count(scene);
    printf("%-12s", "geometry");
    if (triangles || !(lines + points))
        printf("%" PRIu64 " triangle%s, ", triangles, plural(triangles));
    if (lines)
        printf("%" PRIu64 " line%s, ", lines, plural(lines));
    if (points)
        printf("%" PRIu64 " point%s, ", points, plural(points));
    printf("%" PRIu64 " vertices\n", vertices);
    uint64_t meshes = (uint64_t)lam_scene_mesh_count(scene), objects = (uint64_t)lam_scene_object_count(scene);
    printf("%-12s%" PRIu64 " mesh%s, %" PRIu64 " part%s, %" PRIu64 " object%s", "", meshes, meshes == 1 ? "" : "es",
           stored.parts, plural(stored.parts), objects, plural(objects));
    if (stored.triangles != triangles)
        printf("; stored: %" PRIu64 " triangles, %" PRIu64 " vertices", stored.triangles, stored.vertices);
    printf("\n%-12s%.1f MB; loaded in %.*f ms\n", "memory", (double)lam_scene_memory(scene) / 1e6,
           job->times.read + job->times.prepare < 10 ? 1 : 0, job->times.read + job->times.prepare);
    const uint64_t reader = lam_scene_file_info(scene)->reader_memory;
    if (reader)
        printf("%-12s%.1f MB at most in the process that read the file\n", "", (double)reader / 1e6);
    if (info->drawing_bytes)
        printf("%-12s%.1f MB more to draw %d×%d pixels by %d thread%s\n", "", (double)info->drawing_bytes / 1e6,
               INFO_SIDE, INFO_SIDE, info->drawing_threads, info->drawing_threads == 1 ? "" : "s");
}

static void print_factors(const lam_material *m)
{
    lam_rgb color = {m->diffuse.r, m->diffuse.g, m->diffuse.b};
    printf(m->physical ? "base " : "diffuse ");
    print_color(color);
    if (m->diffuse.a != 1)
        printf(", opacity %.3g", (double)m->diffuse.a);
    if (m->physical && !m->unlit)
        printf(", metallic %.3g, roughness %.3g", (double)m->metallic, (double)m->roughness);
    if (!m->physical && !is_black(m->specular)) {
        printf(", specular ");
        print_color(m->specular);
        printf(", shininess %.4g", (double)m->shininess);
    }
    if (!is_black(m->emission)) {
        printf(", emission ");
        print_color(m->emission);
    }
    for (int i = 0; lam_material_field(i); i++) {
        double numbers[4];
        int count = info_changed_field(lam_material_field(i), m, numbers);
        if (count)
            printf(", %s ", lam_material_field(i)->key);
        if (count == 3)
            print_color((lam_rgb){(float)numbers[0], (float)numbers[1], (float)numbers[2]});
        else if (count && lam_material_field(i)->type == LAM_FIELD_FLAG)
            printf("on");
        else if (count)
            printf("%.4g", numbers[0]);
    }
    if (m->alpha_mode == LAM_ALPHA_MASK)
        printf(", alpha mask below %.3g", (double)m->alpha_cutoff);
    else if (m->alpha_mode == LAM_ALPHA_BLEND && m->physical)
        printf(", alpha blended");
}

// Prints the names of objects, groups and parts that --hide accepts.
static void print_names_to_hide(const struct info_names *names)
{
    char name[NAME_BYTES + 12];
    for (int i = 0; i < names->count && !omitted(i, names->count); i++) {
        const struct info_name *row = &names->items[i];
        printf("%-12s%s", label("names", i), shown(row->name, name));
        if (row->objects)
            printf(", %d object%s", row->objects, plural((uint64_t)row->objects));
        if (row->groups)
            printf(", %d group%s", row->groups, plural((uint64_t)row->groups));
        if (row->parts)
            printf(", %d part%s", row->parts, plural((uint64_t)row->parts));
        printf("\n");
    }
}

static void print_materials(const lam_scene *scene)
{
    char name[NAME_BYTES + 12];
    int count = lam_scene_material_count(scene);
    for (int i = 0; i < count && !omitted(i, count); i++) {
        const lam_material *m = lam_scene_material(scene, i);
        const char *text = shown(m->name, name);
        printf("%-12s%d %s%s%s: ", label("materials", i), i, text, *text ? ", " : "", info_material_kind(m));
        print_factors(m);
        const char *before = "; maps ";
        for (int map = 0; map < LAM_MAP_COUNT; map++)
            if (m->maps[map] || m->map_names[map]) {
                printf("%s%s", before, lam_map_name((lam_map)map));
                before = ", ";
            }
        printf("\n");
    }
}

static void print_textures(const struct info_textures *textures, const char *model)
{
    char name[NAME_BYTES + 12], file[NAME_BYTES + 12];
    for (int i = 0; i < textures->count && !omitted(i, textures->count); i++) {
        const struct info_texture *texture = &textures->items[i];
        const char *path = info_texture_file(texture, model), *format = info_texture_format(texture);
        const char *text = shown(texture->image ? texture->image->name : NULL, name);
        printf("%-12s%d %s%s%s", label("textures", i), i, text, *text ? ", " : "",
               path ? shown(path, file) : "in the model");
        if (format)
            printf(", %s", plain(format, NAME_BYTES, file));
        if (!texture->texture) {
            printf("; not read\n");
            continue;
        }
        printf(", %dx%d, %s", lam_texture_width(texture->texture, 0), lam_texture_height(texture->texture, 0),
               info_color_space(texture));
        const char *before = ": ";
        for (int map = 0; map < LAM_MAP_COUNT; map++)
            if (texture->slots >> map & 1) {
                printf("%s%s", before, lam_map_name((lam_map)map));
                before = ", ";
            }
        printf("\n");
    }
}

static void print_lights(const lam_scene *scene)
{
    char name[NAME_BYTES + 12];
    int count = lam_scene_light_count(scene);
    for (int i = 0; i < count && !omitted(i, count); i++) {
        const lam_light *light = lam_scene_light(scene, i);
        const char *text = shown(light->name, name);
        double intensity;
        lam_rgb color = info_light_color(light, &intensity);
        printf("%-12s%d %s%s%s, color ", label("lights", i), i, text, *text ? ", " : "",
               lam_light_type_describe(light->type)->word);
        print_color(color);
        printf(", intensity %.4g", intensity);
        if (light->range > 0)
            printf(", range %.4g", (double)light->range);
        printf("\n");
    }
}

static void print_cameras(const lam_scene *scene)
{
    char name[NAME_BYTES + 12];
    int count = lam_scene_camera_count(scene);
    for (int i = 0; i < count && !omitted(i, count); i++) {
        lam_camera camera;
        lam_scene_camera(scene, i, &camera);
        const char *text = shown(lam_scene_camera_name(scene, i), name);
        printf("%-12s%d %s%s", label("cameras", i), i, text, *text ? ", " : "");
        if (camera.ortho_half_height > 0)
            printf("orthographic, %.4g high", 2 * camera.ortho_half_height);
        else
            printf("perspective, %.4g degrees high", in_degrees(camera.fovy_rad));
        printf(", at %.4g %.4g %.4g\n", camera.eye.x, camera.eye.y, camera.eye.z);
    }
}

static void print_names(const char *title, const char *const *names, int count, int marked, const char *mark)
{
    char name[NAME_BYTES + 12];
    for (int i = 0; i < count && !omitted(i, count); i++)
        printf("%-12s%d %s%s\n", label(title, i), i, names[i] ? shown(names[i], name) : "unnamed",
               i == marked ? mark : "");
}

static void print_file(const lam_file_info *info)
{
    char name[NAME_BYTES + 12];
    if (info->scene_count > 1)
        print_names("scenes", info->scenes, info->scene_count, info->scene, ", the scene that lambent reads");
    for (int i = 0; i < info->animation_count && !omitted(i, info->animation_count); i++) {
        const lam_file_animation *animation = &info->animations[i];
        const char *text = shown(animation->name, name);
        printf("%-12s%d %s%s%.4g s, %d channel%s\n", label("animations", i), i, text, *text ? ", " : "",
               animation->length_s, animation->channel_count, plural((uint64_t)animation->channel_count));
    }
    print_names("variants", info->variants, info->variant_count, -1, "");
    for (int i = 0; i < info->extension_count && !omitted(i, info->extension_count); i++) {
        const lam_file_extension *extension = &info->extensions[i];
        const char *host = strstr(extension->name, "://"), *path = host ? strchr(host + 3, '/') : NULL;
        printf("%-12s%s: %s%s\n", label("extensions", i), plain(path ? path + 1 : extension->name, NAME_BYTES, name),
               extension->required ? "required, " : "", info_support(extension->support));
    }
}

void info_text(const struct info *info)
{
    const struct job *job = info->job;
    const lam_scene *scene = job->scene;
    const lam_file_info *file = lam_scene_file_info(scene);
    char text[LINE_BYTES + 8];
    print_foreign(stdout, FOREIGN_TERMINAL, FOREIGN(strcmp(job->model, "-") == 0 ? "standard input" : job->model));
    printf("\n%-12s%s", "format", info_format(scene));
    if (file->version)
        printf(" %s", plain(file->version, LINE_BYTES, text));
    if (file->generator)
        printf(", written by %s", plain(file->generator, LINE_BYTES, text));
    printf("\n");
    if (file->copyright)
        printf("%-12s%s\n", "copyright", plain(file->copyright, LINE_BYTES, text));
    print_geometry(info);
    print_names_to_hide(info->names);
    print_materials(scene);
    print_textures(info->textures, job->model);
    print_lights(scene);
    print_cameras(scene);
    print_file(file);
    if (info->needs_lenient)
        printf("%-12sdrawing it needs --lenient: it requires an extension that is not known\n", "note");
    char shown[MESSAGE_SIZE];
    int count = 0;
    while (lam_scene_warning(scene, count))
        count++;
    for (int i = 0; i < count && !omitted(i, count); i++)
        printf("%-12s%s\n", label("warnings", i), name_options(lam_scene_warning(scene, i), shown));
}
