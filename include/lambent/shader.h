// lambent/shader.h: the shaders of a scene as text, for your own programs, with the value of every uniform.
//
// docs/shaders.md describes the contract between the shaders and the program that uses them.
#ifndef LAMBENT_SHADER_H
#define LAMBENT_SHADER_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// The GLSL versions of generated shaders.
typedef enum lam_glsl {
    LAM_GLSL_330 = 0, // OpenGL 3.3, core or compatibility
    LAM_GLSL_120,     // OpenGL 2.1: attribute and varying, no blocks, no `flat`
    LAM_GLSL_300_ES,  // OpenGL ES 3.0, WebGL 2
    LAM_GLSL_COUNT
} lam_glsl;

// Returns the name of a version: "330", "120", "300es". Returns a static string, or NULL if the index is out of range.
LAM_API const char *lam_glsl_name(lam_glsl version);

// The storage of the lights. This library sets no limit on the number of lights. OpenGL's limit is lowest for an array
// (GL_MAX_*_UNIFORM_COMPONENTS), higher for a block (GL_MAX_UNIFORM_BLOCK_SIZE), and highest for a texture.
typedef enum lam_shader_lights {
    LAM_SHADER_LIGHTS_AUTO = 0, // an array in GLSL 120 and in the lecture style, else a block
    LAM_SHADER_LIGHTS_ARRAY,    // plain uniforms, set one by one: lights[0].position
    LAM_SHADER_LIGHTS_BLOCK,    // std140 blocks; not in GLSL 120
    LAM_SHADER_LIGHTS_TEXTURE,  // float textures; not in GLSL 120
    LAM_SHADER_LIGHTS_COUNT
} lam_shader_lights;

// The style of a shader's source.
typedef enum lam_shader_style {
    LAM_SHADER_STYLE_FULL = 0, // complete equations for every feature of this library
    // Simple code, as in a lecture: about six lines in a vertex shader without lighting, thirty to forty in the stage
    // with lighting. The lecture style has the same uniforms and gives the same picture within 1/255. This style
    // supports the reflection models Lambert, Phong, Blinn-Phong and Kajiya-Kay, all kinds of lights, and all shading
    // methods; other features fail with LAM_UNSUPPORTED.
    LAM_SHADER_STYLE_LECTURE,
    LAM_SHADER_STYLE_COUNT
} lam_shader_style;

// A known mistake that can be introduced into a lecture-style shader. Strings are static.
typedef struct lam_shader_mistake {
    const char *id;    // the id of lam_check_mistake: "no-gate"
    const char *looks; // one sentence: the visible effect in the picture
    const char *needs; // the requirement, "a light with attenuation", or NULL
    LAM_RESERVED(4);
} lam_shader_mistake;

// Gets row `row` of the mistakes, counted from 0. Returns false past the last one.
LAM_API bool lam_shader_mistake_row(int row, lam_shader_mistake *mistake);

// The settings of generated shaders. Zero is the default of each field.
typedef struct lam_shader_params {
    lam_glsl glsl;            // the version
    lam_shader_lights lights; // the storage of the lights
    // true: the uniforms are the products ka·La, kd·Ld, ks·Ls, computed before drawing. false: the uniforms are
    // materials and lights.
    bool products;
    lam_shader_style style; // the style of the source
    // The id of a lecture-style mistake, or of two with + between them; NULL if there is none.
    const char *mistake;
    // The graphics card filters textures: the program that uses the shaders sets the filters and the wrapping of each
    // texture. By default, the shader filters textures. In GLSL 120, the graphics card always filters textures.
    bool hardware_filter;
    LAM_RESERVED(6);
} lam_shader_params;

// A vertex attribute.
typedef struct lam_shader_attribute {
    const char *name, *type; // "position", "vec3"
    // Its location. The source declares it, except in GLSL 120, where it must be bound before linking
    // (glBindAttribLocation).
    int location;
    const char *meaning; // one line
    LAM_RESERVED(4);
} lam_shader_attribute;

// A uniform with its value.
typedef struct lam_shader_uniform {
    const char *name;    // name for glGetUniformLocation: "lights[0].position"
    const char *type;    // "vec4", "mat4", "float", "int", "sampler2D"
    const char *block;   // the std140 block that contains it; NULL if there is none
    int offset;          // in the block, bytes; 0 without a block
    const char *meaning; // one line
    int count;           // numbers in `value`; 0: a sampler
    float value[16];     // matrices are column-major, as for glUniformMatrix
    // The texture and filters of a material map's sampler. NULL: another uniform, or a material without such a map, for
    // which any texture may be bound. The map belongs to the scene.
    const lam_texture_map *map;
    LAM_RESERVED(3);
} lam_shader_uniform;

// The content of a float texture (RGBA32F, not filtered) with 1024 texels per row; the last row may be shorter.
typedef struct lam_shader_texture {
    const char *name;    // name of its sampler: "light_list"
    int texels;          // number of texels
    const float *values; // 4 for each texel
    LAM_RESERVED(4);
} lam_shader_texture;

// A range of triangles that is drawn with one set of uniform values.
typedef struct lam_shader_draw {
    int object;                // index in the scene
    const char *object_name;   // NULL: unnamed
    uint32_t first_triangle;   // index in the object's mesh
    uint32_t triangle_count;   // number of triangles in the range
    const char *material_name; // NULL: unnamed
    // Front faces are clockwise in the window (glFrontFace), because of a mirroring transform.
    bool clockwise;
    lam_cull cull; // the object's cull mode
    // Blend this range over everything behind it, the farthest triangles first.
    bool translucent;
    // Whether the mesh has colours and tangents. If the shader has such an attribute but the mesh does not, set the
    // attribute to the constant 1, 1, 1, 1.
    bool has_colors, has_tangents;
    double origin[3];                   // attribute `position` is the mesh's position minus this
    const lam_shader_uniform *uniforms; // the uniform values of this range
    int uniform_count;                  // elements of `uniforms`
    LAM_RESERVED(8);
} lam_shader_draw;

// The shaders of a scene, their inputs, and the ranges to draw.
typedef struct lam_shader {
    lam_glsl glsl;                          // the version
    lam_shader_lights lights;               // the storage of the lights, never AUTO
    bool products;                          // as in lam_shader_params
    const char *vertex, *fragment;          // the complete sources, ASCII
    const lam_shader_attribute *attributes; // the vertex shader's attributes
    int attribute_count;                    // elements of `attributes`
    const lam_shader_uniform *uniforms;     // values for the whole frame: lights and environment
    int uniform_count;                      // elements of `uniforms`
    const lam_shader_draw *draws;           // in the scene's order
    int draw_count;                         // elements of `draws`
    const lam_shader_texture *textures;     // LAM_SHADER_LIGHTS_TEXTURE: the lights; else none
    int texture_count;                      // elements of `textures`
    // Each triangle needs three vertices of its own, with the face normal or the normal of its last vertex.
    bool flat;
    // The stage `application` in the lecture style: the source of a C99 function light_vertex, which computes the
    // attributes front_color and back_color of a vertex from the lights, materials and matrices of the scene. NULL:
    // other stages and styles.
    const char *application;
    LAM_RESERVED(7);
} lam_shader;

// Generates the shaders of a scene as lam_draw would draw it at that size, and computes the value of each uniform. One
// pair of sources serves the whole scene. The fragments are sRGB-encoded for an ordinary 8-bit window, or not encoded
// with LAM_COLOR_RAW. Antialiasing and the background are left to the window.
//
// `draw` and `params` may be NULL. `object` −1: the whole scene; else only that object. Names belong to the scene; the
// caller frees the result. Returns NULL on failure:
//  LAM_BAD_ARGUMENT  as lam_draw; an unknown style; an unknown mistake, or one that the lecture style does not
//                    contain; blocks or textures in GLSL 120; objects that one pair of shaders cannot serve (one- and
//                    two-sided, or with and without tangents): choose one by `object`
//  LAM_UNSUPPORTED   the output is not light; there are no triangles (lines and points have no shader); the style does
//                    not support a feature of the scene, or the shader lacks the requirement of the mistake
//  LAM_LIMIT         memory
LAM_API lam_shader *lam_shader_make(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *draw,
                                    int width, int height, int object, const lam_shader_params *params,
                                    lam_error *error);
LAM_API void lam_shader_free(lam_shader *shader); // NULL is allowed

#ifdef __cplusplus
}
#endif
#endif
