// gl_device.c: creates and frees the OpenGL device, runs the steps of a frame, and reports the memory use.
#include "gl_device.h"

#include "environment.h"
#include "fail.h"
#include "lecture.h"
#include "srgb.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- a frame

// Resets the choices about lighting, for a program that does not compute lighting. Also resets the choices about maps
// if `maps` is false.
static void forget_lighting(struct glsl_choices *c, bool maps)
{
    const struct glsl_choices wanted = *c;
    memset(c, 0, sizeof *c);
    c->two_sided = wanted.two_sided;
    c->output = wanted.output;
    c->stage = wanted.stage;
    c->shading = wanted.shading;
    c->reflection = LAM_REFLECTION_LAMBERT;
    c->alpha[0] = c->alpha[1] = LAM_ALPHA_BLEND;
    if (!maps)
        return;
    bool masks = wanted.alpha[0] == LAM_ALPHA_MASK || wanted.alpha[1] == LAM_ALPHA_MASK;
    memcpy(c->alpha, wanted.alpha, sizeof c->alpha);
    memcpy(c->maps, wanted.maps, sizeof c->maps);
    c->back_material = wanted.back_material;
    c->colors = masks && output_is_value(c->output) && wanted.colors;
}

// Sets the choices for a range's program. A choice that does not affect the program keeps its default, so that equal
// programs have equal choices, byte for byte (program_for).
static void choices_of(const struct gl_frame *f, const struct frame_draw_range *range, struct glsl_choices *c)
{
    glsl_choose(c, f->frame, range, f->stage);
    const bool geometry = glsl_output_is_geometry(c->output), ground = f->frame->draws[range->draw].ground;
    const bool masks = c->alpha[0] == LAM_ALPHA_MASK || c->alpha[1] == LAM_ALPHA_MASK;
    const bool application = c->stage == LAM_STAGE_APPLICATION;
    if (geometry || application)
        forget_lighting(c, geometry ? masks : true);
    if (f->device->hardware_filter && (!geometry || masks))
        glsl_use_hardware_filter(c);
    c->version = f->device->context.es ? GLSL_300_ES : GLSL_330;
    c->storage = f->storage;
    c->encoding = GLSL_PREMULTIPLIED;
    c->layer = !f->layered                                          ? GLSL_NO_LAYERS
               : f->surface_layers || range_blends(f->frame, range) ? GLSL_PEELS
                                                                    : GLSL_WRITES_DEPTH_IDS;
    c->transmits = c->layer == GLSL_PEELS && f->frame->transmits;
    c->products = true;
    c->occlusion = f->occlusion && (!range->translucent || ground);
    if (geometry) {
        c->shading = LAM_SHADING_PHONG;
        c->stage = LAM_STAGE_FRAGMENT;
        return;
    }
    c->style = output_is_value(c->output) ? NULL : f->device->style;
    c->mistake = c->style ? f->device->mistake : 0;
    if (application) {
        if (output_kind(c->output) != OUTPUT_VECTOR)
            c->output = LAM_OUTPUT_PICTURE;
        return;
    }
    c->samples = c->stage == LAM_STAGE_FRAGMENT && !c->style ? (uint8_t)f->frame->settings.samples : 1;
    c->widens = f->frame->widens_highlights && frame_is_physical(c->reflection);
    c->shadows = f->frame->settings.shadows && c->light_count && c->reflection != LAM_REFLECTION_NONE;
    c->passes_rays = c->shadows && f->frame->passes_rays;
    c->tints_rays = c->shadows && f->frame->tints_rays;
    c->catches = ground && f->frame->ground.kind == LAM_GROUND_SHADOW && !output_is_value(c->output);
}

// Returns the mesh of a draw, without texture coordinates that no map uses.
static lam_mesh mesh_as_drawn(const struct gl_frame *f, const struct frame_draw_range *list, int count)
{
    lam_mesh mesh = *f->frame->draws[list->draw].mesh;
    bool read[2] = {false, false};
    for (int i = 0; i < count; i++)
        for (int side = 0; side < 2; side++) {
            const lam_material *material = f->frame->materials[side ? list[i].back : list[i].front];
            unsigned used = frame_maps(f->frame, material);
            for (int k = 0; k < LAM_MAP_COUNT; k++)
                if (used >> k & 1)
                    read[material->maps[k]->texcoords] = true;
        }
    if (!read[0])
        mesh.texcoords = NULL;
    if (!read[1])
        mesh.second_texcoords = NULL;
    return mesh;
}

static enum vertex_form form_of(const struct gl_frame *f, const struct frame_draw_range *range, const lam_mesh *mesh,
                                int draw_all)
{
    const struct frame *frame = f->frame;
    const struct frame_draw *draw = &frame->draws[range->draw];
    struct glsl_choices c;
    choices_of(f, range, &c);
    if (frame->settings.shading == LAM_SHADING_FLAT && !glsl_output_is_geometry(frame->settings.output))
        return (frame->settings.flat_normal == LAM_FLAT_NORMAL_VERTEX || draw->strokes) && draw->mesh->normals
                   ? FORM_FLAT_VERTEX
                   : FORM_FLAT_FACE;
    // Shaders compute triangle numbers as gl_VertexID / 3, and corners as gl_VertexID % 3. A vertex that several
    // materials use has a lit colour for each material.
    bool counts = f->layered || c.samples > 1 || frame->settings.output == LAM_OUTPUT_IDS ||
                  (frame->settings.shadows && f->stage != LAM_STAGE_APPLICATION);
    bool two = f->stage == LAM_STAGE_APPLICATION && draw_all > 1;
    return counts || two || !mesh_can_share(mesh) ? FORM_CORNERS : FORM_SHARED;
}

static bool reads_light_buffers(const struct glsl_choices *c)
{
    return c->stage != LAM_STAGE_APPLICATION && !glsl_output_is_geometry(c->output);
}

static bool same_materials(const struct frame_draw_range *a, const struct frame_draw_range *b)
{
    return a->front == b->front && a->back == b->back && a->translucent == b->translucent;
}

// Appends the draw calls of one draw to f->draw_calls: one call for all ranges with the same materials. Returns 0 if
// the ranges of every call are consecutive. Otherwise fills device->runs and returns the number of runs. Returns −1 on
// failure.
static int add_draw_calls(struct gl_frame *f, const struct frame_draw_range *list, int count, lam_error *error)
{
    const struct frame_draw *draw = &f->frame->draws[list->draw];
    if (!buffer_reserve(&f->device->runs, (size_t)count * sizeof(struct mesh_run), f->call, error))
        return -1;
    struct mesh_run *runs = f->device->runs.data;
    struct gl_draw_call *calls = f->draw_calls + f->draw_call_count;
    int call_count = 0;
    for (int i = 0; i < count; i++) {
        int c = 0;
        while (c < call_count && !same_materials(calls[c].range, &list[i]))
            c++;
        runs[i] = (struct mesh_run){list[i].first_id - draw->first_id, list[i].count, c};
        if (c == call_count)
            calls[call_count++] = (struct gl_draw_call){.range = &list[i], .draw = draw};
        calls[c].count += 3 * list[i].count;
    }
    for (int c = 1; c < call_count; c++)
        calls[c].first = calls[c - 1].first + calls[c - 1].count;
    f->draw_call_count += call_count;
    return call_count < count ? count : 0;
}

// Sets up the buffers and programs of a draw's calls.
static bool set_up_draw(struct gl_frame *f, const struct frame_draw_range *list, int count, lam_error *error)
{
    const struct frame *frame = f->frame;
    int first = f->draw_call_count, runs = add_draw_calls(f, list, count, error);
    if (runs < 0)
        return false;
    const struct frame_draw *draw = &frame->draws[list->draw];
    lam_mesh drawn = mesh_as_drawn(f, list, count);
    struct gl_mesh *mesh = mesh_upload(f, &drawn, form_of(f, list, &drawn, f->draw_call_count - first),
                                       draw->strokes || draw->ground, f->device->runs.data, runs, error);
    if (!mesh)
        return false;
    bool colors = f->stage == LAM_STAGE_APPLICATION && !glsl_output_is_geometry(frame->settings.output);
    GLuint array = colors ? vertex_lighting_upload(f, list->draw, mesh, error) : mesh->array;
    if (!array)
        return false;
    for (int i = first; i < f->draw_call_count; i++) {
        struct gl_draw_call *call = &f->draw_calls[i];
        struct glsl_choices c;
        choices_of(f, call->range, &c);
        call->lit = reads_light_buffers(&c);
        call->array = array;
        call->by_elements = mesh->elements != 0;
        call->program = program_for(f, &c, error); // compiled by set_up
        if (!call->program || !textures_upload(f, call->program, call->range, error) ||
            (c.environment != GLSL_NO_ENVIRONMENT && !environment_send(f, error)) ||
            (c.environment_light && !environment_light_send(f, error)))
            return false;
    }
    return true;
}

// Compiles programs and uploads data before the first draw call.
static bool set_up(struct gl_frame *f, lam_error *error)
{
    const struct frame *frame = f->frame;
    if (!frame->range_count)
        return true;
    if (frame->environment_lights &&
        !(f->environment_light = (frame->separate_lamp ? environment_light_without_lamp : environment_light)(
              frame->environment, ENVIRONMENT_LIGHT_ALL, NULL, f->call, error)))
        return false;
    if (frame->settings.shadows && !shadows_send(f, error))
        return false;
    struct glsl_choices any;
    choices_of(f, &frame->ranges[0], &any);
    f->storage = light_buffers_storage(f->device, &any);
    any.storage = f->storage;
    any.occlusion = f->occlusion != NULL; // the lights are shared by all programs
    any.shadows = frame->settings.shadows;
    if (reads_light_buffers(&any) && !light_buffers_send(f, &any, error))
        return false;
    for (int i = 0; i < frame->range_count; i++) { // all programs are made before set_up_draw stores pointers into
                                                   // device->programs
        struct glsl_choices c;
        choices_of(f, &frame->ranges[i], &c);
        if (!program_for(f, &c, error) || !(call_should_continue(f->call) || call_error(f->call, error)))
            return false;
    }
    for (int first = 0, end; first < frame->range_count; first = end) {
        for (end = first; end < frame->range_count && frame->ranges[end].draw == frame->ranges[first].draw;)
            end++;
        if (!set_up_draw(f, &frame->ranges[first], end - first, error))
            return false;
    }
    return true;
}

static double since(uint64_t *start)
{
    uint64_t now = now_ns();
    double ms = (double)(now - *start) * 1e-6;
    *start = now;
    return ms;
}

static bool check_errors(struct gl_frame *f, lam_error *error)
{
    GLenum code = f->gl->GetError();
    if (code == GL_OUT_OF_MEMORY)
        return fail(error, LAM_MACHINE, "OpenGL: '%s' is out of memory", f->device->context.renderer);
    if (code != GL_NO_ERROR)
        return fail(error, LAM_UNSUPPORTED, "OpenGL: the driver of '%s' reports error 0x%x",
                    f->device->context.renderer, code);
    return !f->device->context.debug || gl_messages_clean(&f->device->context, "drawing", error);
}

// Draws the picture in rectangular parts, no larger than the largest target that the driver supports.
static bool draw_parts(struct gl_frame *f, lam_error *error)
{
    lam_frame_report *report = &f->device->base.report;
    int max = f->device->texture_size_max < PART_SIZE_MAX ? f->device->texture_size_max : PART_SIZE_MAX;
    int width = f->image->width < max ? f->image->width : max, height = f->image->height < max ? f->image->height : max;
    if (!targets_make(f, width, height, f->layered, f->frame->transmits, error))
        return false;
    for (f->top = 0; f->top < f->image->height; f->top += max)
        for (f->left = 0; f->left < f->image->width; f->left += max) {
            f->width = f->image->width - f->left < max ? f->image->width - f->left : max;
            f->height = f->image->height - f->top < max ? f->image->height - f->top : max;
            uint64_t clock = now_ns();
            if (f->occlusion && !occlusion_send(f, error))
                return false;
            if (!passes_draw(f, error))
                return false;
            f->gl->Finish();
            report->draw_ms += since(&clock);
            if (!check_errors(f, error) || !readback_part(f, error))
                return false;
            report->read_ms += since(&clock);
        }
    return true;
}

static bool draw_frame(struct gl_frame *f, lam_error *error)
{
    struct gl_device *device = f->device;
    uint64_t clock = now_ns();
    while (f->gl->GetError() != GL_NO_ERROR) // discards earlier OpenGL errors of the caller
        ;
    if (device->external_context)
        gl_state_invalidate(device);
    if (!buffer_reserve(&device->draw_calls, (size_t)(f->frame->range_count + 1) * sizeof *f->draw_calls, f->call,
                        error))
        return false;
    f->draw_calls = device->draw_calls.data;
    meshes_evict(f);
    textures_evict(f);
    if (!set_up(f, error))
        return false;
    device->base.report.upload_ms = since(&clock) - device->base.report.lighting_ms;
    return draw_parts(f, error) && check_errors(f, error);
}

// Draws the distances of the frame's opaque surfaces: of the visible ones, or the signed distances of the nearest
// `layers` surfaces, one in each channel.
static bool draw_distances(struct gl_frame *f, int layers, lam_image *image, struct buffer *pixels, lam_error *error)
{
    struct frame distances = *f->frame; // a copy that shares the frame's arrays
    distances.settings.output = LAM_OUTPUT_DEPTH;
    distances.settings.occlusion = LAM_OCCLUSION_OFF;
    distances.translucent = distances.masked = distances.environment_lights = distances.settings.shadows = false;
    distances.transmits = false;
    size_t stride = (size_t)distances.width * 4 * sizeof(float);
    if (!buffer_reserve(pixels, stride * (size_t)distances.height, f->call, error))
        return false;
    *image = (lam_image){.width = distances.width,
                         .height = distances.height,
                         .format = LAM_RGBA32F,
                         .stride = stride,
                         .pixels = pixels->data};
    struct gl_frame g = {.device = f->device,
                         .gl = f->gl,
                         .frame = &distances,
                         .call = f->call,
                         .image = image,
                         .stage = LAM_STAGE_FRAGMENT,
                         .layered = layers > 0,
                         .surface_layers = layers,
                         .only_opaque = true};
    return draw_frame(&g, error);
}

// Computes the ambient occlusion from the distances of the frame's opaque surfaces.
static bool draw_occlusion(struct gl_frame *f, struct screen_occlusion *occlusion, lam_error *error)
{
    struct buffer pixels[2] = {0};
    lam_image distances, layers;
    bool ok = draw_distances(f, 0, &distances, &pixels[0], error) &&
              draw_distances(f, SCREEN_LAYERS, &layers, &pixels[1], error) &&
              occlusion_find(f, &distances, &layers, occlusion, error);
    buffer_release(&pixels[0], f->call);
    buffer_release(&pixels[1], f->call);
    f->occlusion = occlusion;
    return ok;
}

static bool gl_draw(struct lam_device *base, const struct frame *frame, lam_image *image, struct call_control *call,
                    lam_error *error)
{
    struct gl_device *device = (struct gl_device *)base;
    struct gl_previous_context previous;
    struct gl_saved_state state;
    if (frame->settings.reference)
        return fail(
            error, LAM_UNSUPPORTED,
            "OpenGL: reference is %d, but this device supports only the split sum; the CPU device sums directions",
            frame->settings.reference);
    if (frame->settings.bounces)
        return fail(error, LAM_UNSUPPORTED,
                    "OpenGL: bounces is %d, but this device supports only local lighting; the CPU device traces paths",
                    frame->settings.bounces);
    if (frame->refracts)
        return fail(
            error, LAM_UNSUPPORTED,
            "OpenGL: the scene contains rough or thick glass (transmission with a roughness or a thickness above 0), "
            "which only the CPU device draws");
    if (frame->settings.occlusion == LAM_OCCLUSION_RAYS)
        return fail(
            error, LAM_UNSUPPORTED,
            "OpenGL: ambient occlusion is 'rays', but this device supports only 'screen'; the CPU device traces rays");
    if (!gl_context_enter(&device->context, &previous, error))
        return false;
    struct gl_frame f = {.device = device, .gl = &device->context.gl, .frame = frame, .call = call, .image = image};
    f.stage = frame->settings.stage;
    for (int i = 0; i < frame->range_count && frame->translucent && !output_is_value(frame->settings.output); i++)
        f.layered |= range_blends(frame, &frame->ranges[i]);
    gl_state_save(device, &state);
    device->frame_number++;
    struct screen_occlusion occlusion;
    bool ok = frame->settings.occlusion == LAM_OCCLUSION_OFF || draw_occlusion(&f, &occlusion, error);
    ok = ok && draw_frame(&f, error);
    gl_state_restore(device, &state);
    gl_context_leave(&device->context, &previous);
    return ok;
}

static uint64_t gl_memory(const struct lam_device *base)
{
    const struct gl_device *device = (const struct gl_device *)base;
    uint64_t bytes = device->scratch.capacity + device->runs.capacity + device->pixels.capacity +
                     device->draw_calls.capacity + device->environment_bytes + device->target_bytes +
                     device->shadow_bytes + surfaces_bytes(device) + device->occlusion.capacity +
                     device->occlusion_rows.capacity + hierarchy_bytes(&device->hierarchy) +
                     vertex_colors_bytes(&device->vertex_colors);
    const struct gl_light_buffer *lists[] = {&device->lights, &device->products};
    for (int i = 0; i < 2; i++)
        bytes += lists[i]->next.capacity + lists[i]->size;
    for (int i = 0; i < device->mesh_count; i++)
        bytes += device->meshes[i].bytes;
    for (int i = 0; i < device->texture_count; i++)
        bytes += device->textures[i].bytes;
    for (int i = 0; i < device->vertex_lighting_capacity; i++)
        bytes += device->vertex_lighting[i].bytes;
    return bytes;
}

static void APIENTRY keep_names(GLsizei count, const GLuint *names) { (void)count, (void)names; }
static void APIENTRY keep_program(GLuint name) { (void)name; }

// Disables the deletion of OpenGL objects, for a context that cannot be made current. The objects are deleted together
// with the context.
static void keep_objects(struct gl *gl)
{
    gl->DeleteBuffers = keep_names;
    gl->DeleteFramebuffers = keep_names;
    gl->DeleteQueries = keep_names;
    gl->DeleteSamplers = keep_names;
    gl->DeleteTextures = keep_names;
    gl->DeleteVertexArrays = keep_names;
    gl->DeleteProgram = keep_program;
}

static void gl_free(struct lam_device *base)
{
    struct gl_device *device = (struct gl_device *)base;
    struct gl_previous_context previous;
    bool entered = gl_context_enter(&device->context, &previous, NULL);
    if (!entered)
        keep_objects(&device->context.gl);
    meshes_free(device);
    textures_free(device);
    vertex_lighting_free(device);
    programs_free(device);
    light_buffers_free(device);
    shadows_free(device);
    targets_free(device);
    if (device->occlusion_texture)
        device->context.gl.DeleteTextures(1, &device->occlusion_texture);
    if (device->query)
        device->context.gl.DeleteQueries(1, &device->query);
    if (entered)
        gl_context_leave(&device->context, &previous);
    gl_context_free(&device->context);
    buffer_free(&device->scratch);
    surfaces_free(device);
    buffer_free(&device->occlusion);
    buffer_free(&device->occlusion_rows);
    buffer_free(&device->runs);
    buffer_free(&device->pixels);
    buffer_free(&device->draw_calls);
    free(device);
}

// --- creation

static bool find_limits(struct gl_device *device, lam_error *error)
{
    const struct gl *gl = &device->context.gl;
    const struct gl_context *c = &device->context;
    if (c->major * 10 + c->minor < (c->es ? 30 : 33))
        return fail(error, LAM_UNSUPPORTED,
                    "OpenGL: the context has version %s%d.%d, expected OpenGL 3.3 or OpenGL ES 3.0", c->es ? "ES " : "",
                    c->major, c->minor);
    gl->GetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &device->block_size_max);
    gl->GetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &device->block_alignment);
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &device->texture_size_max);
    gl->GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &device->unit_count);
    device->unit_count = device->unit_count < UNIT_COUNT ? device->unit_count : UNIT_COUNT;
    GLint view[2];
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, view);
    for (int i = 0; i < 2; i++)
        device->texture_size_max = view[i] < device->texture_size_max ? view[i] : device->texture_size_max;
    if (device->block_alignment < 16)
        device->block_alignment = 16;
    device->has_norm16 = !c->es || gl_has_extension(gl, "GL_EXT_texture_norm16");
    device->anisotropy_max = 1;
    if (gl_has_extension(gl, "GL_EXT_texture_filter_anisotropic") ||
        gl_has_extension(gl, "GL_ARB_texture_filter_anisotropic"))
        gl->GetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &device->anisotropy_max);
    gl->GenQueries(1, &device->query);
    return targets_find_format(device, error) && program_copy_make(device, error) &&
           (!c->debug || gl_messages_clean(c, "starting", error));
}

lam_device *lam_device_gl(const lam_gl_params *params, lam_error *error)
{
    static const struct device_type type = {.draw = gl_draw, .memory = gl_memory, .free = gl_free};
    static const lam_gl_params plain = {0};
    params = params ? params : &plain;
    if (!check_reserved("lam_gl_params", params, error))
        return NULL;
    if ((unsigned)params->api > LAM_GL_ES)
        return fail(error, LAM_BAD_ARGUMENT, "OpenGL: api is %d, expected LAM_GL_CORE or LAM_GL_ES", params->api), NULL;
    int mistake = mistake_find(params->mistake);
    if (params->mistake && (!params->lecture || !mistake)) {
        fail(error, LAM_BAD_ARGUMENT, "OpenGL: mistake '%.60s': %s", params->mistake,
             mistake ? "mistakes require the lecture style" : "no such mistake");
        return NULL;
    }
    struct gl_device *device = calloc(1, sizeof *device);
    if (!device)
        return fail_memory(error, sizeof *device), NULL;
    device->base.type = &type;
    device->external_context = params->get_proc_address != NULL;
    device->style = params->lecture ? &lecture_style : NULL;
    device->hardware_filter = params->hardware_filter;
    device->mistake = mistake;
    for (int i = 0; i < 256; i++)
        device->decode_srgb[i] = (float)srgb_linear(i / 255.0);
    gl_state_invalidate(device);
    bool ok = device->external_context
                  ? gl_context_adopt(&device->context, params->get_proc_address, params->user, params->debug, error)
                  : gl_context_make(&device->context, params->library, params->device,
                                    params->api == LAM_GL_ES ? GL_PROFILE_ES : GL_PROFILE_CORE, params->debug, error);
    struct gl_previous_context previous;
    if (!ok || !gl_context_enter(&device->context, &previous, error)) {
        gl_context_free(&device->context);
        free(device);
        return NULL;
    }
    struct gl_saved_state state;
    gl_state_save(device, &state);
    ok = find_limits(device, error);
    gl_state_restore(device, &state);
    gl_context_leave(&device->context, &previous);
    if (!ok) {
        gl_free(&device->base);
        return NULL;
    }
    snprintf(device->base.name, sizeof device->base.name, "gl %.60s, OpenGL %s%d.%d", device->context.renderer,
             device->context.es ? "ES " : "", device->context.major, device->context.minor);
    return &device->base;
}
