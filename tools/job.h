// job.h: one model on its way to a picture: what it was asked, what came of it. render.c fills it step by
// step, report.c tells it.
#ifndef JOB_H
#define JOB_H

#include "options.h"

struct job_times {
    double start;                                // clock_ms() at the job's start
    double read, prepare, camera, encode, total; // milliseconds
    lam_frame_report frame;                      // of the median frame
    double frame_least, frame_most;              // over the --repeat frames
    int frames;
};

struct job {
    const struct options *options;
    const char *model;  // as the user wrote it
    const char *output; // path of the picture; "-": standard output
    const char *format; // of the picture: "png"
    lam_scene *scene;   // NULL until it is read
    lam_camera camera;
    lam_image image;
    lam_device *device;
    uint64_t bytes; // of the file written
    bool written;
    struct job_times times;
    lam_error error; // code LAM_OK: none
};

#endif
