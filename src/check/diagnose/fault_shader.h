// fault_shader.h: draws a reference scene with mistakes switched on, by OpenGL.
#ifndef FAULT_SHADER_H
#define FAULT_SHADER_H

#include "fault.h"

struct fault_shader;

struct fault_shader *fault_shader_open(const char *gl_device, int size, lam_error *error);
void fault_shader_close(struct fault_shader *model); // NULL is fine

// Draws a study as the contract can say it; `room`: lights that the shaders have room for. Pixels: size² × 4
// floats, rows top-down.
bool fault_shader_draw(struct fault_shader *model, const struct reference_scene *reference_scene,
                       const struct shader_interface *reading, int room, lam_light_frame frame,
                       lam_reflection reflection, fault_set set, float *pixels, lam_error *error);

#endif
