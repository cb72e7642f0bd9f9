// lambent/base.h: what every other header stands on: errors, control of long calls, small vectors.
//
// C11; includes cleanly in C++17. Every call may be made from any thread. A call that can fail takes a
// `lam_error *` last, which may be NULL; it returns false or NULL on failure and then fills the error.
// The library prints nothing, never exits, and keeps no global state.
#ifndef LAMBENT_BASE_H
#define LAMBENT_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LAM_VERSION_MAJOR 0
#define LAM_VERSION_MINOR 1
#define LAM_VERSION_PATCH 0
#define LAM_VERSION_TEXT  "0.1.0"

#if defined(__GNUC__)
#define LAM_API __attribute__((visibility("default")))
#else
#define LAM_API
#endif

// What kind of failure it was. The numbers 1 to 5 are also the exit codes of the `lambent` program
// (its 6 tells that two pictures differ, which is no failure).
typedef enum lam_code {
    LAM_OK = 0,
    LAM_BAD_ARGUMENT = 1, // the caller's arguments do not fit; the sentence names the one
    LAM_CANNOT_READ = 2,  // a file is missing, unreadable, cut short, or not what its format says
    LAM_UNSUPPORTED = 3,  // well understood and not supported by this build
    LAM_LIMIT = 4,        // a limit was hit: size, memory budget, deadline, out of memory
    LAM_CANNOT_WRITE = 5, // the output cannot be written
    LAM_CANCELLED = 7,    // the caller's cancel flag was raised
} lam_code;

// An error as a value. `text` is one sentence for people, without a line end, that names the file, the
// place in it (line or byte), what was found and what was expected. Zero-initialise or not: a failing
// call fills it whole; a call that succeeds leaves it untouched.
typedef struct lam_error {
    lam_code code;
    char text[508];
} lam_error;

// A flag that any thread may raise to stop a running call. Zero-initialise it; it may be reused after 0.
typedef struct lam_cancel {
    int raised;
} lam_cancel;

LAM_API void lam_cancel_raise(lam_cancel *cancel); // safe from any thread and from a signal handler
LAM_API void lam_cancel_clear(lam_cancel *cancel);

// Control over one long call (load or draw). All zero means: no bound, no progress. Checked in every long
// loop, so a call ends within some milliseconds of the flag or the deadline, with nothing half done.
typedef struct lam_control {
    const lam_cancel *cancel;    // NULL: cannot be cancelled; a raised flag gives LAM_CANCELLED
    double time_limit_s;         // seconds from the start of the call; 0 or less: none; over it gives LAM_LIMIT
    uint64_t memory_limit_bytes; // bytes the call may hold allocated at once; 0: none; over it gives LAM_LIMIT
    // Called now and then from the calling thread with the share done, 0..1, and the step's name
    // ("read", "normals", "frame", …). NULL: none. It must not call back into the same device or scene.
    void (*progress)(void *user, double share, const char *step);
    void *user; // handed to `progress`
} lam_control;

// Vectors. Positions and directions outside the pipeline are doubles; colours are floats, linear unless a
// name says otherwise, 1 = full intensity of the display, larger values allowed.
typedef struct lam_vec3 {
    double x, y, z;
} lam_vec3;

typedef struct lam_rgb {
    float r, g, b;
} lam_rgb;

typedef struct lam_rgba {
    float r, g, b, a; // a: 0 = clear, 1 = opaque; never premultiplied in this interface
} lam_rgba;

typedef enum lam_color_mode {
    LAM_COLOR_SRGB = 0, // colours of files are decoded to linear light; pictures are sRGB-encoded
    LAM_COLOR_RAW,      // no conversion either way: what the equations give is what the picture holds
} lam_color_mode;

// A 4×4 matrix, column vectors: m[row][column], so m[0][3], m[1][3], m[2][3] is the translation.
typedef struct lam_mat4 {
    double m[4][4];
} lam_mat4;

// The matrix that changes nothing.
LAM_API lam_mat4 lam_mat4_identity(void);

// The library's version, "major.minor.patch", and one line on what it was built with. Static strings.
LAM_API const char *lam_version(void);
LAM_API const char *lam_build_info(void);

// Bytes of the well-formed UTF-8 character (RFC 3629) that begins at `bytes`, of which `size` may be read: 1..4. 0: none
// begins there, or it is cut.
LAM_API int lam_utf8_length(const void *bytes, size_t size);

// Edit distance between two words: the number of letters inserted, deleted, replaced or swapped with their neighbour
// (optimal string alignment). Words of more than 63 bytes count as 63 apart.
LAM_API int lam_edit_distance(const char *a, const char *b);

#ifdef __cplusplus
}
#endif
#endif
