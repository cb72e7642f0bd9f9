// target_file.c: fuzz target for the ways into a model: by a path (the file is read as a whole, in parts or as a
// stream, which its format and size decide), from standard input, and from memory. Each way must give the same scene
// or the same error. An input is 24 bytes of options, then a model or scene file of any format.
//
// The options lengthen the file, so that its header or the whole file ends just before, at or after a size at which the
// readers change their method. The fuzzing build makes these sizes small (THRESHOLD in file.h); the test run of the
// corpus keeps them.
#include "own_folder.h"
#include "small_files.h"
#include "target.h"

#include "file.h"

enum { OPTIONS = 24, LARGE = THRESHOLD(1 << 20, 4 << 10), SIZE_MAX_TESTED = 4 * LARGE };

// Bits of byte 0.
enum { MORE_THREADS = 1, NORMALS_WHEN_DRAWN = 2, BY_FORMAT = 4, STANDARD_INPUT = 8, PIPE = 16 };

static uint8_t file[SIZE_MAX_TESTED];

static const char *const names[] = {"f.obj", "f.stl", "f.ply", "f.gltf", "f.glb", "f.3mf", "f.json", "f"};
enum { NAMES = sizeof names / sizeof *names };

// Inserts bytes `fill` at `at`, so that what was at offset `from` is then at offset `to`.
static size_t shift(size_t size, size_t at, size_t from, size_t to, uint8_t fill)
{
    size_t count = to > from ? to - from : 0;
    if (count == 0 || size + count > SIZE_MAX_TESTED)
        return size;
    memmove(file + at + count, file + at, size - at);
    memset(file + at, fill, count);
    return size + count;
}

// A comment after the first line, a letter longer than zero: "comment ccc" in PLY, "# ccc" in OBJ, blanks in JSON.
static size_t add_comment(size_t size, size_t from, size_t to, uint8_t fill)
{
    const uint8_t *line = memchr(file, '\n', size < 200 ? size : 200);
    const char *word = memcmp(file, "ply", size < 3 ? size : 3) == 0 ? "comment " : *file == '{' ? " " : "# ";
    size_t at = line ? (size_t)(line - file) + 1 : 0, length = strlen(word) + 1;
    if (!line || from < at || to < from + length || size + length > SIZE_MAX_TESTED)
        return size;
    memmove(file + at + length, file + at, size - at);
    memcpy(file + at, word, length - 1);
    file[at + length - 1] = '\n';
    return shift(size + length, at + length - 1, from + length, to, fill);
}

// The size at which a reader changes its method, and a few bytes more or less.
static size_t threshold(uint8_t which, uint8_t change)
{
    static const size_t sizes[] = {FILE_HEAD, LARGE, 2 * LARGE, LARGE + FILE_HEAD};
    return sizes[which % 4] + change % 16 - 8;
}

static size_t make_file(const uint8_t *o, const uint8_t *data, size_t size)
{
    static const uint8_t fills[] = {'c', ' ', '\n', 0, '#', '\r', 0xff, '\\'};
    size = size < SIZE_MAX_TESTED ? size : SIZE_MAX_TESTED;
    memcpy(file, data, size);
    if (!size)
        return 0;
    const uint8_t *end = memmem(file, size, "end_header", 10);
    size_t header = end ? (size_t)(end - file) + o[6] % 13 : size / 2;
    if (o[1] % 4 == 1)
        size = add_comment(size, header < size ? header : size, threshold(o[2], o[3]), fills[o[7] % 8]);
    else if (o[1] % 4 == 2)
        size = add_comment(size, size, threshold(o[2], o[3]), fills[o[7] % 8]);
    if (o[1] / 4 % 4 == 1)
        size = shift(size, size, size, threshold(o[4], o[5]), fills[o[8] % 8]);
    else if (o[1] / 4 % 4 == 2) // the file's end is repeated
        for (size_t period = 1 + o[9], to = threshold(o[4], o[5]); period <= size && size < to; size++)
            file[size] = file[size - period];
    return size;
}

// --- comparison

static bool same(const void *a, const void *b, size_t bytes) { return !a == !b && (!a || memcmp(a, b, bytes) == 0); }

static bool same_text(const char *a, const char *b) { return !a == !b && (!a || strcmp(a, b) == 0); }

static bool same_mesh(const lam_mesh *a, const lam_mesh *b)
{
    size_t corners = 3 * (size_t)a->triangle_count + 2 * (size_t)a->line_count + a->point_count,
           color = a->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4;
    if (a->triangle_count != b->triangle_count || a->vertex_count != b->vertex_count ||
        a->normal_count != b->normal_count || a->texcoord_count != b->texcoord_count ||
        a->tangent_count != b->tangent_count || a->color_count != b->color_count ||
        a->colors_format != b->colors_format || a->part_count != b->part_count || a->line_count != b->line_count ||
        a->point_count != b->point_count || !same_text(a->name, b->name))
        return false;
    for (uint32_t i = 0; i < a->part_count; i++)
        if (a->parts[i].material != b->parts[i].material || a->parts[i].first_triangle != b->parts[i].first_triangle ||
            a->parts[i].triangle_count != b->parts[i].triangle_count || !same_text(a->parts[i].name, b->parts[i].name))
            return false;
    return same(a->origin, b->origin, sizeof a->origin) &&
           same(a->positions, b->positions, 12 * (size_t)a->vertex_count) &&
           same(a->indices, b->indices, 4 * corners) && same(a->normals, b->normals, 12 * (size_t)a->normal_count) &&
           same(a->normal_indices, b->normal_indices, 4 * corners) &&
           same(a->texcoords, b->texcoords, 8 * (size_t)a->texcoord_count) &&
           same(a->texcoord_indices, b->texcoord_indices, 4 * corners) &&
           same(a->tangents, b->tangents, 16 * (size_t)a->tangent_count) &&
           same(a->colors, b->colors, color * a->color_count);
}

static bool same_scene(const lam_scene *a, const lam_scene *b)
{
    if (lam_scene_mesh_count(a) != lam_scene_mesh_count(b) ||
        lam_scene_material_count(a) != lam_scene_material_count(b) ||
        lam_scene_object_count(a) != lam_scene_object_count(b) ||
        lam_scene_light_count(a) != lam_scene_light_count(b) || lam_scene_up(a) != lam_scene_up(b) ||
        strcmp(lam_scene_format(a), lam_scene_format(b)) != 0)
        return false;
    for (int i = 0; i < lam_scene_mesh_count(a); i++)
        if (!same_mesh(lam_scene_mesh(a, i), lam_scene_mesh(b, i)))
            return false;
    for (int i = 0;; i++) {
        const char *one = lam_scene_warning(a, i), *other = lam_scene_warning(b, i);
        if (!same_text(one, other))
            return false;
        if (!one)
            return true;
    }
}

struct result {
    lam_scene *scene;
    lam_error error;
};

// A limit of memory or time may be reached on one way only.
static void compare(const struct result *a, const struct result *b)
{
    for (int i = 0; i < 2; i++) {
        const struct result *one = i ? b : a;
        if (!one->scene && (one->error.code == LAM_LIMIT || one->error.code == LAM_MACHINE))
            return;
    }
    if (!a->scene != !b->scene || (a->scene && !same_scene(a->scene, b->scene)) ||
        (!a->scene && (a->error.code != b->error.code || strcmp(a->error.text, b->error.text) != 0))) {
        fprintf(stderr, "two ways, two results: \"%s\" and \"%s\"\n", a->scene ? "a scene" : a->error.text,
                b->scene ? "a scene" : b->error.text);
        abort();
    }
}

// --- the ways

static const lam_control control = {.memory_limit_bytes = 256 << 20, .time_limit_s = 20};

static struct result load_path(const char *path, const lam_load_params *params)
{
    struct result result = {0};
    result.scene = lam_scene_load(path, params, &control, &result.error);
    return result;
}

// A short file may come from a pipe.
static struct result load_standard_input(const char *path, size_t size, bool pipes, const lam_load_params *params)
{
    int ends[2] = {-1, -1}, kept = dup(STDIN_FILENO), from;
    if (pipes && size <= 32 << 10 && pipe(ends) == 0) {
        if (write(ends[1], file, size) != (ssize_t)size)
            abort();
        close(ends[1]);
        from = ends[0];
    } else {
        from = open(path, O_RDONLY | O_CLOEXEC);
    }
    if (from < 0 || dup2(from, STDIN_FILENO) < 0)
        abort();
    close(from);
    struct result result = load_path("-", params);
    if (kept >= 0) {
        dup2(kept, STDIN_FILENO);
        close(kept);
    } else {
        close(STDIN_FILENO);
    }
    return result;
}

static struct result load_bytes(size_t size, const char *name, const lam_load_params *params)
{
    uint8_t *copy = malloc(size + (size == 0)); // exactly the file's size, for the sanitizer
    struct result result = {0};
    if (!copy)
        abort();
    memcpy(copy, file, size);
    result.scene = lam_scene_load_memory(copy, size, name, params, &control, &result.error);
    free(copy);
    return result;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[OWN_PATH];
    if (size < OPTIONS)
        return 0;
    const uint8_t *o = data;
    const char *name = names[o[10] % NAMES];
    size = make_file(o, data + OPTIONS, size - OPTIONS);
    own_path(path, name);
    write_own(path, file, size);
    const lam_load_params params = {.threads = o[0] & MORE_THREADS ? 3 : 1,
                                    .normals_when_drawn = o[0] & NORMALS_WHEN_DRAWN,
                                    .format = o[0] & BY_FORMAT ? lam_model_format_name(o[11] % 6) : NULL,
                                    .open = open_small};
    struct result by_path = load_path(path, &params), whole = load_bytes(size, path, &params);
    compare(&by_path, &whole);
    if (o[0] & STANDARD_INPUT) {
        struct result streamed = load_standard_input(path, size, o[0] & PIPE, &params),
                      named = load_bytes(size, "standard input", &params);
        compare(&streamed, &named);
        lam_scene_free(streamed.scene);
        lam_scene_free(named.scene);
    }
    lam_scene_free(whole.scene);
    check_scene(by_path.scene, &by_path.error);
    unlink(path);
    return 0;
}
