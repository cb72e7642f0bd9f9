// settings_file.h: lambent.json, the user's own defaults of pictures: keys of scene files in the user's configuration folder.
#ifndef SETTINGS_FILE_H
#define SETTINGS_FILE_H

#include "options.h"

// Where the settings come from.
enum settings_state {
    SETTINGS_READ,    // from the file
    SETTINGS_MISSING, // there is no such file
    SETTINGS_CI,      // the environment variable CI is set: only --config reads a file
    SETTINGS_OFF,     // --no-config
};

struct settings_source {
    enum settings_state state;
    char path[4096]; // of --config or of the user's file; "": the environment names no folder
};

// Stores the settings of the file in all options that neither the command line nor a look gives (options.by_config). `before` becomes a
// copy of the options without them, which shares their lists and must live as long as they do. Only a regular file of at most 64 KiB is
// read. Fails with LAM_CANNOT_READ and one sentence: file, line, key, found, expected.
bool settings_apply(struct options *options, struct options *before, struct settings_source *source, lam_error *error);

#endif
