// temporary_folder.h: a folder for a test's files. The test creates it: strcpy a name and mkdtemp.
#ifndef TEMPORARY_FOLDER_H
#define TEMPORARY_FOLDER_H

#include <stdio.h>
#include <stdlib.h>

static char folder[64];

// The path of a file in the folder; it stays valid during the next three calls.
static const char *in_folder(const char *name)
{
    static char paths[4][384];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static inline int remove_folder(void **state)
{
    (void)state;
    char command[100];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

#endif
