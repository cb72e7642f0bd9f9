// opengl_shader.h: the shaders of the OpenGL program.
#ifndef OPENGL_SHADER_H
#define OPENGL_SHADER_H

#include "opengl_scene.h"

// Variants of the shader for the same lighting. The bench uses the fastest one for each scene.
struct form {
    // 1: every light is in the shader's text with literal numbers, and squarings replace pow; 0: a loop over a uniform
    // block, and pow
    int written_out;
    // flat shading: 1: the face normal from derivatives, lit in the fragment shader, shared vertices; 0: three vertices
    // for each triangle, lit in the vertex shader
    int derivatives;
};

// Returns the text of a shader; the caller frees it.
char *vertex_shader(const struct gl_scene *scene, struct form form);
char *fragment_shader(const struct gl_scene *scene, struct form form);

// The shaders that write only depth, with identical depths.
char *depth_vertex_shader(void);
char *depth_fragment_shader(void);

#endif
