// gl_device.h: what the parts of the OpenGL device hand to each other.
//
//   meshes        arrays of a mesh → vertex buffers, once                        gl_meshes.c
//   programs      choices → compiled shaders, once (glsl.h has the text)         gl_programs.c
//   lists         lights and materials × lights → uniform blocks or textures     gl_light_buffers.c
//   application   colours of vertices from the CPU's equations                   gl_vertex_lighting.c
//   targets       framebuffers of one part of the picture                        gl_targets.c
//   passes        samples, opaque surfaces, layers of translucent ones           gl_passes.c
//   reading       linear light → the image                                       gl_readback.c
//
// Everything is kept from frame to frame and sent again only where it has changed.
#ifndef GL_DEVICE_H
#define GL_DEVICE_H

#include "context.h"
#include "device_type.h"
#include "glsl.h"

enum {
    PART_MOST = 2048, // pixels on a side of the part of a picture that is drawn at once
};

enum texture_unit {
    UNIT_ENVIRONMENT,
    UNIT_LIGHTS,
    UNIT_PRODUCTS,
    UNIT_NEARER, // places of the layer in front
    UNIT_OPAQUE, // places of the opaque surfaces
    UNIT_COPY,
    UNIT_COUNT
};
enum block_point { POINT_LIGHTS, POINT_PRODUCTS, POINT_BACK_PRODUCTS, POINT_COUNT };

// --- meshes

// The vertices of a mesh as they are sent: three for each triangle, or shared.
enum vertex_form {
    FORM_SHARED, // as the mesh has them, with its indices
    FORM_CORNERS,
    FORM_FLAT_FACE,   // corners whose normal is the triangle's own
    FORM_FLAT_VERTEX, // all three lit with the last corner's normal
};

// One vertex before it is packed.
struct mesh_vertex {
    float position[3], normal[3], color[4], tangent[3];
};

// A run of a mesh's triangles, and which draw call it is part of.
struct mesh_run {
    uint32_t first, count;
    int call;
};

struct gl_mesh {
    struct scene_token *token; // held; NULL: the row is free
    lam_mesh mesh;             // the arrays that it was made of
    enum vertex_form form;
    struct mesh_run *runs; // where runs of one material lie apart: the elements have them side by side
    int run_count;
    GLuint vertices, elements, array; // buffers, vertex array
    uint64_t bytes;
    uint64_t used; // number of the frame that last drew it
};

// Colours of one draw for the stage `application`.
struct gl_colors {
    struct buffer made_of, now;          // what decides them: of the colours that were sent, of this frame
    struct lam_environment *environment; // held: its address is part of what decides them
    size_t made_size;
    GLuint colors, array;
    GLuint of_vertices; // the mesh buffer that the array reads positions from
    uint64_t bytes;
};

// --- programs

enum uniform {
    UNIFORM_MODEL_VIEW_PROJECTION,
    UNIFORM_MODEL_VIEW,
    UNIFORM_NORMAL_MATRIX,
    UNIFORM_ENVIRONMENT_MATRIX,
    UNIFORM_OBJECT,
    UNIFORM_HEAD, // of the material beside products: one for each field of its layout
    UNIFORM_BACK_HEAD = UNIFORM_HEAD + LAM_FIELDS_MAX,
    UNIFORM_FLOATS = UNIFORM_BACK_HEAD + LAM_FIELDS_MAX, // those above hold floats
    UNIFORM_FIRST_PRODUCT = UNIFORM_FLOATS,
    UNIFORM_BACK_FIRST_PRODUCT,
    UNIFORM_FIRST_TRIANGLE,
    UNIFORM_COUNT
};

struct gl_program {
    struct glsl_choices choices;
    GLuint name;
    GLint locations[UNIFORM_COUNT];   // −1: it has none
    float values[UNIFORM_FLOATS][16]; // what was set last
    int numbers[UNIFORM_COUNT - UNIFORM_FLOATS];
    bool set[UNIFORM_COUNT];
};

// --- targets

struct gl_target {
    GLuint framebuffer, color, place, depth; // textures; 0: it has none
};

struct gl_targets {
    int width, height; // room
    bool layered;
    struct gl_target sample;    // one sample of each pixel: the opaque surfaces
    struct gl_target layers[2]; // a layer of translucent surfaces and the one before it
    struct gl_target sum;       // layers over each other
    struct gl_target picture;   // samples together
};

// --- lists

// A list on the device and what it holds.
struct gl_list {
    GLuint name; // buffer or texture
    bool texture;
    size_t size;          // bytes in use
    size_t room;          // bytes of a buffer, rows of a texture
    struct buffer shadow; // the same bytes
    struct buffer next;   // this frame's, before they are compared
};

// How fragments go into the target.
enum gl_blending {
    BLENDING_UNKNOWN,
    BLENDING_NEAREST, // by their depth
    BLENDING_ADD,     // all are added up
    BLENDING_UNDER,   // as far as what is there lets through
};

// What the context has now, so that nothing is set twice. Forgotten at the start of a frame in the caller's context.
struct gl_now {
    GLuint program, array, framebuffer;
    int unit; // of textures; −1: unknown
    GLuint textures[UNIT_COUNT];
    struct {
        GLuint buffer;
        size_t offset, size;
    } blocks[POINT_COUNT];
    int cull;                           // lam_cull; −1: unknown
    lam_cull culled;                    // the side that was named last; LAM_CULL_NONE: unknown
    int front;                          // 1: mirrored
    enum gl_blending blending, factors; // factors: of the last that was not BLENDING_NEAREST
    int width, height;                  // of the viewport
};

struct gl_device {
    struct lam_device base;
    struct gl_context context;
    bool callers; // the context is the caller's
    GLint block_most, block_alignment, texture_most;
    GLenum float_format; // of the targets: GL_RGBA32F, or GL_RGBA16F where that is all there is

    struct gl_mesh *meshes;
    int mesh_count, mesh_room;
    struct gl_colors *colors; // one for each draw
    int color_room;
    struct gl_program *programs;
    int program_count, program_room;
    GLuint copy_program, empty_array;
    GLint copy_factor;
    float copy_factor_now;
    GLuint query;
    struct gl_targets targets;
    struct gl_list lights, products;
    struct lam_environment *environment; // held; that of the texture
    GLuint environment_texture;
    uint64_t environment_bytes, target_bytes;
    struct gl_now now;
    struct buffer scratch, pixels; // vertices on their way; pixels on their way back
    struct buffer surfaces, runs;  // draw calls of the frame; runs of the draw that is being set up

    float decode_srgb[256];
    uint64_t frame_number;
};

// One surface as it is drawn: a draw call.
struct gl_surface {
    const struct frame_draw_range *surface; // the first of its runs
    uint32_t first, count;                  // vertices or elements
    const struct frame_draw *draw;
    struct gl_program *program;
    GLuint array;
    bool by_elements;
    bool lit; // the program reads the lists
};

// What one frame hands on.
struct gl_frame {
    struct gl_device *device;
    const struct gl *gl;
    const struct frame *frame;
    struct call_control *call;
    lam_image *image;
    struct gl_surface *surfaces; // draw calls
    int surface_count;
    enum glsl_storage storage;
    bool layered; // translucent surfaces are peeled
    lam_stage stage;
    size_t material_step; // bytes or texels from one material's products to the next's
    // The part of the picture, and where in its pixels the sample lies (pixels from the centre, y down).
    int left, top, width, height;
    float sample_x, sample_y;
};

// Counts memory that OpenGL holds for the device against the frame's budget.
bool gl_charge(struct gl_frame *f, uint64_t *held, uint64_t bytes, lam_error *error);

// New contents of a vertex buffer, to be written in place and then unmapped (GL_ARRAY_BUFFER). NULL: the
// error tells.
void *gl_map_new(struct gl_frame *f, GLuint buffer, size_t bytes, GLenum usage, lam_error *error);

// State that is set only where it is another.
void gl_use_program(struct gl_device *device, GLuint program);
void gl_use_array(struct gl_device *device, GLuint array);
void gl_use_texture(struct gl_device *device, enum texture_unit unit, GLenum target, GLuint texture);
void gl_use_framebuffer(struct gl_device *device, GLuint framebuffer);
void gl_use_blending(struct gl_device *device, enum gl_blending blending);
void gl_use_viewport(struct gl_device *device, int width, int height);
void gl_use_cull(struct gl_device *device, lam_cull cull);
void gl_forget(struct gl_device *device); // nothing is known of the context

// --- gl_meshes.c
bool mesh_can_share(const lam_mesh *mesh);
// Vertices `first` … of a mesh in a form, in the order in which they are sent.
void mesh_vertices(const struct gl_device *device, const lam_mesh *mesh, enum vertex_form form, uint32_t first,
                   uint32_t count, struct mesh_vertex *out);
uint32_t mesh_vertex_count(const lam_mesh *mesh, enum vertex_form form);
// The mesh's buffers, made where they are not there yet; with runs (NULL: none) the elements are in the order
// of their calls. The pointer lasts until the next call. NULL: the error tells.
struct gl_mesh *mesh_on_device(struct gl_frame *f, const lam_mesh *mesh, enum vertex_form form,
                               const struct mesh_run *runs, int run_count, lam_error *error);
// Lets go of the meshes of scenes that are gone, and of those that the frame's scene no longer has.
void meshes_drop(struct gl_frame *f);
void meshes_free(struct gl_device *device);

// --- gl_vertex_lighting.c
// The vertex array of a draw with the colours that the CPU's equations give its vertices. 0: the error tells.
GLuint colors_on_device(struct gl_frame *f, int draw, struct gl_mesh *mesh, lam_error *error);
void colors_free(struct gl_device *device);

// --- gl_programs.c
struct gl_program *program_for(struct gl_frame *f, const struct glsl_choices *choices, lam_error *error);
void program_set(struct gl_frame *f, struct gl_program *program, enum uniform uniform, const float *values, int count);
void program_set_number(struct gl_frame *f, struct gl_program *program, enum uniform uniform, int value);
bool program_copy_make(struct gl_device *device, lam_error *error);
void programs_free(struct gl_device *device);

// --- gl_light_buffers.c
bool lists_send(struct gl_frame *f, const struct glsl_choices *choices, lam_error *error);
enum glsl_storage lists_storage(const struct gl_device *device, const struct glsl_choices *choices);
bool environment_send(struct gl_frame *f, lam_error *error);
void lists_free(struct gl_device *device);

// --- gl_targets.c
bool targets_make(struct gl_frame *f, int width, int height, bool layered, lam_error *error);
bool targets_find_format(struct gl_device *device, lam_error *error);
void targets_free(struct gl_device *device);

// --- gl_passes.c
// Draws the part; the framebuffer to read is left bound.
bool passes_draw(struct gl_frame *f, lam_error *error);

// --- gl_readback.c
bool reading_part(struct gl_frame *f, lam_error *error);

// --- gl_state_save.c: the caller's state, taken before a frame and given back after it
struct gl_saved_state {
    GLint program, array, draw_framebuffer, read_framebuffer, active_unit;
    GLint array_buffer, uniform_buffer, unpack_buffer, pack_buffer;
    GLint texture_2d[UNIT_COUNT], texture_array[UNIT_COUNT], sampler[UNIT_COUNT];
    GLint block_buffer[POINT_COUNT], block_offset[POINT_COUNT], block_size[POINT_COUNT];
    GLint viewport[4], depth_function, cull_side, front_face, blend[4], blend_equation[2];
    GLint unpack[6], pack[4], polygon_mode[2];
    GLboolean color_mask[4], depth_mask, enabled[16];
};
void caller_save(const struct gl_device *device, struct gl_saved_state *state);
void caller_restore(const struct gl_device *device, const struct gl_saved_state *state);

#endif
