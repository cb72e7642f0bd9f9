// opengl_shader.h: the shaders of the OpenGL program.
#ifndef OPENGL_SHADER_H
#define OPENGL_SHADER_H

#include "opengl_scene.h"

// Variants of the shader for the same lighting. The benchmark uses the fastest variant for each scene.
struct form {
    // 1: the shader's text contains every light with literal numbers, and repeated squaring replaces pow; 0: the shader
    // has a loop over a uniform block, and uses pow
    int written_out;
    // for flat shading; 1: vertices are shared, and the fragment shader computes the face normal from derivatives and
    // the lighting; 0: each triangle has three vertices, and the vertex shader computes the lighting
    int derivatives;
};

// These functions return the text of a shader. The caller frees it.
char *vertex_shader(const struct gl_scene *scene, struct form form);
char *fragment_shader(const struct gl_scene *scene, struct form form);

// These shaders write only depth. The depths are identical to the depths of the other shaders.
char *depth_vertex_shader(void);
char *depth_fragment_shader(void);

#endif
