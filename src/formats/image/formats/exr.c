// exr.c: reads and writes OpenEXR files, which store floats in named layers. This file uses the C library OpenEXRCore,
// which is loaded on demand (dlopen). Written files contain one part of scanlines, with 32-bit floats and ZIP
// compression. The picture's channels are R, G, B and A, linear and premultiplied, as OpenEXR defines them. The
// channels of a layer are NAME.R and so on. Neither a time nor a path is stored, so the bytes depend only on the
// picture and on the version of the library.
#include "codec.h"
#include "dynamic_library.h"
#include "fail.h"
#include "remedy.h"
#include "pixels.h"
#include "shown_name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CHANNELS = 1024, NAME_BYTES = 256 };

static bool exr_probe(const uint8_t *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "\x76\x2f\x31\x01", 4) == 0;
}

#ifdef HAVE_OPENEXR

#include <openexr.h>

#define LIBRARY "libOpenEXRCore-3_1.so.30"

// The functions of OpenEXRCore that Lambent uses. Each function becomes a member of struct core, with the type of its
// declaration.
#define FUNCTIONS(each)                                                                                                \
    each(exr_start_write) each(exr_add_part) each(exr_initialize_required_attr_simple) each(exr_add_channel)           \
        each(exr_attr_set_string) each(exr_write_header) each(exr_get_scanlines_per_chunk)                             \
            each(exr_write_scanline_chunk_info) each(exr_encoding_initialize)                                          \
                each(exr_encoding_choose_default_routines) each(exr_encoding_update) each(exr_encoding_run)            \
                    each(exr_encoding_destroy) each(exr_finish) each(exr_get_default_error_message)                    \
                        each(exr_start_read) each(exr_get_storage) each(exr_get_data_window) each(exr_get_channels)    \
                            each(exr_read_scanline_chunk_info) each(exr_decoding_initialize)                           \
                                each(exr_decoding_choose_default_routines) each(exr_decoding_update)                   \
                                    each(exr_decoding_run) each(exr_decoding_destroy)

struct core {
    void *handle;
    FUNCTIONS(LIBRARY_MEMBER)
};

static bool open_core(struct core *core, lam_error *error)
{
    const char *fault = library_open_functions(&core->handle, LIBRARY, false, LIBRARY_NAMES(FUNCTIONS),
                                               "lacks functions of OpenEXR 3.1");
    return !fault ||
           fail(error, LAM_UNSUPPORTED, "EXR: " LIBRARY " %s; install the Debian package libopenexr-3-1-30", fault);
}

// Replaces the error handler of OpenEXRCore, which would print to standard error.
static void stay_silent(exr_const_context_t context, exr_result_t code, const char *text)
{
    (void)context, (void)code, (void)text;
}

// --- writing, into memory

struct sink {
    uint8_t *bytes;
    size_t size, capacity;
    bool full; // memory ran out
};

static int64_t write_sink(exr_const_context_t context, void *user, const void *from, uint64_t size, uint64_t offset,
                          exr_stream_error_func_ptr_t error)
{
    (void)context, (void)error;
    struct sink *sink = user;
    uint64_t end;
    if (__builtin_add_overflow(offset, size, &end) || end > SIZE_MAX / 2)
        return -1;
    if (end > sink->capacity) {
        size_t capacity = (size_t)end > 2 * sink->capacity ? (size_t)end : 2 * sink->capacity;
        uint8_t *larger = realloc(sink->bytes, capacity);
        sink->full = !larger;
        if (!larger)
            return -1;
        sink->bytes = larger;
        sink->capacity = capacity;
    }
    if (offset > sink->size)
        memset(sink->bytes + sink->size, 0, (size_t)offset - sink->size);
    memcpy(sink->bytes + offset, from, (size_t)size);
    sink->size = end > sink->size ? (size_t)end : sink->size;
    return (int64_t)size;
}

// A channel of the file: its name, and the address of its first float.
struct channel {
    char name[NAME_BYTES];
    const float *from;
};

static const char *letters_of(const lam_layer *layer)
{
    bool named = layer->name && *layer->name;
    return layer->channels ? layer->channels : named ? "RGB" : "RGBA";
}

// Lists the channels of all layers. Returns NULL and frees everything on error.
static struct channel *list_channels(const lam_layer *layers, int count, int *channel_count, lam_error *error)
{
    struct channel *channels = calloc(4 * (size_t)count, sizeof *channels);
    if (!channels)
        return fail_memory(error, 4 * (size_t)count * sizeof *channels), NULL;
    int used = 0;
    bool ok = true;
    for (int i = 0; ok && i < count; i++) {
        const char *letters = letters_of(&layers[i]), *name = layers[i].name ? layers[i].name : "";
        size_t length = strlen(name), letter_count = strlen(letters);
        if (letter_count < 1 || letter_count > 4)
            ok = fail(error, LAM_BAD_ARGUMENT, "layer '%.100s': channels are '%.20s', expected one to four letters",
                      name, letters);
        else if (length > NAME_BYTES - 3)
            ok = fail(error, LAM_BAD_ARGUMENT, "layer '%.100s…': the name has %zu bytes, expected at most %d", name,
                      length, NAME_BYTES - 3);
        for (size_t k = 0; ok && k < letter_count; k++) {
            struct channel *c = &channels[used++];
            memcpy(c->name, name, length);
            c->name[length] = '.';
            size_t at = length ? length + 1 : 0;
            c->name[at] = letters[k];
            c->name[at + 1] = 0;
            c->from = (const float *)layers[i].image->pixels + k;
            for (int before = 0; ok && before < used - 1; before++)
                if (strcmp(channels[before].name, c->name) == 0)
                    ok = fail(error, LAM_BAD_ARGUMENT, "layers: two have a channel '%.100s'", c->name);
        }
    }
    if (ok && used > MAX_CHANNELS)
        ok = fail(error, LAM_LIMIT, "layers: %d channels, expected at most %d", used, MAX_CHANNELS);
    *channel_count = used;
    if (ok)
        return channels;
    free(channels);
    return NULL;
}

static const float *channel_named(const struct channel *channels, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(channels[i].name, name) == 0)
            return channels[i].from;
    return NULL;
}

static exr_result_t write_chunks(const struct core *core, exr_context_t file, int part, const struct channel *channels,
                                 int count, int width, int height)
{
    int32_t rows = 1;
    exr_result_t result = core->exr_get_scanlines_per_chunk(file, part, &rows);
    exr_encode_pipeline_t pipe = EXR_ENCODE_PIPELINE_INITIALIZER;
    for (int y = 0; result == EXR_ERR_SUCCESS && y < height; y += rows) {
        exr_chunk_info_t chunk;
        result = core->exr_write_scanline_chunk_info(file, part, y, &chunk);
        if (result == EXR_ERR_SUCCESS)
            result = y == 0 ? core->exr_encoding_initialize(file, part, &chunk, &pipe)
                            : core->exr_encoding_update(file, part, &chunk, &pipe);
        for (int i = 0; result == EXR_ERR_SUCCESS && i < pipe.channel_count; i++) {
            exr_coding_channel_info_t *c = &pipe.channels[i];
            const float *from = channel_named(channels, count, c->channel_name);
            if (!from) {
                result = EXR_ERR_INVALID_ARGUMENT;
                break;
            }
            c->user_bytes_per_element = 4;
            c->user_data_type = EXR_PIXEL_FLOAT;
            c->user_pixel_stride = 16;
            c->user_line_stride = 16 * width;
            c->encode_from_ptr = (const uint8_t *)(from + 4 * (size_t)y * (size_t)width);
        }
        if (result == EXR_ERR_SUCCESS && y == 0)
            result = core->exr_encoding_choose_default_routines(file, part, &pipe);
        if (result == EXR_ERR_SUCCESS)
            result = core->exr_encoding_run(file, part, &pipe);
    }
    core->exr_encoding_destroy(file, &pipe);
    return result;
}

static bool write_layers(const lam_layer *layers, int count, lam_bytes *out, lam_error *error)
{
    int width = layers[0].image->width, height = layers[0].image->height, channel_count;
    struct core core;
    struct channel *channels = list_channels(layers, count, &channel_count, error);
    if (!channels)
        return false;
    if (!open_core(&core, error)) {
        free(channels);
        return false;
    }
    struct sink sink = {0};
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = stay_silent;
    start.user_data = &sink;
    start.write_fn = write_sink;
    exr_context_t file = NULL;
    int part = 0;
    exr_result_t result = core.exr_start_write(&file, "picture.exr", EXR_WRITE_FILE_DIRECTLY, &start);
    if (result == EXR_ERR_SUCCESS)
        result = core.exr_add_part(file, "picture", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = core.exr_initialize_required_attr_simple(file, part, width, height, EXR_COMPRESSION_ZIP);
    for (int i = 0; result == EXR_ERR_SUCCESS && i < channel_count; i++)
        result = core.exr_add_channel(file, part, channels[i].name, EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    if (result == EXR_ERR_SUCCESS)
        result = core.exr_attr_set_string(file, part, "software", "lambent");
    if (result == EXR_ERR_SUCCESS)
        result = core.exr_write_header(file);
    if (result == EXR_ERR_SUCCESS)
        result = write_chunks(&core, file, part, channels, channel_count, width, height);
    exr_result_t closed = file ? core.exr_finish(&file) : EXR_ERR_SUCCESS; // also writes the table of chunks
    result = result == EXR_ERR_SUCCESS ? closed : result;
    free(channels);
    bool ok = result == EXR_ERR_SUCCESS;
    // Compression cannot fail for valid data, so an error about a corrupt chunk means that zlib could not allocate
    // memory.
    if (ok)
        *out = (lam_bytes){sink.bytes, sink.size};
    else if (sink.full || result == EXR_ERR_OUT_OF_MEMORY || result == EXR_ERR_CORRUPT_CHUNK)
        fail_memory(error, 16 * (size_t)width * (size_t)height);
    else
        fail(error, LAM_LIMIT, "EXR: the picture could not be encoded: %s", core.exr_get_default_error_message(result));
    if (!ok)
        free(sink.bytes);
    library_close(core.handle);
    return ok;
}

// --- reading, from memory

struct source {
    const uint8_t *bytes;
    size_t size;
};

static int64_t read_source(exr_const_context_t context, void *user, void *to, uint64_t size, uint64_t offset,
                           exr_stream_error_func_ptr_t error)
{
    (void)context, (void)error;
    const struct source *source = user;
    if (offset > source->size)
        return -1;
    size_t got = size < source->size - offset ? (size_t)size : source->size - (size_t)offset;
    memcpy(to, source->bytes + offset, got);
    return (int64_t)got;
}

static int64_t size_of_source(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((const struct source *)user)->size;
}

// Returns the position of the file's channel `name` in a pixel (0 to 3), or −1 if the picture does not use the channel.
// Y is the luminance, which is used for all three colours, like Z, if it is the only channel.
static int place_of(const char *name, bool alone)
{
    static const char letters[] = "RGBA";
    const char *found = name[0] && !name[1] ? strchr(letters, name[0]) : NULL;
    return found ? (int)(found - letters) : strcmp(name, "Y") == 0 || (alone && strcmp(name, "Z") == 0) ? 0 : -1;
}

// Checks that every chunk is present, before memory is allocated for the picture.
static exr_result_t find_chunks(const struct core *core, exr_context_t file, int top, int64_t height)
{
    int32_t rows = 1;
    exr_result_t result = core->exr_get_scanlines_per_chunk(file, 0, &rows);
    for (int64_t y = 0; result == EXR_ERR_SUCCESS && y < height; y += rows) {
        exr_chunk_info_t chunk;
        result = core->exr_read_scanline_chunk_info(file, 0, (int)(top + y), &chunk);
    }
    return result;
}

// Reads the chunks. Sets *stopped if the call must stop.
static exr_result_t read_chunks(const struct core *core, exr_context_t file, int top, struct call_control *call,
                                lam_image *image, bool *stopped)
{
    int32_t rows = 1;
    exr_result_t result = core->exr_get_scanlines_per_chunk(file, 0, &rows);
    exr_decode_pipeline_t pipe = EXR_DECODE_PIPELINE_INITIALIZER;
    for (int y = 0; result == EXR_ERR_SUCCESS && y < image->height; y += rows) {
        exr_chunk_info_t chunk;
        *stopped = !call_should_continue(call);
        if (*stopped)
            break;
        result = core->exr_read_scanline_chunk_info(file, 0, top + y, &chunk);
        if (result == EXR_ERR_SUCCESS)
            result = y == 0 ? core->exr_decoding_initialize(file, 0, &chunk, &pipe)
                            : core->exr_decoding_update(file, 0, &chunk, &pipe);
        for (int i = 0; result == EXR_ERR_SUCCESS && i < pipe.channel_count; i++) {
            exr_coding_channel_info_t *c = &pipe.channels[i];
            int place = place_of(c->channel_name, pipe.channel_count == 1);
            c->user_bytes_per_element = 4;
            c->user_data_type = EXR_PIXEL_FLOAT;
            c->user_pixel_stride = 16;
            c->user_line_stride = 16 * image->width;
            float *to = (float *)image->pixels + 4 * (size_t)y * (size_t)image->width;
            c->decode_to_ptr = place < 0 ? NULL : (uint8_t *)(to + place);
        }
        if (result == EXR_ERR_SUCCESS && y == 0)
            result = core->exr_decoding_choose_default_routines(file, 0, &pipe);
        if (result == EXR_ERR_SUCCESS)
            result = core->exr_decoding_run(file, 0, &pipe);
    }
    core->exr_decoding_destroy(file, &pipe);
    return result;
}

static bool fail_pixels(const struct core *core, const char *name, exr_result_t result, lam_error *error)
{
    return result == EXR_ERR_OUT_OF_MEMORY
               ? fail_memory(error, 0)
               : fail(error, LAM_CANNOT_READ, "%s: the EXR picture's pixels cannot be read: %s", name,
                      core->exr_get_default_error_message(result));
}

static bool read_part(const struct core *core, exr_context_t file, const struct picture_file *picture, lam_image *image,
                      lam_error *error)
{
    const char *name = picture->name;
    char shown[SHOWN_NAME_SIZE];
    exr_storage_t storage;
    exr_attr_box2i_t window;
    const exr_attr_chlist_t *list;
    if (core->exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS ||
        core->exr_get_data_window(file, 0, &window) != EXR_ERR_SUCCESS ||
        core->exr_get_channels(file, 0, &list) != EXR_ERR_SUCCESS)
        return fail(error, LAM_CANNOT_READ, "%s: the EXR header has no data window or no channels", name);
    if (storage != EXR_STORAGE_SCANLINE)
        return fail(error, LAM_UNSUPPORTED, "%s: this EXR picture has tiles or is deep; lambent reads only scanlines",
                    name);
    unsigned found = 0;
    bool grey = false;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *c = &list->entries[i];
        int place = place_of(c->name.str, list->num_channels == 1);
        if (place < 0)
            continue;
        if (c->x_sampling != 1 || c->y_sampling != 1 || c->pixel_type == EXR_PIXEL_UINT)
            return fail(error, LAM_UNSUPPORTED,
                        "%s: the EXR channel %s is subsampled or contains integers, expected floats for each pixel",
                        name, shown_name(c->name.str, shown));
        grey |= strcmp(c->name.str, "Y") == 0 || strcmp(c->name.str, "Z") == 0;
        found |= 1u << place;
    }
    if ((found & 7) != 7 && !(grey && (found & 7) == 1))
        return fail(error, LAM_UNSUPPORTED, "%s: the EXR picture has no channels R, G and B, nor Y", name);
    int64_t width = (int64_t)window.max.x - window.min.x + 1, height = (int64_t)window.max.y - window.min.y + 1;
    if (width < 1 || height < 1 || width > UINT32_MAX || height > UINT32_MAX)
        width = height = UINT32_MAX;
    if (!picture_size_check(picture, (uint32_t)width, (uint32_t)height, error))
        return false;
    exr_result_t result = find_chunks(core, file, window.min.y, height);
    if (result != EXR_ERR_SUCCESS)
        return fail_pixels(core, name, result, error);
    if (!picture_make(picture, (uint32_t)width, (uint32_t)height, LAM_RGBA32F, image, error))
        return false;
    image->no_alpha = !(found & 8);
    float *pixels = image->pixels;
    size_t count = (size_t)width * (size_t)height;
    for (size_t i = 0; i < count; i++)
        memcpy(pixels + 4 * i, (const float[4]){0, 0, 0, 1}, 16);
    bool stopped = false;
    result = read_chunks(core, file, window.min.y, picture->call, image, &stopped);
    if (stopped || result != EXR_ERR_SUCCESS) {
        picture_free(picture->call, image);
        return stopped ? call_error(picture->call, error) : fail_pixels(core, name, result, error);
    }
    for (size_t i = 0; (found & 7) == 1 && i < count; i++)
        pixels[4 * i + 1] = pixels[4 * i + 2] = pixels[4 * i];
    return true;
}

static bool exr_read(const struct picture_file *picture, lam_image *image, lam_error *error)
{
    struct core core;
    if (!open_core(&core, error))
        return false;
    struct source source = {picture->bytes, picture->size};
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = stay_silent;
    start.user_data = &source;
    start.read_fn = read_source;
    start.size_fn = size_of_source;
    start.max_image_width = start.max_image_height = 65535;
    exr_context_t file = NULL;
    exr_result_t result = core.exr_start_read(&file, picture->name, &start);
    bool ok = result == EXR_ERR_SUCCESS;
    if (result == EXR_ERR_OUT_OF_MEMORY)
        fail_memory(error, 0);
    else if (!ok)
        fail(error, LAM_CANNOT_READ, "%s: the EXR header cannot be read: %s", picture->name,
             core.exr_get_default_error_message(result));
    ok = ok && read_part(&core, file, picture, image, error);
    if (file)
        core.exr_finish(&file);
    library_close(core.handle);
    return ok;
}

#else

#define NOT_BUILT                                                                                                      \
    REMEDY("this build does not support EXR; install the Debian package libopenexr-dev and build again",               \
           "this page cannot read EXR; use the program lambent")

static bool write_layers(const lam_layer *layers, int count, lam_bytes *out, lam_error *error)
{
    (void)layers, (void)count, (void)out;
    return fail(error, LAM_UNSUPPORTED, NOT_BUILT);
}

static bool exr_read(const struct picture_file *picture, lam_image *image, lam_error *error)
{
    (void)image;
    return fail(error, LAM_UNSUPPORTED, "%s: " NOT_BUILT, picture->name);
}

#endif

static bool exr_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                      lam_error *error)
{
    (void)pool;
    return write_layers(&(lam_layer){.image = image, .channels = params->single ? "Z" : NULL}, 1, out, error);
}

bool lam_image_encode_layers(const lam_layer *layers, int count, lam_bytes *out, lam_error *error)
{
    if (!layers || count < 1 || count > MAX_CHANNELS || !out)
        return fail(error, LAM_BAD_ARGUMENT, "layers: expected 1 to %d, and a pointer for the bytes", MAX_CHANNELS);
    *out = (lam_bytes){0};
    for (int i = 0; i < count; i++) {
        const lam_image *image = layers[i].image, *first = layers[0].image;
        char what[24];
        snprintf(what, sizeof what, "layer %d", i);
        if (!image_check(image, what, error) || !check_reserved(what, &layers[i], error))
            return false;
        if (!format_is_float(image->format))
            return fail(error, LAM_BAD_ARGUMENT, "layer %d: expected a picture of floats (LAM_RGBA32F)", i);
        if (image->width != first->width || image->height != first->height)
            return fail(error, LAM_BAD_ARGUMENT, "layer %d: has %d×%d pixels, the first one %d×%d, expected the same",
                        i, image->width, image->height, first->width, first->height);
    }
    lam_layer *copies = calloc((size_t)count, sizeof *copies);
    lam_image *images = calloc((size_t)count, sizeof *images);
    bool ok = (copies && images) || fail_memory(error, (size_t)count * (sizeof *copies + sizeof *images));
    for (int i = 0; ok && i < count; i++) {
        copies[i] = layers[i];
        copies[i].image = &images[i];
        ok = image_working(layers[i].image, &images[i], error);
    }
    ok = ok && write_layers(copies, count, out, error);
    for (int i = 0; images && i < count; i++)
        lam_image_free(&images[i]);
    free(images);
    free(copies);
    return ok;
}

const struct codec codec_exr = {
    .name = "exr",
    .title = "EXR",
    .written = "floats, linear, with premultiplied alpha; needs OpenEXR",
    .pixels = LAM_RGBA32F,
    .write = exr_write,
    .probe = exr_probe,
    .read = exr_read,
};
