// lambent/shader.h: the shaders of a scene as text, for programs of your own, with the value of every uniform.
//
// docs/shaders.md has the contract between the shaders and the program that uses them.
#ifndef LAMBENT_SHADER_H
#define LAMBENT_SHADER_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// The versions of GLSL that shaders are written in.
typedef enum lam_glsl {
    LAM_GLSL_330 = 0, // OpenGL 3.3, core or compatibility
    LAM_GLSL_120,     // OpenGL 2.1: attribute and varying, no blocks, no `flat`
    LAM_GLSL_300_ES,  // OpenGL ES 3.0, WebGL 2
    LAM_GLSL_COUNT
} lam_glsl;

// Returns the name of a version: "330", "120", "300es". Returns a static string, or NULL if the index is out of range.
LAM_API const char *lam_glsl_name(lam_glsl version);

// Where the shaders read the lights from. There is no fixed limit to their number; an implementation allows fewest in
// an array (GL_MAX_*_UNIFORM_COMPONENTS), more in a block (GL_MAX_UNIFORM_BLOCK_SIZE), most in a texture.
typedef enum lam_shader_lights {
    LAM_SHADER_LIGHTS_AUTO = 0, // an array in GLSL 120 and in the lecture style, else a block
    LAM_SHADER_LIGHTS_ARRAY,    // plain uniforms, set one by one: lights[0].position
    LAM_SHADER_LIGHTS_BLOCK,    // std140 blocks; not in GLSL 120
    LAM_SHADER_LIGHTS_TEXTURE,  // float textures; not in GLSL 120
    LAM_SHADER_LIGHTS_COUNT
} lam_shader_lights;

// How a shader's text is written.
typedef enum lam_shader_style {
    LAM_SHADER_STYLE_FULL = 0, // the equations of this library, for all that it draws
    // Plain lines, as a lecture would show them: about six in a vertex shader that lights nothing, thirty to forty in
    // the stage that does. Same uniforms, same picture within 1/255. It has the reflection models Lambert, Phong,
    // Blinn-Phong and Kajiya-Kay, all kinds of lights, and all shading methods; other features are LAM_UNSUPPORTED.
    LAM_SHADER_STYLE_LECTURE,
    LAM_SHADER_STYLE_COUNT
} lam_shader_style;

// A known mistake that can be introduced into a shader of the lecture style. Strings are static.
typedef struct lam_shader_mistake {
    const char *id;    // "no-gate", as lam_check_mistake has it
    const char *looks; // a sentence: the visible effect in the picture
    const char *needs; // of the shader: "a light with attenuation"; NULL: none
    LAM_RESERVED(4);
} lam_shader_mistake;

// Row `row` of the mistakes, counted from 0. False past the last one.
LAM_API bool lam_shader_mistake_row(int row, lam_shader_mistake *mistake);

// How shaders are written. All zero is the default.
typedef struct lam_shader_params {
    lam_glsl glsl;            // the version
    lam_shader_lights lights; // where the lights are
    // true: the uniforms are the products ka·La, kd·Ld, ks·Ls, formed before drawing. false: materials and lights.
    bool products;
    lam_shader_style style; // how the text is written
    const char *mistake;    // of the lecture style, by its id; NULL: none
    // Textures are filtered by the graphics card: the program that uses the shaders sets the filters and the wrapping of each
    // texture. By default the shader filters them. GLSL 120 has the graphics card's in any case.
    bool hardware_filter;
    LAM_RESERVED(6);
} lam_shader_params;

// A vertex attribute.
typedef struct lam_shader_attribute {
    const char *name, *type; // "position", "vec3"
    // Its location. The text declares it, except in GLSL 120, in which it is bound before linking
    // (glBindAttribLocation).
    int location;
    const char *meaning; // one line
    LAM_RESERVED(4);
} lam_shader_attribute;

// A uniform with its value.
typedef struct lam_shader_uniform {
    const char *name;    // as glGetUniformLocation takes it: "lights[0].position"
    const char *type;    // "vec4", "mat4", "float", "int", "sampler2D"
    const char *block;   // the std140 block that it is in; NULL: none
    int offset;          // in the block, bytes; 0 without one
    const char *meaning; // one line
    int count;           // numbers in `value`; 0: a sampler
    float value[16];     // matrices are column-major, as glUniformMatrix takes them
    // Of the sampler of a material's map: its texture, and how it is read. NULL: another uniform, or the run's material has no
    // such map, and any texture may be bound. It belongs to the scene.
    const lam_texture_map *map;
    LAM_RESERVED(3);
} lam_shader_uniform;

// The content of a float texture (RGBA32F, not filtered), 1024 texels to a row; the last row may be short.
typedef struct lam_shader_texture {
    const char *name;    // of its sampler: "light_list"
    int texels;          // number of texels
    const float *values; // 4 for each texel
    LAM_RESERVED(4);
} lam_shader_texture;

// A run of triangles that is drawn with one setting of the uniforms.
typedef struct lam_shader_draw {
    int object;                // index in the scene
    const char *object_name;   // NULL: unnamed
    uint32_t first_triangle;   // index in the object's mesh
    uint32_t triangle_count;   // triangles of the run
    const char *material_name; // NULL: unnamed
    // The front is clockwise in the window (glFrontFace), because of a mirroring transform.
    bool clockwise;
    lam_cull cull; // the object's
    // To be blended over everything behind it, the farthest triangle first.
    bool translucent;
    // The mesh has colours, tangents. Where the shader has that attribute and the mesh has not, give the attribute the
    // constant value 1, 1, 1, 1.
    bool has_colors, has_tangents;
    double origin[3];                   // attribute `position` is the mesh's position minus this
    const lam_shader_uniform *uniforms; // the values of this run
    int uniform_count;                  // elements of `uniforms`
    LAM_RESERVED(8);
} lam_shader_draw;

// The shaders of a scene, the numbers that they need, and the runs to draw.
typedef struct lam_shader {
    lam_glsl glsl;                          // the version
    lam_shader_lights lights;               // where the lights are, never AUTO
    bool products;                          // as in lam_shader_params
    const char *vertex, *fragment;          // the whole sources, ASCII
    const lam_shader_attribute *attributes; // of the vertex shader
    int attribute_count;                    // elements of `attributes`
    const lam_shader_uniform *uniforms;     // of the whole frame: lights and environment
    int uniform_count;                      // elements of `uniforms`
    const lam_shader_draw *draws;           // in the scene's order
    int draw_count;                         // elements of `draws`
    const lam_shader_texture *textures;     // LAM_SHADER_LIGHTS_TEXTURE: the lights; else none
    int texture_count;                      // elements of `textures`
    // Each triangle needs three vertices of its own, with the face normal or its last vertex's.
    bool flat;
    // The stage `application` in the lecture style: the source of a C99 function light_vertex, which computes the attributes
    // front_color and back_color of a vertex, with the lights, materials and matrices of the scene. NULL: other stages and styles.
    const char *application;
    LAM_RESERVED(7);
} lam_shader;

// Writes the shaders of a scene as lam_draw would draw it at that size, and computes the value of each uniform. One
// pair of sources serves the whole scene. The fragments are sRGB-encoded for a plain 8-bit window, or with
// LAM_COLOR_RAW as they are. Antialiasing and the background are left to the window.
//
// `draw` and `params` may be NULL. `object` −1: the whole scene; else only that object. Names belong to the scene; the
// caller frees the result. NULL on failure:
//   LAM_BAD_ARGUMENT  as lam_draw; a style that is none; a mistake that is not known, or that is not of the lecture style's
//                     shaders; blocks or textures in GLSL 120; objects with one and with two sides, or with and
//                     without tangents, which one pair of shaders cannot serve: choose one by `object`
//   LAM_UNSUPPORTED   the output is not light; there are no triangles (lines and points have no shader); the style does not
//                     have what the scene asks for, or the shader does not have what the mistake needs
//   LAM_LIMIT         memory
LAM_API lam_shader *lam_shader_make(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *draw,
                                    int width, int height, int object, const lam_shader_params *params,
                                    lam_error *error);
LAM_API void lam_shader_free(lam_shader *shader); // NULL is fine

#ifdef __cplusplus
}
#endif
#endif
