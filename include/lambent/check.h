// lambent/check.h: checks the lighting of GLSL shaders. A check draws reference scenes with the shaders under test,
// compares the pictures with the pictures of the CPU device, and names the known mistakes that explain a difference.
// For teachers and students: docs/check.md.
//
// These functions are in a separate library, liblambent-check (pkg-config lambent-check), which uses liblambent.
#ifndef LAMBENT_CHECK_H
#define LAMBENT_CHECK_H

#include "device.h"
#include "light.h"

#ifdef __cplusplus
extern "C" {
#endif

// A contract: the names of a course's shader inputs, and the requirements of its exercise. Contracts are JSON files
// (docs/check.md, "Contracts"). A contract is immutable, so any number of checks may share one.
typedef struct lam_check_contract lam_check_contract;

// Returns the name of a built-in contract: "lambent", "pittsburgh", "oregon", … Returns NULL past the last one.
LAM_API const char *lam_check_contract_shipped(int index);
// Returns the file of a built-in contract by its name. Returns NULL if there is none.
LAM_API const char *lam_check_contract_text(const char *name);

// Reads a contract. `file` is the contract's file name, for messages, or NULL if there is none. The caller frees the
// contract. Fails with LAM_CANNOT_READ, with the position of the error, or LAM_LIMIT.
LAM_API lam_check_contract *lam_check_contract_read(const char *text, size_t size, const char *file, lam_error *error);
LAM_API void lam_check_contract_free(lam_check_contract *contract); // NULL is allowed

// These functions return the contract's name and its one-line title. Both strings belong to the contract.
LAM_API const char *lam_check_contract_name(const lam_check_contract *contract);
LAM_API const char *lam_check_contract_title(const lam_check_contract *contract);

// One name of a contract. Strings belong to the contract.
typedef struct lam_check_name {
    const char *name; // "lights[].lightPosition" for members of a list
    const char *type; // "vec4"
    const char *role; // "light_position": the name of a lam_check_role
    // The space of a position or direction: "eye", "world" or "object"; NULL if there is none.
    const char *space;
    const char *meaning; // one line
    // Other accepted names, separated by blanks. NULL: none.
    const char *synonyms;
    bool attribute; // false: a uniform
    LAM_RESERVED(4);
} lam_check_name;

// Gets row `row` of a contract, counted from 0. Returns false past the last one.
LAM_API bool lam_check_contract_row(const lam_check_contract *contract, int row, lam_check_name *name);

// A role that a contract can give to a name. The strings are static.
typedef struct lam_check_role {
    const char *name;    // as in contract files: "light_position"
    const char *meaning; // one line
    // Whether an attribute, a uniform, or a number in a shader's text can have this role.
    bool attribute, uniform, constant;
    bool in_space; // whether names of this role have a space
    LAM_RESERVED(4);
} lam_check_role;

// Gets row `row` of the roles, counted from 0. Returns false past the last one.
LAM_API bool lam_check_role_row(int row, lam_check_role *role);

// These functions return the id of a known mistake ("no-gate") and a sentence about the mistake. They return NULL past
// the last one.
LAM_API const char *lam_check_mistake(int index);
LAM_API const char *lam_check_mistake_explanation(int index);

// These functions return the name of a reference scene, and the property that the scene tests. They return NULL past
// the last one.
LAM_API const char *lam_check_scene_name(int index);
LAM_API const char *lam_check_scene_description(int index);

// Draws the pictures of a request from lam_check_run. The call compiles and runs the shaders under test, which may
// crash the driver or loop forever. Therefore, make this call in a separate process, and stop that process at a
// deadline. The caller frees `result`. `gl_device`: as lam_gl_params.device; NULL: the first usable one. Fails with
// LAM_UNSUPPORTED if OpenGL is missing. A shader that does not compile is not an error: the result records it.
LAM_API bool lam_check_draw(const void *request, size_t size, const char *gl_device, lam_bytes *result,
                            lam_error *error);

// The result of a process that calls lam_check_draw.
typedef enum lam_check_draw_status {
    LAM_CHECK_DRAW_DONE = 0, // `result` contains the bytes from lam_check_draw
    LAM_CHECK_DRAW_FAILED,   // `error` says why
    LAM_CHECK_DRAW_TIMEOUT,  // the process was stopped at its deadline
    LAM_CHECK_DRAW_CRASHED,  // the process crashed
    LAM_CHECK_DRAW_MEMORY,   // the process was stopped because it used too much memory
} lam_check_draw_status;
// Runs lam_check_draw on `request`, usually in another process.
typedef lam_check_draw_status lam_check_draw_fn(void *user, const lam_bytes *request, lam_bytes *result,
                                                lam_error *error);

// --- drawing for a check

// A check draws the shaders under test, and its own shaders with known mistakes. The check draws with OpenGL, which is
// loaded at run time, or with a painter that the caller provides: a web page draws with WebGL 2 (classroom/web/painter.js).
// The check alone chooses the meshes and their inputs and compares the pictures, so that the verdict is the same with
// every painter.

// The compiler of a pair of shaders.
typedef enum lam_check_language {
    LAM_CHECK_LANGUAGE_CORE = 0, // OpenGL 3.3 core
    LAM_CHECK_LANGUAGE_ES,       // OpenGL ES 3.0, which is WebGL 2
    // OpenGL with all names since 1.0, such as gl_Vertex and gl_NormalMatrix.
    LAM_CHECK_LANGUAGE_COMPATIBILITY,
} lam_check_language;

// The type of an input.
typedef enum lam_check_type {
    LAM_CHECK_TYPE_OTHER = 0, // none of the types below
    LAM_CHECK_TYPE_FLOAT,     // float
    LAM_CHECK_TYPE_INT,       // int
    LAM_CHECK_TYPE_BOOL,      // bool
    LAM_CHECK_TYPE_VEC2,      // vec2
    LAM_CHECK_TYPE_VEC3,      // vec3
    LAM_CHECK_TYPE_VEC4,      // vec4
    LAM_CHECK_TYPE_MAT3,      // mat3
    LAM_CHECK_TYPE_MAT4,      // mat4
    LAM_CHECK_TYPE_SAMPLER2D, // sampler2D
} lam_check_type;

// An attribute or a uniform that a program reads, including one in a uniform block.
typedef struct lam_check_input {
    // The name that OpenGL reports: "lights[0].position", or "numbers[0]" for a whole array of numbers.
    char name[128];
    lam_check_type type; // of one element
    int elements;        // length of an array; 1: not an array
    bool attribute;      // false: a uniform
    LAM_RESERVED(2);
} lam_check_input;

// A compiled program. The painter owns the data that its members point to.
typedef struct lam_check_program {
    void *program;                         // NULL: the program does not compile or link
    lam_check_input *inputs;               // the inputs that the shaders read
    int input_count;                       // of `inputs`
    bool refused_vertex, refused_fragment; // whether each shader failed to compile
    char vertex_log[4096];                 // the compiler's messages; "" if there are none
    char fragment_log[4096];               // the same for the fragment shader
    char link_log[4096];                   // the linker's messages
    LAM_RESERVED(4);
} lam_check_program;

// Values of a uniform: `count` elements from `first` on. Each element has as many floats as its type has components.
// Matrices are in column-major order. Integers and flags are given as whole numbers. The value of a sampler is the RGBA
// colour of a uniformly coloured texture.
typedef struct lam_check_value {
    int input;            // index in `inputs`
    int first;            // index of the first element
    int count;            // number of elements
    const float *numbers; // owned by the check
    LAM_RESERVED(1);
} lam_check_value;

// A triangle mesh. Meshes with the same number are identical as long as a context is open, so a painter may keep them.
typedef struct lam_check_mesh {
    int number;              // from 0
    int vertex_count;        // at most 65535
    int index_count;         // three for each triangle
    const float *positions;  // 3 floats for each vertex
    const float *normals;    // 4 floats for each vertex, the last of them 0
    const float *tangents;   // 3 floats for each vertex
    const uint16_t *indices; // indices of vertices
    LAM_RESERVED(4);
} lam_check_mesh;

// Values of a further attribute for each vertex of the mesh: texture coordinates, tangents with the sign of the
// bitangent, or bitangents.
typedef struct lam_check_stream {
    int input;            // the attribute: index in `inputs`
    int components;       // floats for each vertex: 2, 3 or 4
    const float *numbers; // owned by the check
    LAM_RESERVED(1);
} lam_check_stream;

// The triangles that are culled. The vertices of a front face are in counter-clockwise order.
typedef enum lam_check_cull {
    LAM_CHECK_CULL_NONE = 0, // none
    LAM_CHECK_CULL_BACK,     // back faces
    LAM_CHECK_CULL_FRONT,    // front faces
} lam_check_cull;

// One picture: a program draws a mesh on transparent black, with a depth buffer, without blending.
typedef struct lam_check_drawing {
    const lam_check_program *program; // compiled by the painter
    const lam_check_mesh *mesh;       // the mesh to draw
    // The attributes that get positions, normals and tangents, as indices in `inputs`; -1: none.
    int position, normal, tangent;
    const lam_check_value *values; // values of uniforms
    int value_count;               // of `values`
    lam_check_cull cull;           // triangles that are culled
    // For LAM_CHECK_LANGUAGE_COMPATIBILITY: gl_ModelViewMatrix and gl_ProjectionMatrix, in column-major order. If
    // `position` or `normal` is -1, gl_Vertex or gl_Normal receives the values of the mesh.
    float model_view[16], projection[16];
    const lam_check_stream *streams; // values of further attributes
    uint64_t stream_count;           // of `streams`
    LAM_RESERVED(2);
} lam_check_drawing;

// The functions that draw for a check. All calls come from the thread of lam_check_run. Contexts are opened and closed
// in nested order.
typedef struct lam_check_painter {
    void *user; // passed to `open`
    // Makes a context for pictures of size² pixels and for programs in this language. `renderer` receives the name of
    // the renderer. NULL: the call failed, and `error` is filled.
    void *(*open)(void *user, lam_check_language language, int size, char renderer[128], lam_error *error);
    void (*close)(void *place); // frees the context, after `forget` for each of its programs
    // The caller can cache contexts: a context is put to rest after a check and woken for the next check, perhaps on
    // another thread.
    void (*rest)(void *place);
    // Returns false and fills `error` on failure; the context then stays released. The check then forgets its programs
    // and closes it without waking it again, so these calls must free memory and device objects in this state too.
    bool (*wake)(void *place, lam_error *error);
    // Compiles both shaders, so that the messages of both are available at once, and links them. A program that does
    // not compile is not an error. Returns false, fills `error` and keeps nothing on failure.
    bool (*compile)(void *place, const char *vertex, const char *fragment, lam_check_program *program,
                    lam_error *error);
    void (*forget)(void *place, lam_check_program *program); // frees the result of compile
    // Draws to size² RGBA pixels, with the top row first. The pixels are floats as the program wrote them. If the
    // device has no float targets, they are bytes / 255; colours are then clamped, and NaN is not found.
    bool (*draw)(void *place, const lam_check_drawing *drawing, float *pixels, lam_error *error);
    // true: the painter compiles only GLSL ES. The check then translates desktop GLSL to GLSL ES, line by line, as far
    // as the two languages agree (docs/check.md). Pixels are not compared where the surface normal changes by more than
    // 26 degrees to the next pixel, because such GPUs may round corners to 1/16 of a pixel.
    bool es_only;
    LAM_RESERVED(4);
} lam_check_painter;

// A cache of the pictures of known mistakes, shared by several checks. Drawing these pictures takes most of a check's
// time. The cache stores up to `max_bytes`; pictures beyond that are drawn each time. A cache serves one OpenGL device
// or painter. Any number of threads may use the cache at once.
typedef struct lam_check_cache lam_check_cache;

// Makes an empty cache. Returns NULL if memory runs out.
LAM_API lam_check_cache *lam_check_cache_make(size_t max_bytes, lam_error *error);
LAM_API void lam_check_cache_free(lam_check_cache *cache); // NULL is allowed

// The lighting terms that an exercise requires.
typedef enum lam_check_term {
    LAM_CHECK_TERM_AMBIENT = 1,  // light from everywhere
    LAM_CHECK_TERM_DIFFUSE = 2,  // matt reflection
    LAM_CHECK_TERM_SPECULAR = 4, // highlights
    LAM_CHECK_TERM_ALL = 7       // all of them
} lam_check_term;

// The shaders to check, and the settings of the check. Zero is the default of each field.
typedef struct lam_check_params {
    const char *fragment;      // GLSL; required
    const char *fragment_name; // the file's name, for messages
    // NULL: the check generates a correct vertex shader that writes the inputs of the fragment shader.
    const char *vertex;
    const char *vertex_name; // as fragment_name
    // The names that the shaders use. NULL: the built-in contract that fits their names.
    const lam_check_contract *contract;
    int size; // width and height of each picture, 32..1024 pixels; 0: 128
    // Largest allowed difference of a channel, 1 = full range; 0: 2/255. A scene passes if at most one pixel in 200
    // exceeds it and the mean difference is at most a quarter of it.
    double tolerance;
    // The space of light positions: LAM_FRAME_OBJECT or LAM_FRAME_CAMERA; LAM_FRAME_WORLD: the contract's space.
    lam_light_frame light_frame;
    // The expected highlight: LAM_REFLECTION_PHONG or LAM_REFLECTION_BLINN_PHONG; AUTO: the contract's highlight.
    lam_reflection reflection;
    // Names of the scenes to use; NULL: every scene that the contract can express.
    const char *const *scenes;
    int scene_count;        // of `scenes`
    const char *gl_device;  // as lam_gl_params.device; NULL: the first usable one
    lam_check_cache *cache; // NULL if there is none
    // Runs lam_check_draw in another process. NULL: in this process, for trusted shaders.
    lam_check_draw_fn *draw;
    void *user; // passed to `draw`
    // The terms that the shaders are expected to compute, bits of lam_check_term; 0: the terms for which the shaders
    // declare a name. A colour that is not declared counts as white.
    unsigned terms;
    // The search for mistakes ends after comparing this many pictures of combined mistakes; 0: 10000. The search gives
    // the same result on every machine, with or without a cache.
    uint64_t max_pictures;
    // Draws instead of OpenGL. NULL: OpenGL draws, on `gl_device`. If `draw` is set, it still draws the shaders under
    // test. The caller keeps the painter and its data valid until the check and its cache are freed.
    const lam_check_painter *painter;
    // The roles of inputs, such as "observer=eye", for shaders whose names fit no contract. The list ends with NULL. NULL:
    // the check finds the roles. The roles are those that a report names with `explain_roles`.
    const char *const *roles;
    bool explain_roles; // adds a hint for each input: its role, and the reason
    LAM_RESERVED(11);
} lam_check_params;

// The result of a check.
typedef enum lam_check_verdict {
    LAM_CHECK_PASSES = 0, // every scene matches the reference
    LAM_CHECK_DIFFERS,    // at least one scene differs
    LAM_CHECK_REFUSED,    // a shader does not compile or link
    LAM_CHECK_ENDLESS,    // drawing exceeded its time limit
    LAM_CHECK_CRASHES,    // drawing crashed the driver
    LAM_CHECK_NOT_NUMBER, // NaN or infinity in a picture
    LAM_CHECK_MEMORY,     // drawing exceeded its memory limit
} lam_check_verdict;

// The result of one scene. The check compares a pixel if the pixel and its eight neighbours are inside the model. The
// check first clamps colours to 0…1, as on a screen.
typedef struct lam_check_scene {
    const char *name, *description; // the scene's name and description
    lam_image theirs, reference;    // LAM_RGBA32F, straight alpha
    double maximum, mean;           // largest and mean difference of a channel
    double share_over;              // fraction of the pixels over the tolerance
    uint64_t pixels;                // number of compared pixels
    uint64_t not_numbers;           // pixels with NaN or infinity
    bool passes;                    // within the tolerance
    // The mistake that explains this scene alone, by id. NULL: none, or the scene passes.
    const char *looks_like;
    // The terms that the scene tests, bits of lam_check_term; 0: the scene is black, since none of its terms is
    // required.
    unsigned terms;
    // The points that the scene is worth, from `weights` of the contract; 1 by default.
    double weight;
    LAM_RESERVED(6);
} lam_check_scene;

// A mistake that explains the pictures.
typedef struct lam_check_finding {
    const char *mistake;     // the mistake's id
    const char *explanation; // one sentence
    char *correction;        // code to write instead, in the shader's own names
    // This mistake and the findings before it explain every picture within the tolerance.
    bool certain;
    // Mean difference over all scenes without and with the mistake.
    double mean_before, mean_after;
    // The share of the difference that this mistake and the earlier ones explain: 1 if they explain all of it.
    double share;
    // The ids of mistakes with the same pictures, separated by blanks; NULL: there are none.
    const char *also;
    LAM_RESERVED(6);
} lam_check_finding;

// The origin of a message.
typedef enum lam_check_diagnostic_kind {
    LAM_CHECK_DIAGNOSTIC_COMPILER, // a message of the driver's compiler
    LAM_CHECK_DIAGNOSTIC_HINT,     // an explanation of such a message, or a remark
    LAM_CHECK_DIAGNOSTIC_UNKNOWN,  // a name that is missing in the contract
} lam_check_diagnostic_kind;

// A message about a shader.
typedef struct lam_check_diagnostic {
    lam_check_diagnostic_kind kind; // its origin
    const char *file;               // as given in lam_check_params; NULL: both files or none
    int line;                       // 0: unknown
    char *text;                     // one sentence
    LAM_RESERVED(4);
} lam_check_diagnostic;

// The result of a check, with a result for each scene.
typedef struct lam_check_report {
    lam_check_verdict verdict; // over all scenes
    const char *contract;      // the name of the given or recognised contract
    bool vertex_lit;           // the vertex shader computes the lighting
    bool made_vertex;          // the vertex shader was generated
    char driver[128];          // the renderer name that OpenGL reports
    lam_check_scene *scenes;   // in the order of lam_check_scene_name
    int scene_count;           // 0 if nothing was drawn
    double mean;               // mean difference over all scenes
    // The findings in the order found: the first one explains most.
    lam_check_finding *findings;
    int finding_count;                 // 0: no known mistake was found
    lam_check_diagnostic *diagnostics; // messages, in no order of importance
    int diagnostic_count;              // of `diagnostics`
    void *memory;                      // owns the strings above
    int scenes_wanted;                 // scenes that the shaders should have drawn
    bool search_stopped;               // whether the search for mistakes ended at max_pictures
    uint64_t tried;                    // number of compared mistakes and combinations of mistakes
    const char *contract_text;         // the file of that contract
    LAM_RESERVED(5);
} lam_check_report;

// Runs a check. Returns false only if there is no verdict: LAM_BAD_ARGUMENT (no contract fits, an unknown scene),
// LAM_UNSUPPORTED (no OpenGL), LAM_LIMIT. The caller frees the report.
LAM_API bool lam_check_run(const lam_check_params *params, lam_check_report *report, lam_error *error);
LAM_API void lam_check_report_free(lam_check_report *report); // a zeroed report is allowed

// Writes a contract file for a pair of shaders: the contract of `report`, or, if `report` is NULL, roles guessed from
// the use of their inputs. A comment beside each entry states its meaning and what to correct. A check with this file
// gives the verdict of the report. The caller frees `out` with lam_bytes_free. Fails with LAM_BAD_ARGUMENT (the vertex
// shader is missing, or the check does not understand this kind of shaders) or LAM_LIMIT.
LAM_API bool lam_check_contract_write(const lam_check_params *params, const lam_check_report *report, lam_bytes *out,
                                      lam_error *error);

LAM_API const char *lam_check_verdict_name(lam_check_verdict verdict); // "passes", …; NULL if out of range

#ifdef __cplusplus
}
#endif
#endif
