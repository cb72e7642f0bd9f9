// device_type.h: the interface that a device implements. The front (device.c) checks arguments and builds the frame for
// all of them.
#ifndef DEVICE_TYPE_H
#define DEVICE_TYPE_H

#include "edges.h"
#include "frame.h"

struct pool;
struct recorder;

struct device_type {
    // Draws the frame into the image, of any format and stride (pixels.h). Fills device->report's times and counts, except frame_ms and total_ms.
    bool (*draw)(struct lam_device *device, const struct frame *frame, lam_image *image, struct call_control *call,
                 lam_error *error);
    // Bytes held from frame to frame.
    uint64_t (*memory)(const struct lam_device *device);
    void (*free)(struct lam_device *device); // frees the device itself too
    bool makes_normals;                      // can draw frames whose makes_normals is set
};

// The base of every device; a device's own struct begins with it.
struct lam_device {
    const struct device_type *type;
    char name[96];
    lam_isa isa; // AUTO and 0 threads for devices to which neither applies
    int threads;
    struct pool *pool; // NULL: it works on the calling thread alone
    struct frame frame;
    struct hierarchy_memory hierarchy; // of edges, and of the CPU device's shadows
    struct edge_memory edges;
    struct recorder *recorder; // records one pixel (recorder.h); NULL: none
    lam_frame_report report;
};

#endif
