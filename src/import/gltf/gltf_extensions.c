// gltf_extensions.c: checks the extensions that a file uses, and reports which of them are supported.
#include "gltf_extensions.h"

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
    {"EXT_texture_webp", READ},
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
    {"KHR_node_visibility", READ},
    {"KHR_materials_diffuse_transmission", IGNORED},
    {"KHR_materials_dispersion", IGNORED},
    {"KHR_texture_basisu", SILENT}, // a texture with this extension needs a fallback picture; otherwise the load fails
    {"KHR_texture_transform", READ},
    {"KHR_xmp", SILENT},
    {"KHR_xmp_json_ld", SILENT},
};

lam_extension_support gltf_extension_support(const char *name)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].name, name) == 0)
            return known[i].support;
    return LAM_EXTENSION_UNKNOWN;
}

// Parses "2.0" as 2 and 0.
static bool take_version(struct gltf *gltf, const json_t *asset, const char *key, int version[2])
{
    const json_t *value = json_object_get(asset, key);
    const char *text = json_string_value(value);
    int read = 0;
    version[0] = 2;
    version[1] = 0;
    return !value || (text && sscanf(text, "%4d.%4d%n", &version[0], &version[1], &read) == 2 && !text[read]) ||
           json_unexpected(&gltf->json, KEY_OF(KEY_OF(NULL, "asset"), key), value, "a version such as \"2.0\"");
}

bool gltf_check_asset(struct gltf *gltf)
{
    bool ok = true;
    int version[2], minimum[2];
    const json_t *asset = gltf_take_object(gltf, NULL, gltf->root, "asset", &ok);
    if (!ok)
        return false;
    if (!json_object_get(asset, "version"))
        return json_fail(&gltf->json, NULL, "asset.version is missing, expected glTF of version 2");
    if (!take_version(gltf, asset, "version", version) || !take_version(gltf, asset, "minVersion", minimum))
        return false;
    if (version[0] != 2)
        return fail(gltf->json.error, LAM_UNSUPPORTED, "%s: asset.version: this is glTF %d.%d, expected version 2",
                    gltf->source->name, version[0], version[1]);
    // A file of version 2.1 is read as 2.0, unless minVersion requires a later version (section 3.2).
    if (minimum[0] != 2 || minimum[1] > 0)
        return fail(gltf->json.error, LAM_UNSUPPORTED,
                    "%s: asset.minVersion: the file needs glTF %d.%d, expected at most 2.0", gltf->source->name,
                    minimum[0], minimum[1]);
    return true;
}

// Returns the list of strings under `key`. Returns NULL if the key is missing; if its value is wrong, also sets *ok to
// false.
static const json_t *take_names(struct gltf *gltf, const char *key, bool *ok)
{
    const json_t *list = json_object_get(gltf->root, key);
    if (list && !json_is_array(list))
        *ok = json_unexpected(&gltf->json, KEY_OF(NULL, key), list, "a list of extensions");
    for (size_t i = 0; *ok && i < json_array_size(list); i++)
        if (!json_is_string(json_array_get(list, i)))
            *ok = json_unexpected(&gltf->json, ELEMENT_OF(KEY_OF(NULL, key), i), json_array_get(list, i),
                                  "the name of an extension");
    return *ok ? list : NULL;
}

bool gltf_check_extensions(struct gltf *gltf)
{
    bool ok = true;
    char ignored[600] = "";
    const json_t *required = take_names(gltf, "extensionsRequired", &ok);
    const json_t *used = ok ? take_names(gltf, "extensionsUsed", &ok) : NULL;
    for (size_t i = 0; ok && i < json_array_size(required); i++) {
        char shown[SHOWN_NAME_SIZE];
        const char *name = json_string_value(json_array_get(required, i));
        if (gltf_extension_support(name) == LAM_EXTENSION_UNKNOWN && !gltf->source->params->lenient)
            ok = fail(gltf->json.error, LAM_UNSUPPORTED,
                      "%s: extensionsRequired[%zu]: the file needs the extension '%s', which this version does not "
                      "know (a lenient load ignores it)",
                      gltf->source->name, i, shown_name(name, shown));
    }
    for (size_t i = 0, length = 0; ok && i < json_array_size(used); i++) {
        char shown[SHOWN_NAME_SIZE];
        const char *name = json_string_value(json_array_get(used, i));
        if (gltf_extension_support(name) >= LAM_EXTENSION_IGNORED && length < sizeof ignored - SHOWN_NAME_SIZE - 2)
            length += (size_t)snprintf(ignored + length, sizeof ignored - length, "%s%s", length ? ", " : "",
                                       shown_name(name, shown));
    }
    if (ok && *ignored)
        scene_warn(gltf->scene, "%s: extensions that this version does not draw: %s", gltf->source->name, ignored);
    return ok;
}
