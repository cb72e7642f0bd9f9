// environment.c: makes cube maps from pictures: six faces, a cross, or an equirectangular picture.
#include "codec.h"
#include "environment.h"
#include "fail.h"
#include "file.h"
#include "float_state.h"
#include "linear.h"
#include "pixels.h"

#include <stdlib.h>
#include <string.h>

// --- limits of the call

// `call` may be NULL in all functions of this section.
static struct lam_environment *cube_within(struct call_control *call, int size, lam_error *error)
{
    if (call && !call_charge(call, cube_bytes(size)))
        return call_memory_error(call, cube_bytes(size), error), NULL;
    return cube_make(size, error);
}

static bool continues(struct call_control *call, int row, lam_error *error)
{
    return row % 16 != 0 || call_should_continue(call) || call_error(call, error);
}

// --- faces from sections of a picture

// A square section of a linear picture that becomes a face, rotated by 180° if `turned` is set.
struct chunk {
    const lam_image *image;
    int x, y;
    bool turned;
};

static bool copy_face(struct lam_environment *cube, int face, const struct chunk *chunk, const char *name,
                      struct call_control *call, lam_error *error)
{
    int n = cube->size;
    for (int t = 0; t < n; t++) {
        if (!continues(call, t, error))
            return false;
        for (int s = 0; s < n; s++) {
            int x = chunk->x + (chunk->turned ? n - 1 - s : s), y = chunk->y + (chunk->turned ? n - 1 - t : t);
            const float *from =
                (const float *)chunk->image->pixels + ((size_t)y * (size_t)chunk->image->width + (size_t)x) * 4;
            for (int channel = 0; channel < 3; channel++)
                if (!(from[channel] >= 0 && from[channel] <= 3e38f))
                    return fail(error, LAM_BAD_ARGUMENT, "%s: pixel %d, %d is %g, expected light of at least 0, finite",
                                name, x, y, (double)from[channel]);
            memcpy(cube_texel(cube, face, s, t), from, 3 * sizeof(float));
        }
    }
    return true;
}

static struct lam_environment *cube_of_chunks(const struct chunk chunks[LAM_FACE_COUNT],
                                              const char *const names[LAM_FACE_COUNT], int size,
                                              struct call_control *call, lam_error *error)
{
    if (size > CUBE_SIDE_MOST) {
        fail(error, LAM_LIMIT, "%s: a face of %d×%d pixels, expected at most %d×%d", names[0], size, size,
             CUBE_SIDE_MOST, CUBE_SIDE_MOST);
        return NULL;
    }
    struct lam_environment *cube = cube_within(call, size, error);
    for (int face = 0; cube && face < LAM_FACE_COUNT; face++) {
        if (!copy_face(cube, face, &chunks[face], names[face], call, error)) {
            lam_environment_free(cube);
            return NULL;
        }
    }
    if (cube)
        cube_close(cube);
    return cube;
}

static struct lam_environment *cube_of_faces(const lam_image *faces, const char *const names[LAM_FACE_COUNT],
                                             struct call_control *call, lam_error *error)
{
    struct chunk chunks[LAM_FACE_COUNT];
    for (int face = 0; face < LAM_FACE_COUNT; face++) {
        chunks[face] = (struct chunk){.image = &faces[face]};
        if (faces[face].width == faces[0].width && faces[face].height == faces[0].width)
            continue;
        fail(error, LAM_UNSUPPORTED, "%s: %d×%d pixels, expected %d×%d: faces of a cube are squares of one size",
             names[face], faces[face].width, faces[face].height, faces[0].width, faces[0].width);
        return NULL;
    }
    return cube_of_chunks(chunks, names, faces[0].width, call, error);
}

// --- an equirectangular picture

typedef float pixel __attribute__((vector_size(16)));
typedef float pixel_memory __attribute__((vector_size(16), aligned(4), may_alias));

// These functions return the position of a longitude or of a latitude in the picture, in pixels from the centre of the
// first pixel. Longitude 0 is the direction −z, and latitude 0 is +y.
static double column_of(const lam_image *image, double longitude)
{
    return (0.5 + longitude / (2 * PI)) * image->width - 0.5;
}

static double row_of(const lam_image *image, double latitude) { return latitude / PI * image->height - 0.5; }

// Samples a row of a face. Texel s is read at columns[s] and rows[s]. With `below`, rows are counted upwards from the
// last row of the picture instead of downwards from the first.
static void sample_row(const lam_image *image, const double *columns, const double *rows, bool below,
                       struct lam_environment *cube, int face, int t)
{
    const float *pixels = image->pixels;
    int width = image->width, last = image->height - 1;
    for (int s = 0; s < cube->size; s++) {
        double x = columns[s], y = below ? last - rows[s] : rows[s];
        int left = (int)(x + 1) - 1, upper = (int)(y + 1) - 1; // x and y are at least −½
        float across = (float)(x - left), down = (float)(y - upper);
        int right = left + 1 < width ? left + 1 : 0, lower = upper < last ? upper + 1 : last; // columns wrap around
        left = left < 0 ? width - 1 : left;
        upper = upper < 0 ? 0 : upper;
        const float *above = pixels + (size_t)upper * (size_t)width * 4,
                    *beneath = pixels + (size_t)lower * (size_t)width * 4;
        pixel a = *(const pixel_memory *)(above + 4 * (size_t)left),
              b = *(const pixel_memory *)(above + 4 * (size_t)right);
        pixel c = *(const pixel_memory *)(beneath + 4 * (size_t)left),
              e = *(const pixel_memory *)(beneath + 4 * (size_t)right);
        a = a * (1 - across) + b * across;
        c = c * (1 - across) + e * across;
        // The fourth float overwrites the next texel or the border, but both are filled later.
        *(pixel_memory *)cube_texel(cube, face, s, t) = a * (1 - down) + c * down;
    }
}

// Samples row t, which is above the middle, and row size − 1 − t of the four side faces. All texels of a column have
// the same longitude, and the latitudes are the same on all four faces. `rows` is memory for one row of a face.
static void sample_around(const lam_image *image, struct lam_environment *cube, const double *const columns[4],
                          double *rows, int t)
{
    static const enum lam_cube_face around[4] = {LAM_FACE_PX, LAM_FACE_NX, LAM_FACE_PZ, LAM_FACE_NZ};
    int size = cube->size;
    double up = size - 1 - 2 * t;
    for (int s = 0; 2 * s < size; s++) {
        double across = 2 * s + 1 - size;
        rows[s] = rows[size - 1 - s] = row_of(image, math_atan2(math_sqrt((double)size * size + across * across), up));
    }
    for (int i = 0; i < 4; i++) {
        sample_row(image, columns[i], rows, false, cube, around[i], t);
        sample_row(image, columns[i], rows, true, cube, around[i], size - 1 - t);
    }
}

// Samples the same rows of the upper and lower faces. The halves of a face mirror each other: longitudes are negated,
// or subtracted from a half turn. `memory` has space for three rows.
static void sample_ends(const lam_image *image, struct lam_environment *cube, double *memory, int t)
{
    int size = cube->size;
    double back = size - 1 - 2 * t, *rows = memory, *behind = memory + size, *ahead = memory + 2 * size;
    for (int s = 0; 2 * s < size; s++) {
        double left = size - 1 - 2 * s, longitude = math_atan2(left, back);
        rows[s] = rows[size - 1 - s] = row_of(image, math_atan2(math_sqrt(left * left + back * back), size));
        behind[s] = column_of(image, -longitude);
        behind[size - 1 - s] = column_of(image, longitude);
        ahead[s] = column_of(image, longitude - PI);
        ahead[size - 1 - s] = column_of(image, PI - longitude);
    }
    sample_row(image, behind, rows, false, cube, LAM_FACE_PY, t);
    sample_row(image, ahead, rows, false, cube, LAM_FACE_PY, size - 1 - t);
    sample_row(image, ahead, rows, true, cube, LAM_FACE_NY, t);
    sample_row(image, behind, rows, true, cube, LAM_FACE_NY, size - 1 - t);
}

static bool check_light(const lam_image *image, const char *name, struct call_control *call, lam_error *error)
{
    const float *at = image->pixels;
    for (int y = 0; y < image->height; y++) {
        if (!continues(call, y, error))
            return false;
        for (int x = 0; x < image->width; x++, at += 4)
            for (int channel = 0; channel < 3; channel++)
                if (!(at[channel] >= 0 && at[channel] <= 3e38f))
                    return fail(error, LAM_BAD_ARGUMENT, "%s: pixel %d, %d is %g, expected light of at least 0, finite",
                                name, x, y, (double)at[channel]);
    }
    return true;
}

static struct lam_environment *cube_of_sphere(const lam_image *image, const char *name, struct call_control *call,
                                              lam_error *error)
{
    int size = (int)((double)image->width / PI) + 1;
    if (size > CUBE_SIDE_MOST) {
        fail(error, LAM_LIMIT, "%s: %d pixels wide, expected at most %d", name, image->width,
             (int)(CUBE_SIDE_MOST * PI));
        return NULL;
    }
    struct lam_environment *cube = check_light(image, name, call, error) ? cube_within(call, size, error) : NULL;
    if (!cube)
        return NULL;
    const size_t bytes = 7 * (size_t)size * sizeof(double);
    double *memory = malloc(bytes);
    if (!memory) {
        lam_environment_free(cube);
        fail_memory(error, bytes);
        return NULL;
    }
    bool ok = true;
    double *rest = memory + 4 * (size_t)size;
    const double *const columns[4] = {memory, memory + size, memory + 2 * size, memory + 3 * size};
    for (int s = 0; s < size; s++) {
        double across = 2 * s + 1 - size;
        memory[s] = column_of(image, math_atan2(size, across));
        memory[size + s] = column_of(image, math_atan2(-size, -across));
        memory[2 * size + s] = column_of(image, math_atan2(across, -size));
        memory[3 * size + s] = column_of(image, math_atan2(-across, size));
    }
    for (int t = 0; ok && 2 * t < size; t++) {
        ok = continues(call, t, error);
        sample_around(image, cube, columns, rest, t);
        sample_ends(image, cube, rest, t);
    }
    free(memory);
    if (!ok) {
        lam_environment_free(cube);
        return NULL;
    }
    cube_close(cube);
    return cube;
}

// Makes a cube from one linear picture. The aspect ratio of the picture determines its layout.
static struct lam_environment *cube_of_image(const lam_image *image, const char *name, struct call_control *call,
                                             lam_error *error)
{
    static const int lying[LAM_FACE_COUNT][2] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};
    static const int standing[LAM_FACE_COUNT][2] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}};
    int64_t width = image->width, height = image->height;
    bool lies = width % 4 == 0 && 3 * width == 4 * height, upright = width % 3 == 0 && 4 * width == 3 * height;
    if (width == 2 * height)
        return cube_of_sphere(image, name, call, error);
    if (!lies && !upright) {
        fail(error, LAM_UNSUPPORTED,
             "%s: %d×%d pixels, expected a cross of six squares (4:3 or 3:4) or an equirectangular picture "
             "(2:1)",
             name, image->width, image->height);
        return NULL;
    }
    int size = image->width / (lies ? 4 : 3);
    struct chunk chunks[LAM_FACE_COUNT];
    const char *names[LAM_FACE_COUNT];
    for (int face = 0; face < LAM_FACE_COUNT; face++) {
        const int *at = lies ? lying[face] : standing[face];
        chunks[face] = (struct chunk){image, at[0] * size, at[1] * size, upright && face == LAM_FACE_NZ};
        names[face] = name;
    }
    return cube_of_chunks(chunks, names, size, call, error);
}

// --- the caller's pictures

// Makes a linear copy of a picture; the caller frees the copy.
static bool linear_copy(const lam_image *image, lam_color_mode color, lam_image *out, lam_error *error)
{
    *out = (lam_image){0};
    if (!image_check(image, "environment", error))
        return false;
    if ((unsigned)color > LAM_COLOR_RAW)
        return fail(error, LAM_BAD_ARGUMENT, "environment: color mode %d is not one of lam_color_mode", (int)color);
    struct picture_file none = {.name = "environment"};
    return image_copy(image, out, error) && picture_linearize(&none, out, false, color, error);
}

lam_environment *lam_environment_make(const lam_image *const faces[LAM_FACE_COUNT], lam_color_mode color,
                                      lam_error *error)
{
    static const char *const names[LAM_FACE_COUNT] = {"environment, face +X", "environment, face -X",
                                                      "environment, face +Y", "environment, face -Y",
                                                      "environment, face +Z", "environment, face -Z"};
    uint64_t state = float_state_enter();
    lam_image linear[LAM_FACE_COUNT] = {{0}};
    bool ok = faces || fail(error, LAM_BAD_ARGUMENT, "environment: no faces are given");
    for (int face = 0; ok && face < LAM_FACE_COUNT; face++)
        ok = linear_copy(faces[face], color, &linear[face], error);
    struct lam_environment *cube = ok ? cube_of_faces(linear, names, NULL, error) : NULL;
    for (int face = 0; face < LAM_FACE_COUNT; face++)
        lam_image_free(&linear[face]);
    float_state_leave(state);
    return cube;
}

lam_environment *lam_environment_from_image(const lam_image *image, lam_color_mode color, lam_error *error)
{
    uint64_t state = float_state_enter();
    lam_image linear;
    struct lam_environment *cube =
        linear_copy(image, color, &linear, error) ? cube_of_image(&linear, "environment", NULL, error) : NULL;
    lam_image_free(&linear);
    float_state_leave(state);
    return cube;
}

// --- files

// Reads a picture file as linear light; the caller frees the picture with picture_free.
static bool read_picture(const struct picture_source *source, int index, lam_color_mode color,
                         struct call_control *call, lam_image *image, const char **name, lam_error *error)
{
    struct file_bytes bytes = {0};
    if (!source->open(source->user, index, call, &bytes, name, error))
        return false;
    struct picture_file file = {bytes.data, bytes.size, *name, call};
    bool ok = picture_decode_linear(&file, color, image, error);
    file_release(&bytes);
    return ok;
}

struct lam_environment *environment_read(const struct picture_source *source, int count, lam_color_mode color,
                                         struct call_control *call, lam_error *error)
{
    lam_image images[LAM_FACE_COUNT] = {{0}};
    const char *names[LAM_FACE_COUNT];
    bool ok = true;
    for (int i = 0; ok && i < count; i++)
        ok = read_picture(source, i, color, call, &images[i], &names[i], error);
    uint64_t state = float_state_enter();
    struct lam_environment *cube = !ok          ? NULL
                                   : count == 1 ? cube_of_image(images, names[0], call, error)
                                                : cube_of_faces(images, names, call, error);
    float_state_leave(state);
    for (int i = 0; i < count; i++)
        picture_free(call, &images[i]);
    return cube;
}

static bool open_path(void *user, int index, struct call_control *call, struct file_bytes *file, const char **name,
                      lam_error *error)
{
    const char *path = ((const char *const *)user)[index];
    *name = strcmp(path, "-") == 0 ? "standard input" : path;
    return file_read(path, NULL, call, file, error);
}

static lam_environment *load(const char *const *paths, int count, lam_color_mode color, const lam_control *control,
                             lam_error *error)
{
    if ((unsigned)color > LAM_COLOR_RAW) {
        fail(error, LAM_BAD_ARGUMENT, "environment: color mode %d is not one of lam_color_mode", (int)color);
        return NULL;
    }
    for (int i = 0; i < count; i++) {
        if (paths && paths[i])
            continue;
        fail(error, LAM_BAD_ARGUMENT, "environment: no path is given for picture %d of %d", i + 1, count);
        return NULL;
    }
    struct call_control call;
    call_start(&call, control);
    struct picture_source source = {open_path, (void *)(uintptr_t)paths};
    return environment_read(&source, count, color, &call, error);
}

lam_environment *lam_environment_load_faces(const char *const paths[LAM_FACE_COUNT], lam_color_mode color,
                                            const lam_control *control, lam_error *error)
{
    return load(paths, LAM_FACE_COUNT, color, control, error);
}

lam_environment *lam_environment_load(const char *path, lam_color_mode color, const lam_control *control,
                                      lam_error *error)
{
    return load(&path, 1, color, control, error);
}
