// import_module.h: the interface between the library, the program lambent-import, and the modules that call other
// projects' readers (lambent-assimp.so, lambent-occt.so).
//
// The library starts lambent-import for each file (import_process.c). Through a pipe, it sends a struct import_request
// and the bytes of the file; lambent-import answers with a struct import_answer and a scene. The scene is binary glTF,
// so that one reader, the glTF importer, checks every number that comes from these readers. lambent-import loads the
// module, drops all of its rights, and only then reads the bytes (import_main.c).
#ifndef IMPORT_MODULE_H
#define IMPORT_MODULE_H

#include <stddef.h>
#include <stdint.h>
#include <sys/socket.h>

#ifdef __cplusplus
extern "C" {
#endif

// Increment this version with every change in this file.
enum { IMPORT_MODULE_VERSION = 3 };

enum { IMPORT_NOTE_SIZE = 400, IMPORT_NAME_SIZE = 16 };

#define IMPORT_PROGRAM "lambent-import"
// lambent-import's fopen opens the bytes of the file by this name, for readers that need a name, and nothing else.
#define IMPORT_FILE "file"
// With this argument, lambent-import is the starter (lam_import_start): its standard input is a socket. For each message,
// which carries the ends of two pipes, it starts a copy of itself with these standard streams.
#define IMPORT_STARTER "starter"
union import_handles {
    char space[CMSG_SPACE(2 * sizeof(int))];
    struct cmsghdr aligned;
};

struct import_request {
    uint32_t version;              // IMPORT_MODULE_VERSION
    char module[IMPORT_NAME_SIZE]; // "assimp"
    char format[IMPORT_NAME_SIZE]; // the extension of the format: "fbx"
    uint32_t seconds;              // limit of processor time
    uint64_t memory;               // limit in bytes, beside the memory of the libraries
    uint64_t size;                 // bytes of the file that follow
    uint64_t triangles;            // more are refused: a module may stop making them
    double deflection;             // lam_load_params.deflection; never 0
    uint32_t raw;                  // colours are linear already
    uint32_t measure;              // lam_load_params.measure
};

enum import_result {
    IMPORT_READ,
    IMPORT_DAMAGED,   // `note` says what is wrong
    IMPORT_NO_MEMORY, // the memory limit was reached
    IMPORT_NO_MODULE, // the module cannot be loaded, or does not read the format; `note` says why
};

struct import_answer {
    uint32_t version, result;    // IMPORT_MODULE_VERSION, enum import_result
    uint64_t size;               // bytes of binary glTF that follow; 0 unless the result is IMPORT_READ
    double unit_m;               // as in struct import_scene
    uint64_t memory;             // the largest memory of the process, in bytes
    char note[IMPORT_NOTE_SIZE]; // the reason, or after IMPORT_READ a warning ("" if there is none)
};

// A scene: the two chunks of binary glTF. The process ends after sending them, so nothing frees them.
struct import_scene {
    const char *json;
    size_t json_size;
    const uint8_t *binary;
    size_t binary_size;
    double unit_m; // metres per unit of length; 0 if the file does not state it
};

struct import_functions {
    uint32_t version;
    // Reads a file. Returns an enum import_result, and fills `scene` or `note`. Throws no exceptions.
    int (*read)(const struct import_request *request, const uint8_t *bytes, struct import_scene *scene,
                char note[IMPORT_NOTE_SIZE]);
};

// The only C function that a module exports.
const struct import_functions *lambent_import_functions(void);

#ifdef __cplusplus
}
#endif
#endif
