// device_type.h: the interface that a device fills. The front (device.c) checks arguments and builds the frame once for
// all.
#ifndef DEVICE_TYPE_H
#define DEVICE_TYPE_H

#include "frame.h"

struct recorder;

struct device_type {
    // Draws the frame into the image. Fills device->report's times and counts, except frame_ms and total_ms.
    bool (*draw)(struct lam_device *device, const struct frame *frame, lam_image *image, struct call_control *call,
                 lam_error *error);
    // Bytes held from frame to frame.
    uint64_t (*memory)(const struct lam_device *device);
    void (*free)(struct lam_device *device); // frees the device itself too
    bool makes_normals;                      // draws frames whose makes_normals is set
};

// The head of every device; a device's own struct begins with it.
struct lam_device {
    const struct device_type *type;
    char name[96];
    lam_isa isa; // what lam_device_isa and lam_device_threads tell; left 0 by devices that have none
    int threads;
    struct frame frame;
    struct recorder *recorder; // not NULL: one pixel is to be explained (recorder.h)
    lam_frame_report report;
};

#endif
