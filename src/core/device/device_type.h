// device_type.h: the interface that every device implements. The entry points in device.c check the arguments and build
// the frame for all devices.
#ifndef DEVICE_TYPE_H
#define DEVICE_TYPE_H

#include "edges.h"
#include "frame.h"

struct pool;
struct recorder;

struct device_type {
    // Draws the frame into the image. Every format and stride is supported (pixels.h). Sets the times and counters in
    // device->report, except frame_ms and total_ms.
    bool (*draw)(struct lam_device *device, const struct frame *frame, lam_image *image, struct call_control *call,
                 lam_error *error);
    // Returns the number of bytes that the device keeps from frame to frame.
    uint64_t (*memory)(const struct lam_device *device);
    void (*free)(struct lam_device *device);    // also frees the device itself
    void (*release)(struct lam_device *device); // frees the memory that is kept from frame to frame; may be NULL
    bool makes_normals;                         // whether the device can draw frames whose makes_normals is set
};

// The base of every device; a device's own struct begins with this struct.
struct lam_device {
    const struct device_type *type;
    char name[96];
    lam_isa isa; // LAM_ISA_AUTO, and 0 threads, if instruction sets and threads do not apply to this device
    int threads;
    struct pool *pool; // NULL if only the calling thread runs tasks
    struct frame frame;
    struct hierarchy_memory hierarchy; // used for edges, and for shadows of the CPU device
    struct edge_memory edges;
    struct recorder *recorder; // records one pixel (recorder.h), or NULL
    lam_frame_report report;
};

#endif
