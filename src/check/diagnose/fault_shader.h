// fault_shader.h: draws a reference scene with mistakes switched on, by OpenGL.
#ifndef FAULT_SHADER_H
#define FAULT_SHADER_H

#include "fault.h"

struct model;

struct model *model_open(const char *gl_device, int size, lam_error *error);
void model_close(struct model *model); // NULL is fine

// Draws a study as the contract can say it; `room`: lights that the shaders have room for. Pixels: size² × 4
// floats, rows top-down.
bool model_draw(struct model *model, const struct study *study, const struct reading *reading, int room,
                lam_light_frame frame, lam_reflection reflection, mistake_set set, float *pixels, lam_error *error);

#endif
