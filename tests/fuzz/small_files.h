// small_files.h: the files that a fuzz target's input may name: a few bytes for each kind of file, the same for every
// name of that kind. A file whose name contains "none" does not exist.
#ifndef SMALL_FILES_H
#define SMALL_FILES_H

#include <lambent/lambent.h>

#include <stdlib.h>
#include <string.h>

// The files of one input.
struct small_files {
    const void *materials; // any MTL file; NULL means one with a map
    size_t materials_size;
};

static inline bool give_bytes(const void *from, size_t size, struct lam_bytes *bytes)
{
    bytes->size = size;
    bytes->data = malloc(size + 1);
    if (bytes->data && size)
        memcpy(bytes->data, from, size);
    return bytes->data != NULL;
}

// A lam_open_fn whose user data is a struct small_files, or NULL.
static inline bool open_small(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    static const char model[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    static const char materials[] =
        "newmtl a\nKd 1 0.5 0.2\nmap_Kd a.tga\nnewmtl b\nKd 0.2 0.5 1\nd 0.5\nmap_bump b.bmp\n";
    // 3×2 pixels with alpha: 18 bytes of header, 32 bits.
    static const unsigned char tga[] = {0,   0, 0,  2, 0,   0, 0,   0,   0,   0,   0,  0,  3,  0,
                                        2,   0, 32, 8, 255, 0, 0,   255, 0,   255, 0,  99, 0,  0,
                                        255, 0, 1,  2, 3,   4, 200, 210, 220, 255, 90, 80, 70, 128};
    // 2×2 pixels of 24 bits.
    static const unsigned char bmp[] = {'B', 'M', 70, 0, 0, 0,   0, 0, 0, 0, 54, 0,   0,   0,   40,  0, 0,
                                        0,   2,   0,  0, 0, 2,   0, 0, 0, 1, 0,  24,  0,   0,   0,   0, 0,
                                        16,  0,   0,  0, 0, 0,   0, 0, 0, 0, 0,  0,   0,   0,   0,   0, 0,
                                        0,   255, 0,  0, 0, 255, 0, 0, 0, 0, 0,  255, 128, 128, 255, 0, 0};
    const struct small_files *files = user;
    bool ok;
    if (strstr(name, "none")) {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    if (strstr(name, ".mtl"))
        ok = files && files->materials ? give_bytes(files->materials, files->materials_size, bytes)
                                       : give_bytes(materials, sizeof materials - 1, bytes);
    else if (strstr(name, ".obj"))
        ok = give_bytes(model, sizeof model - 1, bytes);
    else if (strstr(name, ".tga") || strstr(name, ".png"))
        ok = give_bytes(tga, sizeof tga, bytes);
    else if (strstr(name, ".bmp") || strstr(name, ".jp"))
        ok = give_bytes(bmp, sizeof bmp, bytes);
    else { // a buffer
        unsigned char numbers[256];
        for (size_t i = 0; i < sizeof numbers; i++)
            numbers[i] = (unsigned char)(i % 7);
        ok = give_bytes(numbers, sizeof numbers, bytes);
    }
    if (!ok)
        *error = (lam_error){LAM_MACHINE, "out of memory"};
    return ok;
}

#endif
