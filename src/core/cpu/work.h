// work.h: counts the work that grows with the number of layers, lights and opaque surfaces per pixel of a frame, so
// that a small file cannot cause hours of drawing. The module also stops the frame if the call must stop.
#ifndef WORK_H
#define WORK_H

#include "call_control.h"

enum failure {
    FAILED_NOT = 0,
    FAILED_MEMORY, // out of memory
    FAILED_LAYERS, // more than LAYERS_MAX translucent triangles cover one pixel
    FAILED_WORK,   // more layers per pixel on average than the call allows (lam_control.layer_limit)
};

// Units of work, about a nanosecond each with AVX2, measured with four samples per pixel.
enum {
    WORK_LAYER = 96,    // a translucent fragment
    WORK_LIGHT = 3,     // one light that is evaluated at one point
    WORK_MASK = 24,     // a sample whose opacity is looked up before it becomes a layer
    WORK_OPAQUE = 3,    // an opaque triangle at a pixel
    WORK_SET_UP = 32,   // a triangle in a tile
    WORK_STEP = 1 << 20 // units that a thread counts before it adds them to the frame's work: a few milliseconds
};

struct work {
    struct call_control *call;
    enum failure *failure; // set atomically by any worker
    uint64_t limit, done;  // in units of work; `done` is accessed atomically
};

static inline void work_fail(const struct work *work, enum failure failure)
{
    __atomic_store_n(work->failure, failure, __ATOMIC_RELAXED);
}

static inline bool work_continues(const struct work *work)
{
    return !__atomic_load_n(work->failure, __ATOMIC_RELAXED) && call_should_continue(work->call);
}

// Adds units of work. Whether a frame fails depends only on the sum of the units, not on the threads. Returns false if
// the frame must stop.
static inline bool work_add(struct work *work, uint64_t units)
{
    if (__atomic_add_fetch(&work->done, units, __ATOMIC_RELAXED) > work->limit)
        work_fail(work, FAILED_WORK);
    return work_continues(work);
}

// If *units has reached WORK_STEP, adds *units to the frame's work and sets *units to 0. Returns false if the frame
// must stop.
static inline bool work_step(struct work *work, uint64_t *units)
{
    uint64_t counted = *units;
    if (counted < WORK_STEP)
        return true;
    *units = 0;
    return work_add(work, counted);
}

#endif
