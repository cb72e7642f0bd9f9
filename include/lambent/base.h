// lambent/base.h: errors, control of long calls, vectors and the version: the part that every other header includes.
//
// C11; includes cleanly in C++17. Every call may be made from any thread. A call that can fail takes a `lam_error *` as
// its last argument, which may be NULL; on failure it returns false, NULL or −1 and fills the error. The library prints
// nothing, never exits, and keeps no global state.
//
// Structs of parameters are plain: all zero is the default. Pointers to them may be NULL where their function says so.
#ifndef LAMBENT_BASE_H
#define LAMBENT_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The version of these headers; lam_version() is that of the library.
#define LAM_VERSION_MAJOR 0
#define LAM_VERSION_MINOR 1
#define LAM_VERSION_PATCH 0
#define LAM_VERSION_TEXT  "0.1.0"

#if defined(__GNUC__)
#define LAM_API __attribute__((visibility("default")))
#else
#define LAM_API
#endif

// The kind of a failure. The numbers 1 to 5 are also exit codes of the `lambent` program, whose 6 means that two
// pictures differ.
typedef enum lam_code {
    LAM_OK = 0, // no error
    // An argument is out of its range or does not go with another one; the sentence names it.
    LAM_BAD_ARGUMENT = 1,
    // A file is missing, unreadable, cut short, or not of the format that it claims.
    LAM_CANNOT_READ = 2,
    LAM_UNSUPPORTED = 3, // understood, but not supported by this build or machine
    // A limit was reached: a size, the memory limit, the time limit, or the machine's memory.
    LAM_LIMIT = 4,
    LAM_CANNOT_WRITE = 5, // the output cannot be written
    LAM_CANCELLED = 7,    // the caller's cancel flag was raised
} lam_code;

// An error. It need not be initialised: a call that fails fills all of it, a call that succeeds leaves it alone.
typedef struct lam_error {
    lam_code code; // the kind of failure
    // One sentence in UTF-8 without a line end: the file, the place in it (line or byte), what was found and what
    // was expected.
    char text[508];
} lam_error;

// A flag that any thread may raise to stop a running call. All zero: not raised. It may be used for many calls.
typedef struct lam_cancel {
    int raised; // not 0: raised
} lam_cancel;

// Raise and clear the flag. Both are safe from any thread and in a signal handler.
LAM_API void lam_cancel_raise(lam_cancel *cancel);
LAM_API void lam_cancel_clear(lam_cancel *cancel);

// Control over one long call, such as loading or drawing. All zero: no limits, no progress. Every long loop checks it,
// so that a call ends within milliseconds of the flag or the deadline; then it has failed as a whole.
typedef struct lam_control {
    // The flag that stops the call with LAM_CANCELLED. NULL: the call cannot be cancelled.
    const lam_cancel *cancel;
    // Seconds from the start of the call after which it fails with LAM_LIMIT. 0 or less: no limit.
    double time_limit_s;
    // Bytes that the call may hold at once; more is LAM_LIMIT. 0: no limit.
    uint64_t memory_limit_bytes;
    // Called now and then, in the calling thread, with the fraction done, 0..1, and the name of the step ("read",
    // "normals", "frame"). It must not call into the same device or scene. NULL: none.
    void (*progress)(void *user, double share, const char *step);
    void *user; // passed to `progress`
} lam_control;

// A position, direction or angle triple.
typedef struct lam_vec3 {
    double x, y, z;
} lam_vec3;

// A colour: linear light unless its name says otherwise. 1 is the full intensity of the display; more is allowed.
typedef struct lam_rgb {
    float r, g, b;
} lam_rgb;

// A colour with its alpha: 0 is clear, 1 opaque. The colour is not premultiplied unless its description says so.
typedef struct lam_rgba {
    float r, g, b, a;
} lam_rgba;

// Whether colours are converted between sRGB and linear light (IEC 61966-2-1).
typedef enum lam_color_mode {
    // Colours of files are decoded to linear light, and 8-bit pictures are encoded.
    LAM_COLOR_SRGB = 0,
    // No conversion either way: a picture holds the numbers that the equations give.
    LAM_COLOR_RAW,
} lam_color_mode;

// A 4×4 matrix for column vectors, m[row][column]: m[0][3], m[1][3], m[2][3] is the translation.
typedef struct lam_mat4 {
    double m[4][4];
} lam_mat4;

// The identity.
LAM_API lam_mat4 lam_mat4_identity(void);

// The version of the library, "major.minor.patch". A static string.
LAM_API const char *lam_version(void);

// One line about the build: compiler, instruction sets, libraries. A static string.
LAM_API const char *lam_build_info(void);

// Bytes of the well-formed UTF-8 character (RFC 3629) that begins at `bytes`, of which `size` may be read: 1..4. 0:
// none begins there, or it is cut.
LAM_API int lam_utf8_length(const void *bytes, size_t size);

// Edit distance between two words: the number of letters inserted, deleted, replaced or swapped with their neighbour
// (optimal string alignment). Words of more than 63 bytes count as 63 apart.
LAM_API int lam_edit_distance(const char *a, const char *b);

#ifdef __cplusplus
}
#endif
#endif
