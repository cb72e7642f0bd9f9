// fault_shader.h: uses a painter to draw a reference scene with faults switched on.
#ifndef FAULT_SHADER_H
#define FAULT_SHADER_H

#include "fault.h"

struct fault_shader;

// Opens a fault shader for pictures of size² pixels. The fault shader draws only every `stride`-th pixel of every
// `stride`-th row, beginning with the lower left pixel. These are fault_shader_size(size, stride)² pixels.
struct fault_shader *fault_shader_open(const lam_check_painter *painter, int size, int stride, lam_error *error);
void fault_shader_close(struct fault_shader *shader); // `shader` may be NULL or released (fault_shader_rest)

// Returns whether a fault shader draws pictures of this size and stride.
bool fault_shader_draws(const struct fault_shader *shader, int size, int stride);

// The context of an open shader is current on the thread that opened the shader. fault_shader_rest releases the
// context. fault_shader_wake makes the context current again, on any thread.
void fault_shader_rest(struct fault_shader *shader);
bool fault_shader_wake(struct fault_shader *shader, lam_error *error);

static inline int fault_shader_size(int size, int stride) { return (size + stride - 1) / stride; }

// Properties that reference pictures share with the shaders under test.
struct fault_model {
    const struct shader_interface *interface;
    lam_light_frame light_frame;
    lam_reflection reflection;
};

// Draws a scene from shader_interface_scene. `pixels` receives RGBA, with the top row first.
bool fault_shader_draw(struct fault_shader *shader, const struct reference_scene *reference_scene,
                       const struct fault_model *model, const fault_set *set, float *pixels, lam_error *error);

#endif
