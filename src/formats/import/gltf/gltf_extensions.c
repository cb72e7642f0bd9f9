// gltf_extensions.c: checks the extensions that a file uses, and reports which of them are supported.
#include "gltf.h"

#include "gltf_json.h"

#include "fail.h"

#include <stdio.h>
#include <string.h>

#define READ    LAM_EXTENSION_READ
#define SILENT  LAM_EXTENSION_NO_EFFECT
#define IGNORED LAM_EXTENSION_IGNORED

static const struct {
    const char *name;
    lam_extension_support support;
} known[] = {
    {"EXT_mesh_gpu_instancing", READ},
    {"EXT_meshopt_compression", READ},
    {"EXT_texture_avif",
     READ}, // without libavif, a texture without a picture in another format is omitted with a warning
    {"EXT_texture_webp", READ},
    {"KHR_animation_pointer", READ},
    {"KHR_draco_mesh_compression", READ},
    {"KHR_lights_punctual", READ},
    {"KHR_materials_anisotropy", READ},
    {"KHR_materials_clearcoat", READ},
    {"KHR_materials_emissive_strength", READ},
    {"KHR_materials_ior", READ},
    {"KHR_materials_iridescence", READ},
    {"KHR_materials_pbrSpecularGlossiness", READ},
    {"KHR_materials_sheen", READ},
    {"KHR_materials_specular", READ},
    {"KHR_materials_transmission", READ},
    {"KHR_materials_unlit", READ},
    {"KHR_materials_variants", READ},
    {"KHR_materials_volume", READ},
    {"KHR_mesh_quantization", READ},
    {"KHR_meshopt_compression", READ},
    {"KHR_node_visibility", READ},
    {"KHR_texture_basisu", SILENT},
    {"KHR_texture_transform", READ},
    {"KHR_xmp", SILENT},
    {"KHR_xmp_json_ld", SILENT},
    {"MSFT_texture_dds", SILENT},
    // By convention, a name states what is extended. All other extensions may change geometry.
    {"_animation_", IGNORED},
    {"_lights_", IGNORED},
    {"_materials_", IGNORED},
    {"_physics", IGNORED},
    {"_texture_", IGNORED},
};

lam_extension_support gltf_extension_support(const char *name)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].name, name) == 0 || (*known[i].name == '_' && strstr(name, known[i].name)))
            return known[i].support;
    return LAM_EXTENSION_UNKNOWN;
}

// Parses "2.0" as 2 and 0, which are also the values if the text is missing or wrong.
static void take_version(struct gltf *gltf, const json_t *asset, const char *key, int version[2])
{
    const json_t *value = json_object_get(asset, key);
    const char *text = json_string_value(value);
    int read = 0;
    if (value && text && sscanf(text, "%4d.%4d%n", &version[0], &version[1], &read) == 2 && !text[read])
        return;
    version[0] = 2;
    version[1] = 0;
    if (value)
        gltf_note_wrong(gltf, KEY_OF(KEY_OF(NULL, "asset"), key), value, "a version such as \"2.0\"");
}

bool gltf_check_asset(struct gltf *gltf)
{
    int version[2], minimum[2];
    const json_t *asset = gltf_take_object(gltf, NULL, gltf->root, "asset");
    bool lenient = gltf->source->params->lenient;
    take_version(gltf, asset, "version", version);
    take_version(gltf, asset, "minVersion", minimum);
    if (!json_object_get(asset, "version") && json_is_object(json_object_get(gltf->root, "meshes"))) // as in glTF 1.0
        version[0] = 1;
    if (version[0] < 2 || (version[0] > 2 && !lenient))
        return fail(gltf->json.error, LAM_UNSUPPORTED, "%s: asset.version: this is glTF %d.%d, expected glTF 2.0%s",
                    gltf->source->name, version[0], version[1],
                    version[0] < 2 ? "" : " (lam_load_params.lenient reads on)");
    if (!json_object_get(asset, "version"))
        gltf_note(gltf, NULL, "asset.version is missing; the file is read as glTF 2.0");
    // A file of version 2.1 is read as 2.0, unless minVersion requires a later version (section 3.2).
    if (!lenient && (minimum[0] != 2 || minimum[1] > 0))
        return fail(gltf->json.error, LAM_UNSUPPORTED,
                    "%s: asset.minVersion: the file needs glTF %d.%d, expected at most 2.0 (lam_load_params.lenient "
                    "reads on)",
                    gltf->source->name, minimum[0], minimum[1]);
    return true;
}

bool gltf_check_extensions(struct gltf *gltf)
{
    static const char *const lists[] = {"extensionsUsed", "extensionsRequired"};
    const lam_file_info *info = &gltf->scene->file;
    char ignored[600] = "", shown[SHOWN_NAME_SIZE];
    for (int which = 0; which < 2; which++) {
        const json_t *list = json_object_get(gltf->root, lists[which]);
        const struct place *place = KEY_OF(NULL, lists[which]);
        if (list && !json_is_array(list))
            gltf_note_wrong(gltf, place, list, "a list of extensions");
        for (size_t i = 0; i < json_array_size(list); i++)
            if (!json_is_string(json_array_get(list, i)))
                gltf_note_wrong(gltf, ELEMENT_OF(place, i), json_array_get(list, i), "the name of an extension");
    }
    size_t length = 0;
    for (int i = 0; i < info->extension_count; i++) {
        const lam_file_extension *extension = &info->extensions[i];
        shown_name(extension->name, shown);
        if (extension->required && extension->support == LAM_EXTENSION_UNKNOWN && !gltf->source->params->lenient)
            return fail(gltf->json.error, LAM_UNSUPPORTED,
                        "%s: extensionsRequired: the file needs the extension '%s', which this version does not know "
                        "(lam_load_params.lenient ignores it)",
                        gltf->source->name, shown);
        if (extension->support >= LAM_EXTENSION_IGNORED && length < sizeof ignored - SHOWN_NAME_SIZE - 2)
            length += (size_t)snprintf(ignored + length, sizeof ignored - length, "%s%s", length ? ", " : "", shown);
    }
    if (*ignored)
        scene_warn(gltf->scene, "%s: extensions that this version does not draw: %s", gltf->source->name, ignored);
    return true;
}
