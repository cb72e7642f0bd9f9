// threemf.c: the 3MF importer: recognises the format, finds the model and runs the steps (threemf.h has the overview).
#include "threemf.h"

#include "fail.h"
#include "shown_name.h"
#include "threemf_xml.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

// Recognises a ZIP archive that contains a model part and the relationships that refer to this part. File names in a
// ZIP archive are not compressed.
static int threemf_probe(const uint8_t *bytes, size_t size, size_t file_size)
{
    (void)file_size;
    static const char relationships[] = "_rels/.rels", model[] = ".model";
    bool found = size > 4 && memcmp(bytes, "PK\3\4", 4) == 0 &&
                 memmem(bytes, size, relationships, sizeof relationships - 1) &&
                 memmem(bytes, size, model, sizeof model - 1);
    return found ? 2 : size >= 2 && memcmp(bytes, "PK", 2) == 0; // for other ZIP archives, the extension .3mf decides
}

#ifdef HAVE_3MF

// --- the relationships of the package

enum { IN_RELATIONSHIPS, IN_RELATIONSHIP };

// Stores the target of the relationship to the model in xml->user.
static bool begin_relationship(struct threemf_xml *xml, const char *const *attributes)
{
    static const char wanted[] = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
    const char *type = threemf_attribute(attributes, "Type");
    const char *target = threemf_attribute(attributes, "Target");
    const char *mode = threemf_attribute(attributes, "TargetMode");
    const char **model = xml->user;
    if (!type || strcmp(type, wanted) != 0)
        return true;
    if (!target || !*target || (mode && strcmp(mode, "Internal") != 0))
        return threemf_xml_fail(xml, "the model's relationship names no part of this file");
    if (*model)
        return threemf_xml_fail(xml, "found a second 3D model, expected one");
    *model = arena_string(xml->file->scratch, target);
    return *model || threemf_no_memory(xml->file, strlen(target));
}

static const char *find_model(struct threemf *file)
{
    static const struct threemf_element elements[] = {
        [IN_RELATIONSHIPS] = {NS_RELATIONSHIPS, "Relationships", -1, NULL, NULL},
        [IN_RELATIONSHIP] = {NS_RELATIONSHIPS, "Relationship", IN_RELATIONSHIPS, begin_relationship, NULL},
    };
    const char *model = NULL;
    struct threemf_xml xml = {
        .file = file, .part = "_rels/.rels", .elements = elements, .element_count = 2, .user = &model};
    if (!threemf_xml_parse(&xml))
        return NULL;
    if (!model)
        fail(file->error, LAM_CANNOT_READ, "%s: _rels/.rels names no 3D model, so this is not a 3MF file",
             file->source->name);
    return model;
}

// --- loading

// Lists the kinds of volumes and objects that were left out, as "modifiers (2), negative volumes (1)".
static void list_left_out(const struct threemf *file, char *out, size_t size)
{
    static const char *const names[ROLES] = {[MODIFIER] = "modifiers",
                                             [SUPPORT_ENFORCER] = "support enforcers",
                                             [SUPPORT_BLOCKER] = "support blockers",
                                             [NEGATIVE] = "negative volumes",
                                             [OTHER] = "objects of the type \"other\"",
                                             [SWITCHED_OFF] = "items with printable=\"0\""};
    *out = 0;
    for (int i = MODIFIER; i < ROLES; i++)
        if (file->left_out[i])
            snprintf(out + strlen(out), size - strlen(out), "%s%s (%zu)", *out ? ", " : "", names[i],
                     file->left_out[i]);
}

// Fails because there is nothing to draw. The sentence names the program that wrote the file.
static bool fail_empty(struct threemf *file, const struct threemf_part *root, const char *left_out)
{
    const char *name = file->source->name, *writer = file->scene->file.generator;
    const char *code = threemf_package_find(file, ".gcode"), *picture = threemf_package_find(file, ".png");
    char shown[3][SHOWN_NAME_SIZE], by[SHOWN_NAME_SIZE + 16] = "";
    if (writer)
        snprintf(by, sizeof by, " (written by %s)", shown_name(writer, shown[0]));
    else if (code && strncmp(code, "Metadata/plate_", 15) == 0) // only these two programs name G-code so
        snprintf(by, sizeof by, " (written by Bambu Studio or OrcaSlicer)");
    if (code)
        return fail(file->error, LAM_UNSUPPORTED,
                    "%s: is a sliced file%s: it contains G-code for a printer (%s) and no model%s%s", name, by,
                    shown_name(code, shown[1]), picture ? "; its picture is the part " : "",
                    picture ? shown_name(picture, shown[2]) : "");
    if (*left_out)
        return fail(file->error, LAM_CANNOT_READ, "%s: contains nothing that prints, only %s%s", name, left_out, by);
    if (!root->items.count)
        return fail(file->error, LAM_CANNOT_READ, "%s: its build contains no items, so there is nothing to draw%s",
                    name, by);
    if (file->beams)
        return fail(file->error, LAM_UNSUPPORTED,
                    "%s: its objects contain only beams (%zu) and no triangles; lambent does not draw beams", name,
                    file->beams);
    if (file->flattened)
        return fail(file->error, LAM_CANNOT_READ,
                    "%s: the transforms of all objects have no volume or are above 1e30 (%zu)", name, file->flattened);
    return fail(file->error, LAM_CANNOT_READ, "%s: the objects of its build have no triangles%s", name, by);
}

static bool report_skipped(struct threemf *file, const struct threemf_part *root)
{
    const char *name = file->source->name;
    char left_out[400];
    list_left_out(file, left_out, sizeof left_out);
    if (!file->scene->objects.count)
        return fail_empty(file, root, left_out);
    if (*left_out)
        scene_warn(file->scene, "%s: not drawn, because they do not print: %s", name, left_out);
    if (file->uncolored)
        scene_warn(file->scene, "%s: names no colours for the filaments that it uses; drawn in the default colour",
                   name);
    if (file->flattened)
        scene_warn(file->scene, "%s: not drawn: objects whose transform has no volume or is above 1e30 (%zu)", name,
                   file->flattened);
    if (file->beams)
        scene_warn(file->scene, "%s: not drawn: the beams of its lattices (%zu)", name, file->beams);
    if (file->sliced)
        scene_warn(
            file->scene,
            "%s: not drawn: slices; objects with slices (%zu) are drawn by their triangles, which may be only a box",
            name, file->sliced);
    if (file->multiplied_layers)
        scene_warn(
            file->scene,
            "%s: multiproperties are drawn as colours times the first texture, without mixing their layers (%zu)", name,
            file->multiplied_layers);
    return true;
}

static bool read_all(struct threemf *file)
{
    if (!threemf_package_open(file) || !threemf_xml_open(file))
        return false;
    const char *path = find_model(file);
    if (!path || !threemf_slicer_read(file))
        return false;
    struct threemf_part *root = threemf_part_at(file, path);
    if (!root || !threemf_build(file, root) || !report_skipped(file, root))
        return false;
    file->scene->file.unit_m = root->unit_m;
    return true;
}

static bool threemf_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    struct arena scratch;
    lam_error unwanted;
    if (!import_whole(source, error))
        return false;
    arena_start(&scratch, source->call);
    struct threemf file = {.source = source,
                           .scene = scene,
                           .scratch = &scratch,
                           .error = error ? error : &unwanted,
                           .part_names = {.memory = &scratch},
                           .entry_names = {.memory = &scratch}};
    errno = 0;
    bool ok = read_all(&file);
    // If memory runs out, opening a library fails.
    if (!ok && errno == ENOMEM && file.error->code != LAM_LIMIT)
        threemf_no_memory(&file, 0);
    scene->shared_arrays = true;
    struct threemf_part **parts = file.parts.items;
    for (size_t i = 0; i < file.parts.count; i++) {
        struct threemf_rows *lists[] = {&parts[i]->resources, &parts[i]->colors, &parts[i]->texcoords, &parts[i]->pairs,
                                        &parts[i]->items};
        for (size_t k = 0; k < sizeof lists / sizeof *lists; k++)
            threemf_rows_free(&file, lists[k]);
    }
    threemf_rows_free(&file, &file.parts);
    threemf_rows_free(&file, &file.volumes);
    threemf_rows_free(&file, &file.filaments);
    threemf_rows_free(&file, &file.pictures);
    threemf_package_close(&file);
    threemf_xml_close(&file);
    arena_free(&scratch);
    return ok;
}

#else // the build lacks the headers of expat

static bool threemf_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    (void)scene;
    return fail(error, LAM_UNSUPPORTED,
                "%s: this build does not support 3MF, because the Debian package libexpat1-dev was missing",
                source->name);
}

#endif

const struct importer importer_3mf = {
    .name = "3mf",
    .extensions = "3mf",
    .up = LAM_UP_Z,
    .probe = threemf_probe,
    .load = threemf_load,
};
