// lambent/shader.h: the shaders of a scene as text, for programs of your own, and every number that they ask
// for. docs/shaders.md has the contract.
#ifndef LAMBENT_SHADER_H
#define LAMBENT_SHADER_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lam_glsl {
    LAM_GLSL_330 = 0, // OpenGL 3.3, core or compatibility
    LAM_GLSL_120,     // OpenGL 2.1: attribute and varying, no blocks, no `flat`
    LAM_GLSL_300_ES,  // OpenGL ES 3.0, WebGL 2
    LAM_GLSL_COUNT
} lam_glsl;

LAM_API const char *lam_glsl_name(lam_glsl version); // "330", "120", "300es"; NULL out of range

// Where the lists of lights stand. None has a fixed greatest number of lights; what the implementation allows an array
// (GL_MAX_*_UNIFORM_COMPONENTS) is the least, a block (GL_MAX_UNIFORM_BLOCK_SIZE) more, a texture most.
typedef enum lam_shader_lights {
    LAM_SHADER_LIGHTS_AUTO = 0, // an array in GLSL 120, else a block
    LAM_SHADER_LIGHTS_ARRAY,    // plain uniforms, set one by one: lights[0].position
    LAM_SHADER_LIGHTS_BLOCK,    // std140 blocks; not in GLSL 120
    LAM_SHADER_LIGHTS_TEXTURE,  // textures of floats; not in GLSL 120
    LAM_SHADER_LIGHTS_COUNT
} lam_shader_lights;

typedef struct lam_shader_params {
    lam_glsl glsl;
    lam_shader_lights lights;
    bool products; // uniforms are ka·La, kd·Ld, ks·Ls, formed before drawing; else materials and lights
} lam_shader_params;

// A vertex attribute.
typedef struct lam_shader_attribute {
    const char *name, *type; // "position", "vec3"
    int location;            // stands in the text; in GLSL 120 to be bound before linking (glBindAttribLocation)
    const char *meaning;     // one line
} lam_shader_attribute;

// A uniform with its value. Matrices are column-major, as glUniformMatrix takes them. Samplers have none.
typedef struct lam_shader_uniform {
    const char *name;    // as glGetUniformLocation takes it: "lights[0].position"
    const char *type;    // "vec4", "mat4", "float", "int", "sampler2D"
    const char *block;   // of a std140 block; NULL: a uniform by itself
    int offset;          // in the block, bytes; 0 otherwise
    const char *meaning; // one line
    int count;           // numbers in `value`; 0: a sampler
    float value[16];
} lam_shader_uniform;

// Texels of a float texture (RGBA32F, no filter), 1024 in a row; the last row may be short.
typedef struct lam_shader_list {
    const char *name; // of its sampler: "light_list"
    int texels;
    const float *values; // 4 for each
} lam_shader_list;

// A run of triangles that is drawn with one setting of the uniforms.
typedef struct lam_shader_draw {
    int object;              // of the scene
    const char *object_name; // NULL: unnamed
    uint32_t first_triangle; // of the object's mesh
    uint32_t triangle_count;
    const char *material_name; // NULL: unnamed
    bool clockwise;            // the front is clockwise in the window (glFrontFace): a mirroring transform
    lam_cull cull;
    bool translucent;  // to be blended: over what lies behind it, the farthest first
    bool has_colors;   // the mesh has colours, tangents; where the shader asks for what it has not, give
    bool has_tangents; // the attribute the constant value 1, 1, 1, 1
    double origin[3];  // attribute `position` is the mesh's position minus this
    const lam_shader_uniform *uniforms;
    int uniform_count;
} lam_shader_draw;

typedef struct lam_shader {
    lam_glsl glsl;
    lam_shader_lights lights; // never AUTO
    bool products;
    const char *vertex, *fragment; // the whole sources, ASCII
    const lam_shader_attribute *attributes;
    int attribute_count;
    const lam_shader_uniform *uniforms; // of the whole frame: lights and surroundings
    int uniform_count;
    const lam_shader_draw *draws;
    int draw_count;
    const lam_shader_list *lists;
    int list_count;
    bool flat; // three vertices of its own for each triangle: with the face normal, or its last vertex's
} lam_shader;

// Writes the shaders of a scene as lam_draw would draw it at that size, and finds the value of each uniform. One pair
// of sources serves the whole scene. What the fragments hold is sRGB-encoded, for a plain 8-bit window, or with
// LAM_COLOR_RAW as it is. `draw` and `params` may be NULL. Not followed are antialiasing and the background, which are
// the window's. Errors: LAM_BAD_ARGUMENT (as lam_draw; blocks or textures in GLSL 120; objects with one and with two
// sides, or with and without tangents, of which only one can be in one pair: `object` ≥ 0 chooses one), LAM_UNSUPPORTED
// (`show` is no light), LAM_LIMIT. Names belong to the scene.
LAM_API lam_shader *lam_shader_make(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *draw,
                                    int width, int height, int object, const lam_shader_params *params,
                                    lam_error *error);
LAM_API void lam_shader_free(lam_shader *shader); // NULL is fine

#ifdef __cplusplus
}
#endif
#endif
