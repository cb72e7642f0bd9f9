// target_settings.c: fuzz target for settings files (lambent.json, --config). An input is the file; if it begins with
// a line of options after "#", these are on the command line: "# --shading flat --size 9".
#include "own_folder.h"
#include "target.h"

#include "command_table.h"
#include "settings_file.h"

enum { WORDS_MAX = 16 };

// Splits the line into words, in place.
static int split(char *line, char *words[WORDS_MAX])
{
    int count = 0;
    for (char *word = strtok(line, " "); word && count < WORDS_MAX; word = strtok(NULL, " "))
        words[count++] = word;
    return count;
}

// Invariant for every file: settings, or an error message that begins with the file's path.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static bool filled;
    if (!filled)
        option_table_fill();
    filled = true;
    char path[OWN_PATH], *words[WORDS_MAX];
    const uint8_t *end = size && *data == '#' ? memchr(data, '\n', size) : NULL;
    size_t line_size = end ? (size_t)(end - data) : 0;
    char *line = strndup(end ? (const char *)data + 1 : "", end ? line_size - 1 : 0);
    if (!line)
        abort();
    own_path(path, "lambent.json");
    write_own(path, data + line_size, size - line_size);
    struct options options = option_defaults(), before;
    lam_error error = {0};
    int count = split(line, words);
    if (options_parse(count, words, command_table[COMMAND_render].groups, &options, &error) == 0 &&
        !options.settings.none) {
        struct settings_source source;
        options.settings.file = path;
        bool ok = settings_apply(&options, &before, &source, &error);
        note_sentence(ok ? "" : error.text);
        if (ok ? error.code != LAM_OK : error.code == LAM_OK || strncmp(error.text, path, strlen(path)) != 0)
            abort();
        for (int i = 0; ok && i < OPTIONS_MAX; i++)
            if (options.by_config[i] && options.given[i])
                abort();
    }
    options_free(&options);
    free(line);
    return 0;
}
