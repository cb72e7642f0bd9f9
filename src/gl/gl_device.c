// gl_device.c: the OpenGL device: what it holds, and a frame from its first call to its last.
#include "gl_device.h"

#include "cube_map.h"
#include "fail.h"
#include "srgb.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- a frame

static bool shows_place(lam_output show)
{
    return show == LAM_OUTPUT_DEPTH || show == LAM_OUTPUT_FACING || show == LAM_OUTPUT_IDS ||
           show == LAM_OUTPUT_COVERAGE || show == LAM_OUTPUT_OVERDRAW;
}

// What the frame asks for, without what its programs do not look at: so that one program serves all that look
// alike. Field by field into zeroed memory: the whole is compared as bytes.
static void choices_of(const struct gl_frame *f, const struct frame_draw_range *surface, struct glsl_choices *c)
{
    struct glsl_choices asked = glsl_choose(f->frame, surface, f->stage);
    memset(c, 0, sizeof *c);
    c->version = f->device->context.es ? GLSL_300_ES : GLSL_330;
    c->storage = f->storage;
    c->output = GLSL_PREMULTIPLIED;
    c->layer = !f->layered ? GLSL_NO_LAYERS : surface->translucent ? GLSL_PEELS : GLSL_WRITES_PLACES;
    c->products = true;
    c->two_sided = asked.two_sided;
    c->show = asked.show;
    c->stage = asked.stage;
    c->shading = asked.shading;
    c->reflection = LAM_REFLECTION_LAMBERT;
    if (shows_place(c->show)) {
        c->shading = LAM_SHADING_PHONG;
        c->stage = LAM_STAGE_FRAGMENT;
        return;
    }
    if (c->stage == LAM_STAGE_APPLICATION) {
        c->show = LAM_OUTPUT_PICTURE;
        return;
    }
    c->reflection = asked.reflection;
    c->environment = asked.environment;
    c->distant_viewer = asked.distant_viewer;
    c->gl1 = asked.gl1;
    c->back_material = asked.back_material;
    c->colors = asked.colors;
    c->tangents = asked.tangents;
    memcpy(c->groups, asked.groups, sizeof c->groups);
    c->group_count = asked.group_count;
    c->light_count = asked.light_count;
    c->hemisphere_count = asked.hemisphere_count;
}

static enum vertex_form form_of(const struct gl_frame *f, const struct frame_draw *draw, int draw_surfaces)
{
    const struct frame *frame = f->frame;
    if (frame->shading == LAM_SHADING_FLAT && !shows_place(frame->show))
        return frame->flat_normal == LAM_FLAT_NORMAL_VERTEX && draw->mesh->normals ? FORM_FLAT_VERTEX : FORM_FLAT_FACE;
    // Triangles are numbered by their corners; a vertex of two materials has two colours.
    bool counts = f->layered || frame->show == LAM_OUTPUT_IDS;
    bool two = f->stage == LAM_STAGE_APPLICATION && draw_surfaces > 1;
    return counts || two || !mesh_can_share(draw->mesh) ? FORM_CORNERS : FORM_SHARED;
}

static bool lists_are_read(const struct glsl_choices *c)
{
    return c->stage != LAM_STAGE_APPLICATION && !shows_place(c->show);
}

static bool same_call(const struct frame_draw_range *a, const struct frame_draw_range *b)
{
    return a->front == b->front && a->back == b->back && a->translucent == b->translucent;
}

// The draw calls of one draw, one for all of its surfaces that have the same materials: added to f->surfaces. Returns
// the number of runs where these do not lie side by side, in device->runs; 0: they do. −1: the error tells.
static int add_calls(struct gl_frame *f, const struct frame_draw_range *list, int count, lam_error *error)
{
    const struct frame_draw *draw = &f->frame->draws[list->draw];
    if (!buffer_reserve(&f->device->runs, (size_t)count * sizeof(struct mesh_run), f->call, error))
        return -1;
    struct mesh_run *runs = f->device->runs.data;
    struct gl_surface *calls = f->surfaces + f->surface_count;
    int call_count = 0;
    for (int i = 0; i < count; i++) {
        int c = 0;
        while (c < call_count && !same_call(calls[c].surface, &list[i]))
            c++;
        runs[i] = (struct mesh_run){list[i].first_id - draw->first_id, list[i].count, c};
        if (c == call_count)
            calls[call_count++] = (struct gl_surface){.surface = &list[i], .draw = draw};
        calls[c].count += 3 * list[i].count;
    }
    for (int c = 1; c < call_count; c++)
        calls[c].first = calls[c - 1].first + calls[c - 1].count;
    f->surface_count += call_count;
    return call_count < count ? count : 0;
}

// The buffers of one draw's calls.
static bool set_up_draw(struct gl_frame *f, const struct frame_draw_range *list, int count, lam_error *error)
{
    const struct frame *frame = f->frame;
    int first = f->surface_count, runs = add_calls(f, list, count, error);
    if (runs < 0)
        return false;
    const struct frame_draw *draw = &frame->draws[list->draw];
    struct gl_mesh *mesh =
        mesh_on_device(f, draw->mesh, form_of(f, draw, f->surface_count - first), f->device->runs.data, runs, error);
    if (!mesh)
        return false;
    bool colors = f->stage == LAM_STAGE_APPLICATION && !shows_place(frame->show);
    GLuint array = colors ? colors_on_device(f, list->draw, mesh, error) : mesh->array;
    if (!array)
        return false;
    for (int i = first; i < f->surface_count; i++) {
        struct gl_surface *s = &f->surfaces[i];
        struct glsl_choices c;
        choices_of(f, s->surface, &c);
        s->lit = lists_are_read(&c);
        s->array = array;
        s->by_elements = mesh->elements != 0;
        s->program = program_for(f, &c, error); // compiled already
        if (!s->program || (c.environment != GLSL_NO_ENVIRONMENT && !environment_send(f, error)))
            return false;
    }
    return true;
}

// Everything that may have to be made or sent, before the first draw call.
static bool set_up(struct gl_frame *f, lam_error *error)
{
    const struct frame *frame = f->frame;
    if (!frame->surface_count)
        return true;
    struct glsl_choices any;
    choices_of(f, &frame->surfaces[0], &any);
    f->storage = lists_storage(f->device, &any);
    any.storage = f->storage;
    if (lists_are_read(&any) && !lists_send(f, &any, error))
        return false;
    for (int i = 0; i < frame->surface_count; i++) { // compiled first: the list of programs may move
        struct glsl_choices c;
        choices_of(f, &frame->surfaces[i], &c);
        if (!program_for(f, &c, error) || !(call_should_continue(f->call) || call_error(f->call, error)))
            return false;
    }
    for (int first = 0, end; first < frame->surface_count; first = end) {
        for (end = first; end < frame->surface_count && frame->surfaces[end].draw == frame->surfaces[first].draw;)
            end++;
        if (!set_up_draw(f, &frame->surfaces[first], end - first, error))
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
        return fail(error, LAM_LIMIT, "OpenGL: the memory of '%s' is out", f->device->context.renderer);
    if (code != GL_NO_ERROR)
        return fail(error, LAM_UNSUPPORTED, "OpenGL: the driver of '%s' reports error 0x%x",
                    f->device->context.renderer, code);
    return !f->device->context.debug || gl_messages_clean(&f->device->context, "drawing", error);
}

// The picture in parts that the driver's targets have room for.
static bool draw_parts(struct gl_frame *f, lam_error *error)
{
    lam_frame_report *report = &f->device->base.report;
    int most = f->device->texture_most < PART_MOST ? f->device->texture_most : PART_MOST;
    int width = f->image->width < most ? f->image->width : most,
        height = f->image->height < most ? f->image->height : most;
    if (!targets_make(f, width, height, f->layered, error))
        return false;
    for (f->top = 0; f->top < f->image->height; f->top += most)
        for (f->left = 0; f->left < f->image->width; f->left += most) {
            f->width = f->image->width - f->left < most ? f->image->width - f->left : most;
            f->height = f->image->height - f->top < most ? f->image->height - f->top : most;
            uint64_t clock = now_ns();
            if (!passes_draw(f, error))
                return false;
            f->gl->Finish();
            report->draw_ms += since(&clock);
            if (!check_errors(f, error) || !reading_part(f, error))
                return false;
            report->read_ms += since(&clock);
        }
    return true;
}

static bool draw_frame(struct gl_frame *f, lam_error *error)
{
    struct gl_device *device = f->device;
    uint64_t clock = now_ns();
    while (f->gl->GetError() != GL_NO_ERROR) // of calls before ours
        ;
    if (device->callers)
        gl_forget(device);
    if (!buffer_reserve(&device->surfaces, (size_t)(f->frame->surface_count + 1) * sizeof *f->surfaces, f->call, error))
        return false;
    f->surfaces = device->surfaces.data;
    meshes_drop(f);
    if (!set_up(f, error))
        return false;
    device->base.report.upload_ms = since(&clock) - device->base.report.lighting_ms;
    return draw_parts(f, error) && check_errors(f, error);
}

static bool gl_draw(struct lam_device *base, const struct frame *frame, lam_image *image, struct call_control *call,
                    lam_error *error)
{
    struct gl_device *device = (struct gl_device *)base;
    struct gl_previous previous;
    struct gl_saved_state state;
    if (!gl_context_enter(&device->context, &previous, error))
        return false;
    struct gl_frame f = {.device = device, .gl = &device->context.gl, .frame = frame, .call = call, .image = image};
    f.stage = frame->stage;
    f.layered = frame->translucent && frame->show != LAM_OUTPUT_COVERAGE;
    caller_save(device, &state);
    device->frame_number++;
    bool ok = draw_frame(&f, error);
    caller_restore(device, &state);
    gl_context_leave(&device->context, &previous);
    return ok;
}

static uint64_t gl_memory(const struct lam_device *base)
{
    const struct gl_device *device = (const struct gl_device *)base;
    uint64_t bytes = device->scratch.capacity + device->runs.capacity + device->pixels.capacity +
                     device->surfaces.capacity + device->environment_bytes + device->target_bytes;
    const struct gl_list *lists[] = {&device->lights, &device->products};
    for (int i = 0; i < 2; i++)
        bytes += lists[i]->shadow.capacity + lists[i]->next.capacity + lists[i]->size;
    for (int i = 0; i < device->mesh_count; i++)
        bytes += device->meshes[i].bytes;
    for (int i = 0; i < device->color_room; i++)
        bytes += device->colors[i].bytes + device->colors[i].made_of.capacity + device->colors[i].now.capacity;
    return bytes;
}

static void gl_free(struct lam_device *base)
{
    struct gl_device *device = (struct gl_device *)base;
    struct gl_previous previous;
    if (gl_context_enter(&device->context, &previous, NULL)) {
        meshes_free(device);
        colors_free(device);
        programs_free(device);
        lists_free(device);
        targets_free(device);
        if (device->query)
            device->context.gl.DeleteQueries(1, &device->query);
        gl_context_leave(&device->context, &previous);
    }
    gl_context_free(&device->context);
    buffer_free(&device->scratch);
    buffer_free(&device->runs);
    buffer_free(&device->pixels);
    buffer_free(&device->surfaces);
    free(device);
}

// --- making one

static bool find_limits(struct gl_device *device, lam_error *error)
{
    const struct gl *gl = &device->context.gl;
    const struct gl_context *c = &device->context;
    if (c->major * 10 + c->minor < (c->es ? 30 : 33))
        return fail(error, LAM_UNSUPPORTED,
                    "OpenGL: the context has version %s%d.%d, expected OpenGL 3.3 or OpenGL ES 3.0", c->es ? "ES " : "",
                    c->major, c->minor);
    gl->GetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &device->block_most);
    gl->GetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &device->block_alignment);
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &device->texture_most);
    GLint view[2];
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, view);
    for (int i = 0; i < 2; i++)
        device->texture_most = view[i] < device->texture_most ? view[i] : device->texture_most;
    if (device->block_alignment < 16)
        device->block_alignment = 16;
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
    if ((unsigned)params->api > LAM_GL_ES) {
        fail(error, LAM_BAD_ARGUMENT, "OpenGL: api is %d, which does not exist", params->api);
        return NULL;
    }
    struct gl_device *device = calloc(1, sizeof *device);
    if (!device) {
        fail_memory(error, sizeof *device);
        return NULL;
    }
    device->base.type = &type;
    device->callers = params->get_proc_address != NULL;
    for (int i = 0; i < 256; i++)
        device->decode_srgb[i] = (float)srgb_linear(i / 255.0);
    gl_forget(device);
    bool ok = device->callers
                  ? gl_context_adopt(&device->context, params->get_proc_address, params->user, params->debug, error)
                  : gl_context_make(&device->context, params->library, params->device,
                                    params->api == LAM_GL_ES ? GL_PROFILE_ES : GL_PROFILE_CORE, params->debug, error);
    struct gl_previous previous;
    if (!ok || !gl_context_enter(&device->context, &previous, error)) {
        gl_context_free(&device->context);
        free(device);
        return NULL;
    }
    struct gl_saved_state state;
    caller_save(device, &state);
    ok = find_limits(device, error);
    caller_restore(device, &state);
    gl_context_leave(&device->context, &previous);
    if (!ok) {
        gl_free(&device->base);
        return NULL;
    }
    snprintf(device->base.name, sizeof device->base.name, "gl %.60s, OpenGL %s%d.%d", device->context.renderer,
             device->context.es ? "ES " : "", device->context.major, device->context.minor);
    return &device->base;
}
