// settings_file.h: reads lambent.json, which stores the user's defaults for pictures as keys of scene files. The file
// is in the user's configuration folder.
#ifndef SETTINGS_FILE_H
#define SETTINGS_FILE_H

#include "options.h"

// The source of the settings.
enum settings_state {
    SETTINGS_READ,    // the file was read
    SETTINGS_MISSING, // the file does not exist
    SETTINGS_CI,      // CI is set in the environment: only --config reads a file
    SETTINGS_OFF,     // --no-config
};

struct settings_source {
    enum settings_state state;
    char path[4096]; // the path of --config or of the user's file; "" if there is no configuration folder
};

// Applies the settings of the file to all options that neither the command line nor a look sets (options.by_config).
// `before` becomes a copy of the options without the settings. The copy shares the lists of `options` and must live as
// long as `options`. Only a regular file of at most 64 KiB is read. Fails with LAM_CANNOT_READ and one sentence that
// states the file, the line, the key, the value found and the expected values.
bool settings_apply(struct options *options, struct options *before, struct settings_source *source, lam_error *error);

#endif
