// large_file.h: a file of some megabytes, written on disk and kept in memory, for tests of loaders that read in parts.
#ifndef LARGE_FILE_H
#define LARGE_FILE_H

#include "loading.h"

#include "file.h"

#include <unistd.h>

enum { ROOM = 16 << 20 };

static char path[] = "/tmp/lambent-large-XXXXXX";
static char *text; // ROOM bytes
static size_t size;

static void write_file(void)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

// Loading the file stops if the caller cancels, and at a limit of `memory` bytes.
static void check_stops(uint64_t memory)
{
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    lam_error error;
    assert_null(lam_scene_load(path, NULL, &(lam_control){.cancel = &cancel}, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_null(lam_scene_load(path, NULL, &(lam_control){.memory_limit_bytes = memory}, &error));
    assert_int_equal(error.code, LAM_LIMIT);
}

static int start(void **state)
{
    (void)state;
    text = calloc(1, ROOM + FILE_PADDING);
    int file = mkstemp(path);
    return text && file >= 0 && close(file) == 0 ? 0 : -1;
}

static int stop(void **state)
{
    (void)state;
    free(text);
    return unlink(path);
}

#endif
