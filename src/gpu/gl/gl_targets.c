// gl_targets.c: the framebuffers for a part of the picture, and the way back into the image. The framebuffers store
// linear light as floats; reading back composites it over the background and encodes it with the code of the CPU device.
#include "gl_device.h"

#include "encode_values.h"
#include "fail.h"
#include "pixels.h"

#define LANES 8
#include "picture_pixels.h"

static GLuint make_texture(struct gl_frame *f, GLenum format, int width, int height, GLenum layout, GLenum type)
{
    const struct gl *gl = f->gl;
    GLuint name = 0;
    gl_edit_plain_texture(f->device, UNIT_COPY, GL_TEXTURE_2D, &name);
    gl->TexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0, layout, type, NULL);
    return name;
}

static void free_target(struct gl_device *device, struct gl_target *t)
{
    const struct gl *gl = &device->context.gl;
    const GLuint textures[] = {t->color, t->depth_id, t->depth, t->through};
    gl->DeleteTextures(4, textures); // OpenGL ignores 0
    gl->DeleteFramebuffers(1, &t->framebuffer);
    *t = (struct gl_target){0};
}

// Makes a target with a colour texture, and if requested, with textures for depth ids and for depths.
static bool make_target(struct gl_frame *f, struct gl_target *t, int width, int height, bool depth_id, bool depth,
                        bool through, lam_error *error)
{
    const struct gl *gl = f->gl;
    gl->GenFramebuffers(1, &t->framebuffer);
    gl_use_framebuffer(f->device, t->framebuffer);
    t->color = make_texture(f, f->device->float_format, width, height, GL_RGBA, GL_FLOAT);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t->color, 0);
    if (depth_id) {
        static const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        t->depth_id = make_texture(f, GL_RG32UI, width, height, GL_RG_INTEGER, GL_UNSIGNED_INT);
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, t->depth_id, 0);
        gl->DrawBuffers(2, both);
    }
    if (through) {
        static const GLenum three[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
        t->through = make_texture(f, f->device->float_format, width, height, GL_RGBA, GL_FLOAT);
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT2, GL_TEXTURE_2D, t->through, 0);
        gl->DrawBuffers(3, three);
    }
    if (depth) {
        t->depth = make_texture(f, GL_DEPTH_COMPONENT32F, width, height, GL_DEPTH_COMPONENT, GL_FLOAT);
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, t->depth, 0);
    }
    GLenum status = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE)
        return true;
    return fail(error, LAM_UNSUPPORTED, "OpenGL: the driver cannot draw into float textures (framebuffer status 0x%x)",
                status);
}

// Returns whether the driver can draw into a target of the format. Blending support depends on extensions.
static bool can_draw(struct gl_device *device, GLenum format)
{
    struct gl_frame f = {.device = device, .gl = &device->context.gl};
    struct gl_target t = {0};
    device->float_format = format;
    lam_error unused;
    bool can = make_target(&f, &t, 4, 4, false, true, false, &unused);
    free_target(device, &t);
    return can;
}

bool targets_find_format(struct gl_device *device, lam_error *error)
{
    const struct gl *gl = &device->context.gl;
    bool floats = !device->context.es ||
                  (gl_has_extension(gl, "GL_EXT_color_buffer_float") && gl_has_extension(gl, "GL_EXT_float_blend"));
    bool halves = floats || gl_has_extension(gl, "GL_EXT_color_buffer_float") ||
                  gl_has_extension(gl, "GL_EXT_color_buffer_half_float");
    if ((floats && can_draw(device, GL_RGBA32F)) || (halves && can_draw(device, GL_RGBA16F)))
        return true;
    return fail(error, LAM_UNSUPPORTED,
                "OpenGL: the driver of '%s' cannot draw into float textures, expected GL_EXT_color_buffer_float",
                device->context.renderer);
}

bool targets_make(struct gl_frame *f, int width, int height, bool has_layers, bool tinted, lam_error *error)
{
    struct gl_device *device = f->device;
    struct gl_targets *t = &device->targets;
    if (t->sample.framebuffer && width <= t->width && height <= t->height && (t->layered || !has_layers) &&
        (t->tinted || !tinted))
        return true;
    width = width > t->width ? width : t->width;
    height = height > t->height ? height : t->height;
    has_layers |= t->layered;
    tinted |= t->tinted;
    targets_free(device);
    uint64_t pixels = (uint64_t)width * (uint64_t)height;
    if (!gl_charge(f, &device->target_bytes,
                   pixels * ((has_layers ? 3 * 28 + 2 * 16 : 20 + 16) + (tinted ? 3 * 16 : 0)), error))
        return false;
    t->layered = has_layers;
    t->tinted = tinted;
    bool ok = make_target(f, &t->sample, width, height, has_layers, true, false, error) &&
              make_target(f, &t->picture, width, height, false, false, false, error);
    if (ok && has_layers)
        ok = make_target(f, &t->layers[0], width, height, true, true, tinted, error) &&
             make_target(f, &t->layers[1], width, height, true, true, tinted, error) &&
             make_target(f, &t->sum, width, height, false, false, false, error);
    if (ok && tinted)
        ok = make_target(f, &t->tint, width, height, false, false, false, error);
    if (!ok) {
        targets_free(device);
        return false;
    }
    t->width = width;
    t->height = height;
    return true;
}

void targets_free(struct gl_device *device)
{
    struct gl_targets *t = &device->targets;
    struct gl_target *all[] = {&t->sample, &t->layers[0], &t->layers[1], &t->sum, &t->picture, &t->tint};
    for (int i = 0; i < 6; i++)
        if (all[i]->framebuffer)
            free_target(device, all[i]);
    *t = (struct gl_targets){0};
    gl_state_invalidate(device);
}

// --- reading back

// Encodes premultiplied RGBA pixels of a row in a working format, and stores them in `to`.
static void store_light(const struct gl_frame *f, const float *from, int count, lam_pixel_format format, char *to)
{
    size_t size = pixel_bytes(format);
    for (int x = 0; x < count; x += LANES) {
        int batch = count - x < LANES ? count - x : LANES;
        float lanes[4][LANES] = {{0}};
        for (int i = 0; i < batch; i++)
            for (int c = 0; c < 4; c++)
                lanes[c][i] = from[4 * (x + i) + c];
        struct pixel_lanes p = {num_load(lanes[0]), num_load(lanes[1]), num_load(lanes[2]),
                                min_of(num_load(lanes[3]), num_of(1.0f))}; // rounding may have raised a sum above 1
        write_pixels(f->frame, p, format, to + (size_t)x * size, batch);
    }
}

static void store_clipped(const struct gl_frame *f, const float *from, lam_pixel_format format, void *to)
{
    float p[4];
    num a = num_of(from[3] < 1 ? from[3] : 1);
    struct pixel_lanes one = {num_of(from[0]), num_of(from[1]), num_of(from[2]), a};
    write_pixels(f->frame, one, LAM_RGBA32F, p, 1);
    encode_clipped(format, p, to);
}

static void store_value(const struct gl_frame *f, const float *from, lam_pixel_format format, void *to)
{
    lam_output output = f->frame->settings.output;
    if (output_kind(output) == OUTPUT_COUNT) {
        float share = output == LAM_OUTPUT_COVERAGE ? from[3] : from[0];
        encode_values(f->frame, format, (float[4]){share, share, share, 1}, to);
        return;
    }
    if (from[3] > 0)
        encode_values(f->frame, format, (float[4]){from[0], from[1], from[2], 1}, to);
    else
        encode_empty(f->frame, format, to);
}

bool readback_part(struct gl_frame *f, lam_error *error)
{
    const struct gl *gl = f->gl;
    size_t bytes = (size_t)f->width * (size_t)f->height * 4 * sizeof(float);
    if (!buffer_reserve(&f->device->pixels, bytes, f->call, error))
        return false;
    gl->ReadPixels(0, 0, f->width, f->height, GL_RGBA, GL_FLOAT, f->device->pixels.data);
    lam_pixel_format format = f->image->format, working = working_format(format);
    size_t size = pixel_bytes(working);
    char converted[PART_SIZE_MAX * 16]; // a row in the working format
    lam_output output = f->frame->settings.output;
    uint64_t covered = 0;
    for (int y = 0; y < f->height; y++) {
        const float *from = (const float *)f->device->pixels.data + (size_t)y * (size_t)f->width * 4;
        char *row = (char *)image_row(f->image, f->top + y) + (size_t)f->left * pixel_bytes(format);
        char *to = format == working ? row : converted;
        for (int x = 0; x < f->width; x++)
            covered += from[4 * x + 3] > 0;
        if (lam_output_is_light(output))
            store_light(f, from, f->width, working, to);
        else
            for (int x = 0; x < f->width; x++, from += 4)
                if (output == LAM_OUTPUT_CLIPPED)
                    store_clipped(f, from, working, to + (size_t)x * size);
                else
                    store_value(f, from, working, to + (size_t)x * size);
        if (format != working)
            pixels_from_working(format, values_are_raw(f->frame), converted, f->width, row);
    }
    f->device->base.report.pixels_covered += covered;
    return call_should_continue(f->call) || call_error(f->call, error);
}
