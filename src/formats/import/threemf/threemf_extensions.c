// threemf_extensions.c: records the namespaces that a model declares for extensions, and checks the required
// extensions.
#include "threemf_model.h"

#include "fail.h"
#include "shown_name.h"

#ifdef HAVE_3MF

#include <string.h>

#define MICROSOFT  "http://schemas.microsoft.com/3dmanufacturing/"
#define CONSORTIUM "http://schemas.3mf.io/3dmanufacturing/"

static const struct known {
    const char *uri;
    lam_extension_support support;
} known[] = {
    {MICROSOFT "core/2015/02", LAM_EXTENSION_READ},
    {MICROSOFT "material/2015/02", LAM_EXTENSION_READ},
    {MICROSOFT "production/2015/06", LAM_EXTENSION_READ},
    {CONSORTIUM "trianglesets/2021/07", LAM_EXTENSION_NO_EFFECT},
    {MICROSOFT "trianglesets/2021/07", LAM_EXTENSION_NO_EFFECT},
    {"http://schemas.slic3r.org/3mf/2017/06", LAM_EXTENSION_READ},
    {"http://schemas.bambulab.com/package/2021", LAM_EXTENSION_NO_EFFECT}, // names of metadata
    // The triangles of the objects are drawn; slices, beams and displacements are ignored.
    {MICROSOFT "slice/2015/07", LAM_EXTENSION_IGNORED},
    {MICROSOFT "beamlattice/2017/02", LAM_EXTENSION_IGNORED},
    {MICROSOFT "beamlattice/balls/2020/07", LAM_EXTENSION_IGNORED},
    {CONSORTIUM "displacement/2023/10", LAM_EXTENSION_IGNORED},
    {CONSORTIUM "productionalternatives/2021/04", LAM_EXTENSION_IGNORED},
};

// A prefix and its namespace, declared by the model element.
struct declared {
    const char *prefix, *uri;
};

void extensions_declare(struct threemf_xml *xml, const char *prefix, const char *uri)
{
    struct model_reader *reader = reader_of(xml);
    if (!reader->is_root || reader->in_model)
        return;
    struct declared *row = threemf_add(reader->file, &reader->spaces, sizeof *row);
    if (!row)
        return;
    row->prefix = arena_string(reader->file->scratch, prefix);
    row->uri = arena_string(&reader->file->scene->arena, uri);
    if (!row->prefix || !row->uri)
        reader->spaces.count--;
}

static lam_extension_support support_of(const char *uri)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].uri, uri) == 0)
            return known[i].support;
    return LAM_EXTENSION_UNKNOWN;
}

static bool is_word_of(const char *list, const char *word)
{
    size_t length = strlen(word);
    for (list += strspn(list, " \t\r\n"); *list; list += strspn(list, " \t\r\n")) {
        size_t end = strcspn(list, " \t\r\n");
        if (end == length && memcmp(list, word, length) == 0)
            return true;
        list += end;
    }
    return false;
}

static bool check_required(struct threemf_xml *xml, const lam_file_extension *extension)
{
    struct threemf *file = xml->file;
    char shown[SHOWN_NAME_SIZE];
    // If the name is too long, the message shows only its end, which distinguishes extensions.
    const char *name = strlen(extension->name) > SHOWN_CHARACTERS
                           ? extension->name + strlen(extension->name) - (SHOWN_CHARACTERS - 1)
                           : extension->name;
    if (extension->support == LAM_EXTENSION_UNKNOWN && !file->source->params->lenient)
        return fail(
            file->error, LAM_UNSUPPORTED,
            "%s: requires the extension …%s, which this version does not know (lam_load_params.lenient ignores it)",
            file->source->name, shown_name(name, shown));
    if (extension->support >= LAM_EXTENSION_IGNORED)
        scene_warn(file->scene, "%s: requires the extension …%s, which is not drawn", file->source->name,
                   shown_name(name, shown));
    return true;
}

bool extensions_check(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf *file = reader->file;
    const char *required = threemf_attribute(attributes, "requiredextensions");
    const struct declared *spaces = reader->spaces.items;
    reader->in_model = true;
    if (!reader->is_root)
        return true;
    size_t count = reader->spaces.count;
    lam_file_extension *list = arena_alloc_zeroed(&file->scene->arena, (count + 1) * sizeof *list);
    if (!list)
        return threemf_no_memory(file, count * sizeof *list);
    lam_file_info *info = &file->scene->file;
    info->extensions = list;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(spaces[i].uri, known[0].uri) == 0) // the namespace of the core specification
            continue;
        lam_file_extension *extension = &list[info->extension_count++];
        extension->name = spaces[i].uri;
        extension->required = required && is_word_of(required, spaces[i].prefix);
        extension->support = support_of(spaces[i].uri);
        if (extension->required && !check_required(xml, extension))
            return false;
    }
    return true;
}

#endif
