// formats.c: the table of model formats; selects the importer of a file.
#include "formats.h"

#include "fail.h"
#include "unsupported_formats.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#define ROW(name) &importer_##name,
static const struct importer *const importers[] = {IMPORTERS(ROW)};
enum { COUNT = sizeof importers / sizeof *importers };

// Returns a format of the library itself, then of the modules, or NULL.
static const struct importer *importer_at(int format)
{
    for (int i = COUNT; format >= COUNT && i < format; i++)
        if (!module_importers[i - COUNT].name)
            return NULL;
    const struct importer *module = &module_importers[format < COUNT ? 0 : format - COUNT];
    return format < 0 ? NULL : format < COUNT ? importers[format] : module->name ? module : NULL;
}

const char *lam_model_format_name(int format) { return importer_at(format) ? importer_at(format)->name : NULL; }

const char *lam_model_format_extensions(int format)
{
    return importer_at(format) ? importer_at(format)->extensions : NULL;
}

const char *lam_model_format_package(int format, bool *installed)
{
    const struct importer *importer = importer_at(format);
    const bool module = importer && importer->module;
    if (installed)
        *installed = importer && (!module || module_is_installed(importer));
    return module ? MODULES_PACKAGE : NULL;
}

const char *format_list(char out[FORMAT_LIST_SIZE])
{
    size_t used = 0;
    out[0] = 0;
    for (int i = 0; i < COUNT; i++) { // without the formats of modules
        const char *word = importers[i]->extensions;
        while (*word && used < FORMAT_LIST_SIZE) {
            size_t length = strcspn(word, " ");
            used += (size_t)snprintf(out + used, FORMAT_LIST_SIZE - used,
                                     importers[i]->is_scene_file ? "%s (.%.*s)" : "%s.%.*s",
                                     importers[i]->is_scene_file ? " and scene files"
                                     : used                      ? ", "
                                                                 : "",
                                     (int)length, word);
            word += length + strspn(word + length, " ");
        }
    }
    return out;
}

static bool has_ending(const struct importer *importer, const char *ending)
{
    const char *word = importer->extensions;
    size_t length = strlen(ending);
    while (*word && length) {
        size_t end = strcspn(word, " ");
        if (end == length && strncasecmp(word, ending, length) == 0)
            return true;
        word += end;
        word += strspn(word, " ");
    }
    return false;
}

// Asks each importer about the bytes in memory. Returns the highest certainty (importer.probe).
static int probe_all(const char *ending, const struct import_source *source, const struct importer **by_content,
                     const struct importer **by_ending)
{
    int best = 0;
    *by_content = *by_ending = NULL;
    for (int i = 0; importer_at(i); i++) {
        const struct importer *importer = importer_at(i);
        int sure = importer->module ? 0 : importer->probe(source->bytes, source->size, source->parts.size);
        bool named = has_ending(importer, ending);
        if (named)
            *by_ending = importer;
        if (sure > best || (sure == best && sure > 0 && named)) {
            best = sure;
            *by_content = importer;
        }
    }
    return best;
}

// The content of the file selects the importer. If the content is ambiguous, the extension of the file's name selects
// the importer.
const struct importer *importer_for(struct import_source *source, const char *wanted, lam_error *error)
{
    const char *name = source->name;
    char list[FORMAT_LIST_SIZE];
    if (wanted) {
        for (int i = 0; importer_at(i); i++) {
            if (strcasecmp(importer_at(i)->name, wanted) == 0 || has_ending(importer_at(i), wanted))
                return importer_at(i);
        }
        fail(error, LAM_UNSUPPORTED, "%s: the format '%s' cannot be read; lambent reads %s", name, wanted,
             format_list(list));
        return NULL;
    }
    if (source->size == 0)
        return fail(error, LAM_CANNOT_READ, "%s: the file is empty", name), NULL;
    const char *ending = path_ending(name);
    const struct importer *by_content, *by_ending;
    bool sure = probe_all(ending, source, &by_content, &by_ending) == 2;
    if (!sure && !import_whole(source, error))
        return NULL;
    if (sure || probe_all(ending, source, &by_content, &by_ending) == 2)
        return by_content;
    // The importer that matches the name reports the clearest error.
    if (by_content && by_content == by_ending)
        return by_content;
    // Recognise other kinds of files by their content, regardless of their name.
    const struct unsupported_format *foreign = unsupported_format_of(source->bytes, source->size);
    if (!foreign && !by_ending)
        foreign = unsupported_format_named(ending);
    for (const struct importer *m = module_importers; foreign && m->name; m++)
        if (strcmp(m->described, foreign->name) == 0)
            return m;
    if (foreign && foreign->instead) {
        fail(error, LAM_UNSUPPORTED, "%s: this is %s; lambent reads %s: export the model as %s", name, foreign->name,
             format_list(list), foreign->instead);
        return NULL;
    }
    if (foreign) {
        fail(error, LAM_CANNOT_READ, "%s: this is %s, not a 3D model; lambent reads %s", name, foreign->name,
             format_list(list));
        return NULL;
    }
    if (by_ending)
        return by_ending; // the importer of this format reports the error
    fail(error, LAM_CANNOT_READ, "%s: unknown model format; lambent reads %s", name, format_list(list));
    return NULL;
}
