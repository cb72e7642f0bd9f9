// draw_request.h: the messages to and from the drawing process, as bytes.
#ifndef DRAW_REQUEST_H
#define DRAW_REQUEST_H

#include "contract.h"
#include "shader_interface.h"

#include <lambent/check.h>

struct draw_request {
    const char *contract; // the contents of the file
    int light_frame;      // the lam_light_frame of all lights; WORLD means the frame in the contract
    int size;             // of the pictures; READ_ONLY: the result is that of declarations_pack for both shaders
    unsigned scenes;      // bit i: reference_scenes[i]
    const char *vertex, *fragment;
    int lines[2]; // as in struct complete_texts
};

enum { READ_ONLY = 0 };

enum draw_state { DRAWN_PICTURES, DRAWN_REFUSED, DRAWN_REFUSED_LINK, DRAWN_SLOW };

enum { MAX_UNKNOWN_NAMES = 16 };

struct draw_result {
    int state;                          // enum draw_state
    int group_counts[MAX_LIGHT_GROUPS]; // for each array of lights, the number of lights that the driver uses
    char driver[128];
    bool refused_vertex, refused_fragment; // with DRAWN_REFUSED, the shaders that do not compile
    // the log of the vertex shader or the linker; with DRAWN_SLOW, the name of the scene
    char log[4096];
    char fragment_log[4096];
    double seconds;                      // with DRAWN_SLOW, the processor time of that scene
    char unknown[MAX_UNKNOWN_NAMES][64]; // active uniforms and attributes that are not in the contract
    char types[MAX_UNKNOWN_NAMES][96];   // messages about uniforms whose type does not fit
    int unknown_count, types_count;
    unsigned scenes; // same as in the request
    // One RGBA picture after the other, each with the top row first, inside the message.
    const float *pixels;
};

bool draw_request_write(const struct draw_request *request, lam_bytes *out, lam_error *error);
// Reads a request, whose strings point into `bytes`.
bool draw_request_read(const void *bytes, size_t size, struct draw_request *request, lam_error *error);

// Writes a result. `pictures` contains size² × 4 floats for each scene of the request and may be NULL.
bool draw_result_write(const struct draw_result *result, const float *pictures, size_t count, lam_bytes *out,
                       lam_error *error);
bool draw_result_read(const lam_bytes *bytes, int size, struct draw_result *result, lam_error *error);

// --- draws the pictures of a request with any painter.

// Implements lam_check_draw.
bool check_draw(const void *request, size_t size, const lam_check_painter *painter, lam_bytes *out, lam_error *error);

// --- the painter that draws with OpenGL, which is loaded at run time.

// Returns a painter that uses OpenGL. `device` has the syntax of lam_gl_params.device and must stay valid while
// contexts are opened. NULL selects the first usable device.
lam_check_painter gl_painter(const char *device);

// --- determines the language of a pair of shaders, and converts the sources for the compiler.

// Returns the compiler for the shaders. Shaders without a version line are for WebGL (OpenGL ES) if they contain a
// precision statement or qualifier and use no built-in name of desktop OpenGL.
lam_check_language shader_dialect_language(const struct shader_interface *interface);

// Returns whether the source contains `mediump` or `lowp`, or reads textures with lowp, the default precision of
// samplers in OpenGL ES.
bool shader_dialect_lowers_precision(const char *text);

// Returns a copy of the source, allocated with malloc. In the copy, `highp` replaces every `mediump` and `lowp`, and
// samplers are `highp`. Line numbers do not change. For lower precisions, drivers may compute with 16 bits. The
// pictures of a correct shader would then differ visibly. Returns NULL if memory runs out.
char *shader_dialect_highp(const char *text);

// Returns the source without a leading byte order mark. Some editors write this mark, but compilers reject it.
const char *shader_dialect_skip_mark(const char *text);

// Converts a source in desktop GLSL to GLSL ES 3.00. Returns the copy, allocated with malloc. Line numbers do not
// change. The copy contains another version line, a precision, the keywords of ES 3.00 instead of older keywords, and
// other names for OpenGL's built-in inputs. The compiler reports remaining differences, such as implicit conversion to
// floats. Returns NULL and fills
// `error` on failure.
char *shader_dialect_es(const char *text, bool is_vertex, lam_error *error);

// Returns the built-in input for a name in a converted source, as a static row, or NULL if there is none.
const struct contract_name *shader_dialect_built_in(const char *name);

// Restores the author's names, in place, in messages about a converted source.
void shader_dialect_restore(char *log);

// --- generates a correct vertex shader for a fragment shader that is checked alone.

// Returns the source, allocated with malloc. The vertex shader writes every varying that the fragment shader declares
// as an input, with the same name and type. The vertex shader sets unknown varyings to zero. `unknown` lists the
// unknown varyings that the fragment shader uses, separated by ", ". On failure, sets `error` and returns NULL.
char *default_vertex_shader(const struct shader_interface *interface, char unknown[256], lam_error *error);

#endif
