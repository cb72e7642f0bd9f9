// draw_request.h: what the process that draws is told, and what it answers: bytes, both ways.
#ifndef DRAW_REQUEST_H
#define DRAW_REQUEST_H

#include "contract.h"

struct draw_request {
    int contract;    // lam_check_contract
    int light_frame; // lam_light_frame
    int size;
    unsigned scenes; // bit i: study i
    const char *vertex, *fragment;
};

enum drawn_state { DRAWN_PICTURES, DRAWN_REFUSED_VERTEX, DRAWN_REFUSED_FRAGMENT, DRAWN_REFUSED_LINK, DRAWN_SLOW };

enum { DRAWN_UNKNOWN_MOST = 16 };

struct check_drawn {
    int state;       // enum drawn_state
    int light_count; // room for lights in the shaders; 0: no list, one light
    bool has_list;
    char driver[128];
    char log[4096];                       // slow: the scene's name
    double seconds;                       // slow: the processor's time for that scene
    char unknown[DRAWN_UNKNOWN_MOST][64]; // active uniforms and attributes that the contract does not know
    char types[DRAWN_UNKNOWN_MOST][96];   // uniforms of a type that does not fit, as a sentence's end
    int unknown_count, types_count;
    unsigned scenes;     // as in the job
    const float *pixels; // RGBA, rows top-down, one picture after the other; inside the bytes that were read
};

bool job_write(const struct draw_request *job, lam_bytes *out, lam_error *error);
// Texts point into the bytes.
bool job_read(const void *bytes, size_t size, struct draw_request *job, lam_error *error);

// `pictures`: size² × 4 floats for each scene of the job; NULL where there are none.
bool drawn_write(const struct check_drawn *drawn, const float *pictures, size_t count, lam_bytes *out,
                 lam_error *error);
bool drawn_read(const lam_bytes *bytes, int size, struct check_drawn *drawn, lam_error *error);

#endif
