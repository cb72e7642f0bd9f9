// target_hash.c: fuzz target for the files of `lambent hash`. A file that is read is written and read again, with the
// same entries; the names of its models are resolved as the command does.
#include "own_folder.h"
#include "target.h"

#include "hash.h"

static void check(const struct hash_file *file, const char *path)
{
    char *text = hash_file_text(file);
    struct hash_file again;
    lam_error error = {0};
    if (!text)
        abort();
    write_own(path, text, strlen(text));
    free(text);
    if (!hash_file_read(&again, path, &error) || again.count != file->count ||
        strcmp(again.version, file->version) != 0 || strcmp(again.options, file->options) != 0)
        abort();
    for (size_t i = 0; i < file->count; i++) {
        const char *name = file->entries[i].name;
        const struct hash_entry *found = hash_file_find(&again, name);
        if (!found || found->hash != file->entries[i].hash)
            abort();
        struct options options = {0};
        char *model = hash_file_model(path, name);
        bool may = model && hash_file_may_name(path, model, &options, &error);
        char *back = may ? hash_file_name(path, model) : NULL;
        char *real = may ? realpath(model, NULL) : NULL;
        // A file that exists is below the folder.
        if (!model || (may && !back) || (real && strncmp(real, own_folder, strlen(own_folder)) != 0))
            abort();
        free(real);
        free(back);
        free(model);
    }
    hash_file_free(&again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[OWN_PATH];
    struct hash_file file;
    lam_error error = {0};
    own_path(path, "hashes");
    write_own(path, data, size);
    bool ok = hash_file_read(&file, path, &error);
    note_sentence(ok ? "" : error.text);
    if (ok ? error.code != LAM_OK : error.code == LAM_OK || strncmp(error.text, path, strlen(path)) != 0)
        abort();
    if (ok)
        check(&file, path);
    hash_file_free(&file);
    return 0;
}
