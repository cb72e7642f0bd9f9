// draw_request.h: the messages to and from the drawing process, as bytes.
#ifndef DRAW_REQUEST_H
#define DRAW_REQUEST_H

#include <lambent/check.h>

#include "contract.h"

struct draw_request {
    const char *contract; // the contents of the file
    int light_frame;      // the lam_light_frame of all lights; WORLD means the frame in the contract
    int size;             // of the pictures; READ_ONLY: the result is that of declarations_pack for both shaders
    unsigned scenes;      // bit i: reference_scenes[i]
    const char *vertex, *fragment;
    int lines[2]; // as in struct complete_texts
};

enum { READ_ONLY = 0 };

enum draw_state { DRAWN_PICTURES, DRAWN_REFUSED, DRAWN_REFUSED_LINK, DRAWN_SLOW };

enum { MAX_UNKNOWN_NAMES = 16 };

struct draw_result {
    int state;                          // enum draw_state
    int group_counts[MAX_LIGHT_GROUPS]; // for each array of lights, the number of lights that the driver uses
    char driver[128];
    bool refused_vertex, refused_fragment; // with DRAWN_REFUSED, the shaders that do not compile
    // the log of the vertex shader or the linker; with DRAWN_SLOW, the name of the scene
    char log[4096];
    char fragment_log[4096];
    double seconds;                      // with DRAWN_SLOW, the processor time of that scene
    char unknown[MAX_UNKNOWN_NAMES][64]; // active uniforms and attributes that are not in the contract
    char types[MAX_UNKNOWN_NAMES][96];   // messages about uniforms whose type does not fit
    int unknown_count, types_count;
    unsigned scenes; // same as in the request
    // One RGBA picture after the other, each with the top row first, inside the message.
    const float *pixels;
};

bool draw_request_write(const struct draw_request *request, lam_bytes *out, lam_error *error);
// Reads a request, whose strings point into `bytes`.
bool draw_request_read(const void *bytes, size_t size, struct draw_request *request, lam_error *error);

// Writes a result. `pictures` contains size² × 4 floats for each scene of the request and may be NULL.
bool draw_result_write(const struct draw_result *result, const float *pictures, size_t count, lam_bytes *out,
                       lam_error *error);
bool draw_result_read(const lam_bytes *bytes, int size, struct draw_result *result, lam_error *error);

// --- draws the pictures of a request with any painter.

// Implements lam_check_draw.
bool check_draw(const void *request, size_t size, const lam_check_painter *painter, lam_bytes *out, lam_error *error);

// --- the painter that draws with OpenGL, which is loaded at run time.

// Returns a painter that uses OpenGL. `device` has the syntax of lam_gl_params.device and must stay valid while
// contexts are opened. NULL selects the first usable device.
lam_check_painter gl_painter(const char *device);

#endif
