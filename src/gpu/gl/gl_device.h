// gl_device.h: the modules of the OpenGL device, with their shared data and their functions.
//
//   meshes           arrays of a mesh -> vertex buffers, once                    gl_meshes.c
//   programs         choices -> compiled shaders, once (glsl.h makes the text)   gl_programs.c
//   textures         a material's textures -> textures, once                     gl_textures.c
//   light buffers    lights and products -> uniform blocks or textures           gl_light_buffers.c
//   vertex lighting  vertex colours from the CPU's shading                       gl_vertex_lighting.c
//   occlusion        distances -> ambient occlusion of each pixel                gl_occlusion.c
//   targets          framebuffers of one part of the picture                     gl_targets.c
//   passes           samples, opaque surfaces, layers of translucent ones        gl_passes.c
//   targets          linear light -> the image                                   gl_targets.c
//   state            the setters of OpenGL state                                 gl_state.c
//
// All GL objects persist from frame to frame; data are uploaded again only after a change.
#ifndef GL_DEVICE_H
#define GL_DEVICE_H

#include "context.h"
#include "device_type.h"
#include "fields.h"
#include "glsl_declarations.h"
#include "occlusion.h"
#include "rays.h"
#include "vertex_colors.h"

enum {
    PART_SIZE_MAX = 2048, // the largest width and height, in pixels, of a part of the picture that is drawn in one pass
};

enum texture_unit {
    UNIT_ENVIRONMENT,
    UNIT_LIGHTS,
    UNIT_PRODUCTS,
    UNIT_NEARER_DEPTH_IDS, // depth and triangle number of the previous layer
    UNIT_OPAQUE_DEPTH_IDS, // depth and triangle number of the opaque surfaces
    UNIT_OCCLUSION =
        // shared, because only translucent surfaces read depth ids, and occlusion dims none of them except the ground
    UNIT_NEARER_DEPTH_IDS,
    UNIT_ENVIRONMENT_LIGHT = UNIT_OPAQUE_DEPTH_IDS + 1,
    UNIT_COPY,
    UNIT_SHADOW_TREE = UNIT_COPY,           // no program reads both textures
    UNIT_FIRST_MAP,                         // the maps of materials
    UNIT_GROUND_OCCLUSION = UNIT_FIRST_MAP, // a ground has no maps
    // the maximum; every driver supports 16 (OpenGL 3.3 and ES 3.0), most support 32 (gl_device.unit_count)
    UNIT_COUNT = 48
};
enum block_point { POINT_LIGHTS, POINT_PRODUCTS, POINT_BACK_PRODUCTS, POINT_COUNT };

// --- meshes

// The layout of a mesh's vertices in its buffer.
enum vertex_form {
    FORM_SHARED,      // the mesh's own vertices and indices
    FORM_CORNERS,     // three vertices for each triangle
    FORM_FLAT_FACE,   // corners with the normal of the triangle
    FORM_FLAT_VERTEX, // corners with the normal of the triangle's last corner
};

// One vertex before it is packed.
struct mesh_vertex {
    float position[3], normal[3], color[4], tangent[4], texcoord[2], second_texcoord[2];
};

// Consecutive triangles of a mesh that belong to one draw call.
struct mesh_run {
    uint32_t first, count;
    int call; // index among the calls of the draw
};

struct gl_mesh {
    struct scene_token *token; // a counted reference; NULL means the entry is free
    lam_mesh mesh;             // the arrays from which the buffers were made
    enum vertex_form form;
    bool passing; // the arrays belong to one frame only
    // The runs of the draw calls, if the element buffer orders the triangles by call. This order is necessary only if
    // the runs of one call are not consecutive.
    struct mesh_run *runs;
    int run_count;
    GLuint vertices, elements, array; // buffers, vertex array
    uint64_t bytes;
    uint64_t last_frame; // number of the last frame that drew the mesh
};

// --- textures

struct gl_texture {
    struct lam_texture *texture; // shared texture; NULL means the entry is free
    struct scene_token *token;   // a counted reference: the scene that was drawn when the texture was uploaded
    GLuint name;
    uint64_t bytes;
    uint64_t last_frame; // number of the last frame that used the texture
};

// The state of a texture unit that determines wrapping and filtering.
struct gl_sampler {
    GLuint name; // 0 if not made
    int anisotropy;
};
enum { SAMPLER_COUNT = 2 * LAM_WRAP_COUNT * LAM_WRAP_COUNT * LAM_FILTER_COUNT * LAM_FILTER_COUNT * LAM_MIP_COUNT };

// The vertex colours of one draw after lighting, for LAM_STAGE_APPLICATION.
struct gl_vertex_lighting {
    uint64_t key; // hash of all inputs of the colours in the buffer (gl_key_add); 0 means none
    // A counted reference, because the key contains the environment's address.
    struct lam_environment *environment;
    GLuint colors, array;
    bool
        // each vertex has four colours: two for the front and two for the back (glsl_stage.separate_texture_terms)
        separate_texture_terms;
    GLuint of_vertices; // the mesh buffer with the positions for `array`
    uint64_t bytes;
};

// --- programs

// Uniforms that are not rows of glsl_declarations.h. The program's rows follow.
enum {
    UNIFORM_SHADOW_MATRIX,
    UNIFORM_SHADOW_OFFSETS,
    UNIFORM_SHADOW_ROUNDING,
    UNIFORM_FIRST_TRIANGLE,
    UNIFORM_SAMPLE,
    UNIFORM_ROWS
};

struct gl_uniform {
    GLint location; // −1 if the program does not have the uniform
    bool set;       // whether a value has been set
    float value[16];
    struct glsl_row row;
};

struct gl_program {
    struct glsl_choices choices;
    GLuint name;
    struct gl_uniform *uniforms;
    int uniform_count;
    uint8_t map_units[2][LAM_MAP_COUNT]; // texture units of the maps of the front and the back, or 0
};

// --- targets

// A framebuffer and its textures. A texture that the target does not use is 0. depth_id: depth and triangle number of
// each pixel.
struct gl_target {
    GLuint framebuffer, color, depth_id, depth;
    GLuint through; // transmittance of a layer for each channel
};

struct gl_targets {
    int width, height; // the size of all textures, at least the part's size
    bool layered, tinted;
    struct gl_target tint;      // with `tinted`, the transmittance of all layers so far
    struct gl_target sample;    // the opaque surfaces at one sample of each pixel
    struct gl_target layers[2]; // the current layer of translucent surfaces, and the previous one
    struct gl_target sum;       // the layers composited
    struct gl_target picture;   // the average of the samples
};

// --- light buffers

// A uniform block or a texture, and a copy of its contents.
struct gl_light_buffer {
    GLuint name; // buffer or texture
    bool texture;
    size_t size;        // bytes in use
    size_t capacity;    // bytes of a buffer, rows of a texture
    uint64_t key;       // hash of the contents (gl_key_add)
    struct buffer next; // the contents of this frame
};

// How a fragment is combined with the target.
enum gl_blending {
    BLENDING_UNKNOWN,
    BLENDING_NEAREST, // depth test
    BLENDING_ADD,     // sum
    BLENDING_UNDER,   // composited under the target's contents
    BLENDING_MULTIPLY,
};

// A copy of the context's current state. The device uses this copy to skip calls that would not change the state. In
// the caller's context, the state is unknown at the start of a frame.
struct gl_current_state {
    GLuint program, array, framebuffer;
    int unit; // active texture unit; −1 if unknown
    GLuint textures[UNIT_COUNT], samplers[UNIT_COUNT];
    struct {
        GLuint buffer;
        size_t offset, size;
    } blocks[POINT_COUNT];
    int cull;                  // lam_cull; −1 if unknown
    lam_cull culled;           // the argument of the last glCullFace; LAM_CULL_NONE if unknown
    int front;                 // 1 if mirrored
    enum gl_blending blending; // BLENDING_UNKNOWN: unknown
    enum gl_blending factors;  // the arguments of the last glBlendFunc
    int width, height;         // viewport
};

// The surfaces that transmit light. The texture of the hierarchy also stores these surfaces, after the hierarchy
// (gl_shadows.c).
struct gl_surfaces {
    // hashes of all inputs: `key` for the texels in the texture, `next_key` for the texels of this frame; 0 means no
    // texels
    uint64_t key, next_key;
    // for the current frame: the first record of each range, and the positions of the textures
    struct buffer records, pixels;
};

struct gl_device {
    struct lam_device base;
    struct gl_context context;
    bool external_context;          // the context is the caller's
    const struct glsl_style *style; // same as in glsl_choices
    int mistake;
    bool hardware_filter; // lam_gl_params
    GLint block_size_max, block_alignment, texture_size_max;
    GLint unit_count; // number of texture units that fragment shaders may use, up to UNIT_COUNT
    bool has_norm16;  // the driver supports textures with 16 bits per channel for values from 0 to 1
    // the format of the targets: GL_RGBA32F, or GL_RGBA16F if the driver does not support GL_RGBA32F
    GLenum float_format;

    struct gl_mesh *meshes;
    int mesh_count, mesh_capacity;
    struct gl_texture *textures;
    int texture_count, texture_capacity;
    // With hardware_filter, one for each combination of wrapping and filtering, with one and with several
    // probes, made on first use.
    struct gl_sampler samplers[SAMPLER_COUNT];
    GLfloat anisotropy_max;                     // maximum for samplers
    struct gl_vertex_lighting *vertex_lighting; // one for each draw
    int vertex_lighting_capacity;
    struct vertex_colors vertex_colors;
    uint64_t vertex_colors_frame; // number of the frame for which vertex_lighting was set up
    struct gl_program *programs;
    int program_count, program_capacity;
    GLuint copy_program, empty_array;
    GLuint tint_program; // multiplies a layer, or the opaque surfaces, by the tint of the layers in front
    GLint tint_last, tint_background;
    GLint copy_factor; // location of the copy program's uniform `factor`
    float copy_factor_value;
    GLuint query;
    struct gl_targets targets;
    struct buffer occlusion; // planes of struct screen_occlusion
    struct buffer occlusion_rows;
    GLuint occlusion_texture; // the occlusion of the current part
    struct gl_light_buffer lights, products;
    struct lam_environment *environment; // a counted reference; environment_texture contains the faces
    GLuint environment_texture, environment_light_texture;
    const struct environment_light *environment_light; // contents of the texture; owned by `environment`
    struct hierarchy_memory hierarchy;
    GLuint shadow_texture;   // contains the hierarchy
    float shadow_offsets[2]; // first texel of the triangles, and of their positions
    bool shadows_sent;       // whether the texture contains the current hierarchy, and the surfaces with the hash
                             // surfaces.key
    struct gl_surfaces surfaces;
    uint64_t environment_bytes, target_bytes, shadow_bytes;
    struct gl_current_state current;
    struct buffer scratch;    // vertices before an upload
    struct buffer pixels;     // pixels after a readback
    struct buffer draw_calls; // the frame's draw calls
    struct buffer runs;       // the runs of the current draw

    float decode_srgb[256];
    uint64_t frame_number;
};

// A draw call: all ranges of one draw with the same materials.
struct gl_draw_call {
    const struct frame_draw_range *range; // the first of the ranges
    uint32_t first, count;                // vertices or elements
    const struct frame_draw *draw;
    struct gl_program *program;
    GLuint array;
    bool by_elements;
    bool lit; // whether the program reads the light buffers
};

// The state of one call of lam_draw.
struct gl_frame {
    struct gl_device *device;
    const struct gl *gl;
    const struct frame *frame;
    struct call_control *call;
    lam_image *image;
    struct gl_draw_call *draw_calls;
    int draw_call_count;
    enum glsl_storage storage;
    const struct environment_light *environment_light; // the environment's light on physical materials, or NULL
    bool layered;                                      // whether translucent surfaces are drawn by depth peeling
    int surface_layers; // if above 0, the picture shows the distances of this many surfaces behind each pixel
    bool only_opaque;   // translucent and masked surfaces are omitted
    const struct screen_occlusion *occlusion; // may be NULL
    lam_stage stage;
    size_t material_stride; // distance between the products of consecutive materials, in bytes or texels
    // The current part of the picture, and the sample's offset from the pixel's centre (in pixels, with y downwards).
    int left, top, width, height;
    float sample_x, sample_y;
    int sample; // the sample's position in the order of the distances from the centre
};

// Returns whether a range is composited over the surfaces behind it. Masked surfaces are not composited, because each
// of their points is either opaque or omitted.
static inline bool range_blends(const struct frame *frame, const struct frame_draw_range *range)
{
    if (frame->transmits && frame_is_physical(range->reflection) &&
        (frame_layers(frame, frame->materials[range->front]) | frame_layers(frame, frame->materials[range->back])) &
            LAYER_TRANSMISSION)
        return true;
    return range->translucent &&
           (frame->materials[range->front]->alpha_mode == LAM_ALPHA_BLEND ||
            (!frame->draws[range->draw].one_sided && frame->materials[range->back]->alpha_mode == LAM_ALPHA_BLEND));
}

// --- gl_state.c

// Counts a GL object of `bytes` bytes towards the frame's memory limit, instead of its previous size `*held`. Sets
// `*held` to `bytes`.
bool gl_charge(struct gl_frame *f, uint64_t *held, uint64_t bytes, lam_error *error);

// Allocates new contents of a vertex buffer and maps them for writing; the caller writes all bytes and unmaps
// GL_ARRAY_BUFFER. Returns NULL on failure.
void *gl_buffer_map_new(struct gl_frame *f, GLuint buffer, size_t bytes, GLenum usage, lam_error *error);

// Sets an attribute of the vertex array to `size` floats of each vertex in the bound buffer. `at` is the index of the
// first of these floats in the vertex.
void gl_point_to(struct gl_frame *f, GLuint location, GLint size, size_t stride, size_t at);

// Adds bytes to a key, a 64-bit hash of the inputs of uploaded data. The data are uploaded again if the key has
// changed.
void gl_key_add(uint64_t *key, const void *bytes, size_t count);

// Returns the list with space for another row, or NULL on failure.
void *gl_grown(void *list, int count, int *capacity, size_t size, lam_error *error);

// Each function sets a state, but makes no OpenGL call if the state is already current.
void gl_use_program(struct gl_device *device, GLuint program);
void gl_use_array(struct gl_device *device, GLuint array);
void gl_use_texture(struct gl_device *device, enum texture_unit unit, GLenum target, GLuint texture);
// Binds a sampler to a texture unit; 0 selects the texture's own sampler.
void gl_use_sampler(struct gl_device *device, enum texture_unit unit, GLuint sampler);
// Does the same as gl_use_texture, and makes the unit active. Uploads require an active unit.
void gl_edit_texture(struct gl_device *device, enum texture_unit unit, GLenum target, GLuint texture);
// Does the same as gl_edit_texture. If *name is 0, first makes a texture with one level, nearest filtering and no
// repetition.
void gl_edit_plain_texture(struct gl_device *device, enum texture_unit unit, GLenum target, GLuint *name);
void gl_use_framebuffer(struct gl_device *device, GLuint framebuffer);
void gl_use_blending(struct gl_device *device, enum gl_blending blending);
void gl_use_viewport(struct gl_device *device, int width, int height);
void gl_use_cull(struct gl_device *device, lam_cull cull);
// Marks all current state as unknown.
void gl_state_invalidate(struct gl_device *device);

// --- gl_meshes.c
bool mesh_can_share(const lam_mesh *mesh);
uint32_t mesh_vertex_count(const lam_mesh *mesh, enum vertex_form form);
// Returns the mesh's buffers, and creates them on first use. If `passing` is set, the mesh's arrays belong to this
// frame only. If `runs` is not NULL, the elements are ordered by call. The pointer is valid until the next call.
// Returns NULL on failure.
struct gl_mesh *mesh_upload(struct gl_frame *f, const lam_mesh *mesh, enum vertex_form form, bool passing,
                            const struct mesh_run *runs, int run_count, lam_error *error);
// Frees the meshes of scenes that no longer exist, and meshes that the frame's scene no longer draws.
void meshes_evict(struct gl_frame *f);
void meshes_free(struct gl_device *device);

// Sets the attributes of a vertex array, by the locations of glsl.h. With `lit`, omits attributes that only lighting
// reads.
void mesh_describe(struct gl_frame *f, const struct gl_mesh *mesh, GLuint array, bool lit);

// --- gl_textures.c

// Uploads the textures that a program reads for a range. textures_use can bind these textures until the frame ends.
bool textures_upload(struct gl_frame *f, const struct gl_program *program, const struct frame_draw_range *range,
                     lam_error *error);
// Binds the textures of the maps.
void textures_use(struct gl_frame *f, const struct gl_program *program, const struct frame_draw_range *range);
// Frees the textures of scenes that no longer exist, and textures that the frame's scene no longer uses.
void textures_evict(struct gl_frame *f);
void textures_free(struct gl_device *device);

// --- gl_vertex_lighting.c

// Returns the vertex array of a draw, with vertex colours from the CPU's shading. Returns 0 on failure.
GLuint vertex_lighting_upload(struct gl_frame *f, int draw, struct gl_mesh *mesh, lam_error *error);
void vertex_lighting_free(struct gl_device *device);

// --- gl_occlusion.c

// The unit from which a program reads ambient occlusion.
static inline enum texture_unit gl_occlusion_unit(const struct gl_program *program)
{
    return program->choices.layer == GLSL_PEELS ? UNIT_GROUND_OCCLUSION : UNIT_OCCLUSION;
}
// Computes the ambient occlusion of the frame's pixels. `distances` is a float picture of the distances to the opaque
// surfaces (LAM_OUTPUT_DEPTH), and the channels of `layers` are struct screen_occlusion's layers. The device owns the
// rows.
bool occlusion_find(struct gl_frame *f, const lam_image *distances, const lam_image *layers,
                    struct screen_occlusion *occlusion, lam_error *error);
// Uploads the occlusion of the current part of the picture.
bool occlusion_send(struct gl_frame *f, lam_error *error);

// --- gl_programs.c

// Returns the program of the choices, compiled on first use. Returns NULL on failure.
struct gl_program *program_for(struct gl_frame *f, const struct glsl_choices *choices, lam_error *error);
// Set a uniform of a program, unless the uniform already has this value. The value is an int, or 1, 4, 9 or 16 floats
// (`count`).
void program_set_int(struct gl_frame *f, struct gl_program *program, int uniform, GLint value);
void program_set(struct gl_frame *f, struct gl_program *program, int uniform, const float *values, int count);
bool program_copy_make(struct gl_device *device, lam_error *error);
void programs_free(struct gl_device *device);

// --- gl_light_buffers.c
bool light_buffers_send(struct gl_frame *f, const struct glsl_choices *choices, lam_error *error);
enum glsl_storage light_buffers_storage(const struct gl_device *device, const struct glsl_choices *choices);
bool environment_send(struct gl_frame *f, lam_error *error);
// Uploads f->environment_light.
bool environment_light_send(struct gl_frame *f, lam_error *error);
void light_buffers_free(struct gl_device *device);

// --- gl_shadows.c

// The memory of the surfaces that transmit light.
uint64_t surfaces_bytes(const struct gl_device *device);
void surfaces_free(struct gl_device *device);
// Uploads the hierarchy of a frame with shadows, and the surfaces that transmit light. Fails with LAM_LIMIT if the
// texture would be too large.
bool shadows_send(struct gl_frame *f, lam_error *error);
// Sets the uniforms and textures for a program with shadows.
void shadows_use(struct gl_frame *f, struct gl_program *program);
void shadows_free(struct gl_device *device);

// --- gl_targets.c
bool targets_make(struct gl_frame *f, int width, int height, bool layered, bool tinted, lam_error *error);
bool targets_find_format(struct gl_device *device, lam_error *error);
void targets_free(struct gl_device *device);

// --- gl_passes.c

// Draws the part. The framebuffer with the result stays bound.
bool passes_draw(struct gl_frame *f, lam_error *error);

// --- gl_targets.c
bool readback_part(struct gl_frame *f, lam_error *error);

// --- gl_state.c: the state of the caller's context, saved before a frame and restored after it
struct gl_saved_state {
    GLint program, array, draw_framebuffer, read_framebuffer, active_unit;
    GLint array_buffer, uniform_buffer, unpack_buffer, pack_buffer;
    GLint texture_2d[UNIT_COUNT], texture_array[UNIT_COUNT], sampler[UNIT_COUNT];
    GLint block_buffer[POINT_COUNT], block_offset[POINT_COUNT], block_size[POINT_COUNT];
    GLint viewport[4], depth_function, cull_side, front_face, blend[4], blend_equation[2];
    GLint unpack[6], pack[4], polygon_mode[2];
    GLboolean color_mask[4], depth_mask, enabled[16];
};
void gl_state_save(const struct gl_device *device, struct gl_saved_state *state);
void gl_state_restore(const struct gl_device *device, const struct gl_saved_state *state);

#endif
