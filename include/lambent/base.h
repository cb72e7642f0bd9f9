// lambent/base.h: errors, control of long calls, small vectors, and the rules of the whole interface.
//
// The headers are C11, and C++17 programs can include them too. Every call works on any thread with 256 kB of stack.
// The library prints nothing, never exits, and keeps no global state except the folders of lambent/path.h.
//
// Names: functions are lam_<thing>_<verb>, types lam_<thing>, constants LAM_<KIND>_<VALUE>. Names end with their unit:
// _rad, _deg, _ms, _s, _px, _bytes. Lengths without a unit are in model units.
//
// Errors: the last parameter of a call that can fail is a `lam_error *`, which may be NULL. On failure, the call
// returns false, NULL or −1, and fills the error.
//
// Defaults: a zeroed parameter struct requests the default of every field. NULL requests the same, if the comment of
// the call allows NULL. Structs whose defaults are not zero (lam_material, lam_light, lam_object, lam_camera) have a
// function that returns them, lam_<thing>_default.
//
// Growth: a struct that may grow ends in LAM_RESERVED(n), n words of 8 bytes that must be zero. A later version
// replaces some of these words with new fields. For each new field, zero means the default or "absent". Therefore the
// size of a struct, the stride of an array of such structs, and the offset of each field never change within one
// soname: a program works with both older and newer versions of the library. A call that takes a struct of parameters
// with a reserved word that is not zero fails with LAM_BAD_ARGUMENT: the program was compiled against a newer header
// and sets a field that this library does not know. Structs without LAM_RESERVED never change.
#ifndef LAMBENT_BASE_H
#define LAMBENT_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The version of these headers; lam_version() returns the version of the library.
#define LAM_VERSION_MAJOR 0
#define LAM_VERSION_MINOR 1
#define LAM_VERSION_PATCH 0
#define LAM_VERSION_TEXT  "0.1.0"

#if defined(__GNUC__)
#define LAM_API __attribute__((visibility("default")))
#else
#define LAM_API
#endif

// Words of 8 bytes at the end of a struct, which later versions may replace with fields. Must be zero (see "Growth"
// above).
#define LAM_RESERVED(words) uint64_t reserved[words]

// The kind of a failure. The exit codes of the `lambent` program use different numbers.
typedef enum lam_code {
    LAM_OK = 0, // no error
    // An argument is out of range or cannot be combined with another; the sentence names the argument.
    LAM_BAD_ARGUMENT,
    // A file is missing, unreadable, truncated, or invalid in its format.
    LAM_CANNOT_READ,
    LAM_UNSUPPORTED,  // understood, but not supported by this build or machine
    LAM_LIMIT,        // a size, the memory limit or the time limit was reached
    LAM_CANNOT_WRITE, // the output cannot be written
    LAM_CANCELLED,    // the caller's cancel flag was raised
    // The machine failed, not the input: it has no memory, file descriptors, processes or threads left, or a disk cannot be
    // read. The same call may succeed later.
    LAM_MACHINE,
} lam_code;

// An error. The caller need not initialise it: a failing call fills it completely, and a successful call leaves it
// unchanged.
typedef struct lam_error {
    lam_code code; // the kind of failure
    // One sentence in UTF-8 without a line end: the file, the position in it (line or byte), what was found and what
    // was expected.
    char text[508];
} lam_error;

// A flag that any thread may raise to stop a running call. Initialise it with zeros. One flag can be used for many
// calls.
typedef struct lam_cancel {
    int raised; // nonzero: raised
} lam_cancel;

// These functions raise and clear the flag. Any thread and any signal handler may call them.
LAM_API void lam_cancel_raise(lam_cancel *cancel);
LAM_API void lam_cancel_clear(lam_cancel *cancel);

// The default limits of a call. lam_control can set others. A call that exceeds a limit fails with LAM_LIMIT; the
// sentence contains both numbers. Limits "for each byte of files" count the model's file and all files that it names,
// each once. These limits restrict the expansion of small files, and do not apply to scenes that a program builds
// itself.
#define LAM_TRIANGLE_LIMIT   200000000u   // triangles
#define LAM_PIXEL_LIMIT      400000000u   // pixels
#define LAM_FILE_LIMIT_BYTES 32000000000u // bytes
#define LAM_JSON_DEPTH_LIMIT 256u         // nested objects and lists
#define LAM_JSON_DEPTH_MAX   2000u        // the upper bound of json_depth_limit: the parser is recursive
// The triangle limit of small files: this number plus LAM_TRIANGLES_PER_BYTE for each byte of files, up to
// LAM_TRIANGLE_LIMIT.
#define LAM_TRIANGLES_BASE     50000000u
#define LAM_TRIANGLES_PER_BYTE 100u
// The bytes of memory that reading a model may use: this number plus expansion_limit for each byte of files.
#define LAM_EXPANSION_BASE_BYTES 500000000u
#define LAM_EXPANSION_LIMIT      2000u
// The object limit of a model: this number plus one for each byte of files.
#define LAM_OBJECTS_BASE 100000u
// The layer limit of a picture: this number plus one for each LAM_LAYER_BYTES of files.
#define LAM_LAYERS_BASE 40u
#define LAM_LAYER_BYTES 16384u

// Controls one long call, such as loading or drawing. If all fields are zero, there is no limit of time or memory, the
// limits above apply, and no progress is reported. Every long loop checks the control, so that a call fails within
// milliseconds after the flag is raised or the deadline has passed.
typedef struct lam_control {
    // The flag that stops the call with LAM_CANCELLED. NULL: the call cannot be cancelled.
    const lam_cancel *cancel;
    // The call fails with LAM_LIMIT this many seconds after its start (wall-clock time). Multiplied by the number of
    // threads, this also limits the processor time. 0 or less: no limit.
    double time_limit_s;
    // The largest number of bytes that the call may use at once. A call that needs more fails with LAM_LIMIT. Scratch
    // memory of threads counts for one thread. If several threads need too much, one thread draws. The number of threads
    // therefore decides nothing. 0: no limit.
    uint64_t memory_limit_bytes;
    // Called repeatedly, on the calling thread, with the fraction done, 0..1, and the name of the step ("read",
    // "normals", "frame"). The function must not use the same device or scene. NULL: none.
    void (*progress)(void *user, double share, const char *step);
    void *user; // passed to `progress`
    // The largest number of triangles of a model or a picture (each object adds the triangles of its mesh). A line or
    // point counts as one triangle in a model, and as two in a picture. 0: LAM_TRIANGLE_LIMIT, or less for small files.
    uint64_t triangle_limit;
    // The largest number of pixels of each picture read: textures, environments, single pictures. A side is never
    // longer than 65535 pixels. 0: LAM_PIXEL_LIMIT.
    uint64_t pixel_limit;
    // The largest size of each file read, in bytes. 0: LAM_FILE_LIMIT_BYTES.
    uint64_t file_limit_bytes;
    // The deepest nesting of JSON (glTF, scene files), at most LAM_JSON_DEPTH_MAX. 0: LAM_JSON_DEPTH_LIMIT.
    uint64_t json_depth_limit;
    // Bytes of memory that reading may use for each byte of files, beyond LAM_EXPANSION_BASE_BYTES: textures, vertices,
    // and the memory of decoders. 0: LAM_EXPANSION_LIMIT.
    uint64_t expansion_limit;
    // The largest number of objects of a model, instances included. 0: LAM_OBJECTS_BASE plus one for each byte of
    // files.
    uint64_t object_limit;
    // The largest number of layers per pixel of a picture, on average (a smaller picture counts as 256×256 pixels). A
    // layer is a translucent or masked surface that covers a pixel. Each light evaluated at a point and each opaque
    // surface at a pixel counts as 1/32 of a layer, and environment light evaluated at a point counts as one layer. The
    // CPU device counts the layers. 0: LAM_LAYERS_BASE, or more for large files.
    uint64_t layer_limit;
    LAM_RESERVED(1);
} lam_control;

// Returns the memory that this process may use, in bytes: the smallest of the machine's memory, the limits of its
// control groups (cgroup v2 and v1, parents included), RLIMIT_AS and RLIMIT_DATA. Returns UINT64_MAX if no limit is
// known. Each call reads a few system files.
LAM_API uint64_t lam_memory_available(void);

// Returns the number of processors that this process may use, at least 1: its affinity allows them, and the quotas of
// its control groups do (cgroup v2, parents included; rounded up). This is the default number of threads. The first call
// reads a few system files.
LAM_API int lam_processors_available(void);

// A position, a direction or three angles.
typedef struct lam_vec3 {
    double x, y, z;
} lam_vec3;

// A colour: linear light unless its name says otherwise. 1 is the full intensity of the display; more is allowed.
typedef struct lam_rgb {
    float r, g, b;
} lam_rgb;

// A colour with its alpha: 0 is clear, 1 opaque. The colour is not premultiplied unless its description states
// otherwise.
typedef struct lam_rgba {
    float r, g, b, a;
} lam_rgba;

// Whether colours are converted between sRGB and linear light (IEC 61966-2-1).
typedef enum lam_color_mode {
    // The library decodes the colours of files to linear light, and encodes 8-bit pictures.
    LAM_COLOR_SRGB = 0,
    // No conversion: a picture stores the values that the equations give.
    LAM_COLOR_RAW,
} lam_color_mode;

// A 4×4 matrix for column vectors, m[row][column]: m[0][3], m[1][3], m[2][3] is the translation.
typedef struct lam_mat4 {
    double m[4][4];
} lam_mat4;

// Returns the identity.
LAM_API lam_mat4 lam_mat4_identity(void);

// Returns the right-handed rotation about an axis through the origin. The axis may have any nonzero length. The result
// is bit-identical on every machine.
LAM_API lam_mat4 lam_mat4_rotation(lam_vec3 axis, double angle_rad);

// Returns the version of the library, "major.minor.patch". The string is static.
LAM_API const char *lam_version(void);

// Returns one line about the build: compiler, instruction sets, libraries. The string is static.
LAM_API const char *lam_build_info(void);

// Returns the length in bytes, 1..4, of the UTF-8 character (RFC 3629) that begins at `bytes`. The call reads at most
// `size` bytes. Returns 0 if the bytes are invalid or the character is truncated.
LAM_API int lam_utf8_length(const void *bytes, size_t size);

// Returns the edit distance between two words: the number of letters inserted, deleted, replaced or swapped with their
// neighbour (optimal string alignment). Words of more than 63 bytes have the distance 63.
LAM_API int lam_edit_distance(const char *a, const char *b);

// Returns the edit distance between a typed word and a known name, for suggestions. 0: both mean the same (they differ
// only in case, '-', '_' and spaces, or the typed word is a common synonym: "sun" for "directional"). 1: the name
// begins with the typed word, which has at least three letters. Otherwise: the edit distance.
LAM_API int lam_word_distance(const char *typed, const char *word);

#ifdef __cplusplus
}
#endif
#endif
