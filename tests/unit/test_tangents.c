// test_tangents.c: MikkTSpace: small meshes whose tangents follow from the definition, and four primitives of models
// compared with the tangents of Mikkelsen's own code (../shared/reference-pictures/mikktspace, if it exists).
#include "test.h"
#include "cpu_features.h"
#include "tangent_steps.h"
#include "mikktspace.h"
#include "quad.h"

// The tangents of a mesh; its arena remains until the next call.
static struct mesh_tangents tangents_of(const lam_mesh *mesh, bool t_down)
{
    static struct arena arena;
    struct mesh_tangents out = {0};
    arena_free(&arena);
    arena_start(&arena, NULL);
    assert_true(mikktspace(&out, mesh, t_down, &arena, NULL, NULL));
    for (uint32_t c = 0; c < 3 * mesh->triangle_count; c++)
        assert_true(out.indices[c] < out.count);
    return out;
}

static void expect(const struct mesh_tangents *made, uint32_t corner, float x, float y, float z, float w)
{
    const float expected[4] = {x, y, z, w}, *found = made->tangents + 4 * (size_t)made->indices[corner];
    for (int i = 0; i < 4; i++)
        if (!(fabsf(found[i] - expected[i]) <= 1e-6f))
            fail_msg("corner %u: found %g %g %g %g, expected %g %g %g %g", corner, (double)found[0], (double)found[1],
                     (double)found[2], (double)found[3], (double)x, (double)y, (double)z, (double)w);
}

// Triangles without indices in the plane z = 0, facing +z: x, y, s, t of each corner.
enum { CORNERS_MAX = 12 };
struct flat_mesh {
    float positions[3 * CORNERS_MAX], normals[3 * CORNERS_MAX], texcoords[2 * CORNERS_MAX];
    lam_mesh mesh;
};

static const lam_mesh *flat_mesh(struct flat_mesh *flat, const float (*corners)[4], uint32_t count)
{
    assert_true(count <= CORNERS_MAX);
    memset(flat, 0, sizeof *flat);
    for (uint32_t i = 0; i < count; i++) {
        memcpy(flat->positions + 3 * (size_t)i, corners[i], 2 * sizeof(float));
        memcpy(flat->texcoords + 2 * (size_t)i, corners[i] + 2, 2 * sizeof(float));
        flat->normals[3 * i + 2] = 1;
    }
    flat->mesh = (lam_mesh){.positions = flat->positions, .vertex_count = count, .triangle_count = count / 3};
    flat->mesh.normals = flat->normals;
    flat->mesh.normal_count = count;
    flat->mesh.texcoords = flat->texcoords;
    flat->mesh.texcoord_count = count;
    return &flat->mesh;
}

// A square whose corners share no indices gets one tangent for each of its four welded corners.
TEST(plane)
{
    static const float corners[][4] = {{0, 0, 0, 0},         {1, 0, 1, 0}, {1, 1, 1, 1},
                                       {-0.0f, 0, 0, -0.0f}, {1, 1, 1, 1}, {0, 1, 0, 1}};
    struct flat_mesh flat;
    for (int t_down = 0; t_down < 2; t_down++) {
        struct mesh_tangents made = tangents_of(flat_mesh(&flat, corners, 6), t_down);
        assert_int_equal(made.count, 4);
        assert_int_equal(made.indices[0], made.indices[3]); // −0 equals 0
        for (uint32_t c = 0; c < 6; c++)
            expect(&made, c, 1, 0, 0, t_down ? -1 : 1);
    }
}

// Directions are weighted by the angle at the corner, not by the area. Below the common edge, from (0, 0) to (100, 0),
// there is a long triangle with an angle of 45°, where s grows along (1, 1); above it a short one with 90°, where s
// grows along (0, 1).
TEST(angles_are_weights)
{
    static const float corners[][4] = {{0, 0, 0, 0}, {100, -100, 0, -20}, {100, 0, 10, -10}, //
                                       {0, 0, 0, 0}, {100, 0, 10, -10},   {0, 1, 1, 0}};
    struct flat_mesh flat;
    struct mesh_tangents made = tangents_of(flat_mesh(&flat, corners, 6), false);
    double x = 45 * sqrt(0.5), y = 45 * sqrt(0.5) + 90, length = sqrt(x * x + y * y), half = sqrt(0.5);
    assert_int_equal(made.indices[0], made.indices[3]);
    expect(&made, 0, (float)(x / length), (float)(y / length), 0, 1);
    expect(&made, 1, (float)half, (float)half, 0, 1);
    expect(&made, 5, 0, 1, 0, 1);
}

// Two squares with a common edge, the right one mirrored in the texture: the edge's corners are welded and have the
// same normals and texture coordinates, but two tangents.
TEST(mirrored_halves)
{
    static const float corners[][4] = {{-1, 0, 0, 0}, {0, 0, 1, 0},  {0, 1, 1, 1}, {-1, 0, 0, 0},
                                       {0, 1, 1, 1},  {-1, 1, 0, 1}, {0, 0, 1, 0}, {1, 0, 0, 0},
                                       {1, 1, 0, 1},  {0, 0, 1, 0},  {1, 1, 0, 1}, {0, 1, 1, 1}};
    struct flat_mesh flat;
    struct mesh_tangents made = tangents_of(flat_mesh(&flat, corners, 12), false);
    for (uint32_t c = 0; c < 12; c++)
        expect(&made, c, c < 6 ? 1 : -1, 0, 0, c < 6 ? 1 : -1);
    assert_int_equal(made.count, 8);
}

// A triangle whose texture coordinates span no area takes the tangents and the orientation of its neighbours, and
// contributes nothing to them; alone, it has the direction around the y axis.
TEST(degenerate_texcoords)
{
    static const float corners[][4] = {{0, 0, 1, 0}, {1, 0, 0, 0}, {1, 1, 0, 1},
                                       {0, 0, 1, 0}, {1, 1, 0, 1}, {-5, 1, 1, 0}};
    struct flat_mesh flat;
    struct mesh_tangents made = tangents_of(flat_mesh(&flat, corners, 6), false);
    for (uint32_t c = 0; c < 5; c++)
        expect(&made, c, -1, 0, 0, -1);
    expect(&made, 5, 1, 0, 0, 1); // no group reaches this corner
    made = tangents_of(flat_mesh(&flat, corners + 3, 3), true);
    for (uint32_t c = 0; c < 3; c++)
        expect(&made, c, 1, 0, 0, 1);
}

// A triangle with two equal positions separates nothing: its corners have the tangents of the equal corners.
TEST(degenerate_triangle)
{
    static const float corners[][4] = {{0, 0, 0, 0}, {0, 0, 0, 0}, {1, 1, 0, 1}, {0, 0, 0, 0}, {0, 1, 1, 0},
                                       {1, 1, 0, 1}, {0, 0, 0, 0}, {1, 1, 0, 1}, {1, 0, -1, 0}};
    struct flat_mesh flat;
    struct mesh_tangents made = tangents_of(flat_mesh(&flat, corners, 9), false);
    assert_int_equal(made.indices[0], made.indices[3]);
    assert_int_equal(made.indices[1], made.indices[6]);
    assert_int_equal(made.indices[2], made.indices[5]);
    made = tangents_of(flat_mesh(&flat, corners, 3), false); // without a corner to copy from
    expect(&made, 0, 1, 0, 0, 1);
}

// For any angle, a corner of a narrow triangle has the triangle's direction.
TEST(sliver)
{
    static const float corners[][4] = {{0, 0, 0, 0}, {1, 0, 0, 1}, {1, 1e-9f, -1e-9f, 1}};
    struct flat_mesh flat;
    struct mesh_tangents made = tangents_of(flat_mesh(&flat, corners, 3), false);
    for (uint32_t c = 0; c < 3; c++)
        expect(&made, c, 0, -1, 0, 1);
}

// Directions that cancel, except for the rounding of √3/2, leave the tangent of meshes without texture coordinates.
// They are at 210°, 90° and 330°; none is mirrored.
TEST(directions_that_cancel)
{
#define HEIGHT 0.8660254f
    static const float corners[][4] = {{0, 0, 0, 0}, {1, 0, -1, 1},         {0.5f, HEIGHT, 0, -1},
                                       {0, 0, 0, 0}, {0.5f, HEIGHT, 0, -1}, {-0.5f, HEIGHT, 1, 1},
                                       {0, 0, 0, 0}, {-0.5f, HEIGHT, 1, 1}, {-1, 0, -2, -1}};
    struct flat_mesh flat;
    struct mesh_tangents made = tangents_of(flat_mesh(&flat, corners, 9), false);
    assert_true(made.indices[0] == made.indices[3] && made.indices[3] == made.indices[6]);
    expect(&made, 0, 1, 0, 0, 1);
    expect(&made, 1, -HEIGHT, -0.5f, 0, 1);
    expect(&made, 8, HEIGHT, -0.5f, 0, 1);
}

// Flags and sums are the same with every instruction set, for any number of triangles, with one kind of indices, with
// three or with none.
TEST(same_bytes)
{
    enum { TRIANGLES = 37, VERTICES = 3 * TRIANGLES };
    static float numbers[8 * VERTICES];
    static uint32_t indices[3 * VERTICES], groups[VERTICES];
    uint32_t random = 1;
    for (int i = 0; i < 8 * VERTICES; i++) {
        random = random * 1664525 + 1013904223;
        numbers[i] = i % 11 ? (float)(random >> 8) / 8388608.0f - 1 : 0;
    }
    for (uint32_t i = 0; i < 3 * VERTICES; i++) {
        random = random * 1664525 + 1013904223;
        indices[i] = (random >> 8) % VERTICES;
        groups[i % VERTICES] = (random >> 8) % 20;
    }
    for (int kind = 0; kind < 3; kind++) {
        const lam_mesh mesh = {.positions = numbers,
                               .normals = numbers + 3 * VERTICES,
                               .texcoords = numbers + 6 * VERTICES,
                               .vertex_count = VERTICES,
                               .triangle_count = TRIANGLES,
                               .indices = kind ? indices : NULL,
                               .normal_indices = kind == 2 ? indices + VERTICES : NULL,
                               .texcoord_indices = kind == 2 ? indices + 2 * VERTICES : NULL};
        uint8_t flags[3][TRIANGLES + TRIANGLES_AFTER];
        float sums[3][20][4] = {{{0}}};
        for (int lanes = 0; lanes < 3; lanes++) {
            const struct tangent_kernels *kernels = CPU_WIDEST(1 << (lanes + 2), tangent_kernels);
            kernels->look(&mesh, 0, TRIANGLES, flags[lanes]);
            kernels->add(&mesh, 0, 16, flags[lanes], groups, sums[lanes]);
            kernels->add(&mesh, 16, TRIANGLES, flags[lanes], groups, sums[lanes]);
            assert_memory_equal(flags[lanes], flags[0], TRIANGLES);
            assert_memory_equal(sums[lanes], sums[0], sizeof *sums);
        }
        assert_true(sums[0][0][3] > 0);
    }
}

// Four triangles on one edge, in the order out, in, in, out: the first is paired with the first, the second with the
// second.
TEST(twins_of_a_fan)
{
    static const float corners[][4] = {{0, 0, 0, 0},   {1, 0, 1, 0},   {0, 1, 0, 1}, {1, 0, 1, 0},
                                       {0, 0, 0, 0},   {0, -1, 0, -1}, {1, 0, 1, 0}, {0, 0, 0, 0},
                                       {0, -2, 0, -2}, {0, 0, 0, 0},   {1, 0, 1, 0}, {0, 2, 0, 2}};
    struct flat_mesh flat;
    const lam_mesh *mesh = flat_mesh(&flat, corners, 12);
    const uint8_t flags[4] = {0};
    struct arena memory;
    struct corner_weld weld;
    struct edge_twins edges;
    arena_start(&memory, NULL);
    assert_true(corner_weld(&weld, mesh, &memory, NULL, NULL));
    assert_true(edge_twins(&edges, &weld, 4, flags, 1, &memory, NULL, NULL));
    assert_int_equal(edges.twin[0], 3);
    assert_int_equal(edges.twin[3], 0);
    assert_int_equal(edges.twin[9], 6);
    assert_int_equal(edges.twin[6], 9);
    for (uint32_t c = 0; c < 12; c++)
        if (c % 3)
            assert_int_equal(edges.twin[c], NO_CORNER);
    arena_free(&memory);
}

// So many vertices that some with different numbers have the same 32-bit hash; the second half repeats the first.
TEST(equal_hashes_are_distinguished)
{
    enum { VERTICES = 300000, ALL = 2 * VERTICES };
    float *numbers = calloc((size_t)ALL * 8, sizeof *numbers);
    uint32_t *indices = malloc((size_t)ALL * sizeof *indices);
    assert_non_null(numbers);
    assert_non_null(indices);
    for (uint32_t i = 0; i < ALL; i++) {
        uint32_t x = i % VERTICES * 2654435761u;
        numbers[3 * (size_t)i] = (float)(x >> 12);
        numbers[3 * (size_t)i + 1] = (float)(i % VERTICES);
        indices[i] = i;
    }
    lam_mesh mesh = {.positions = numbers,
                     .vertex_count = ALL,
                     .indices = indices,
                     .triangle_count = ALL / 3,
                     .normals = numbers + (size_t)ALL * 3,
                     .normal_count = ALL,
                     .texcoords = numbers + (size_t)ALL * 6,
                     .texcoord_count = ALL};
    struct arena memory;
    struct corner_weld weld;
    arena_start(&memory, NULL);
    assert_true(corner_weld(&weld, &mesh, &memory, NULL, NULL));
    assert_int_equal(weld.items, ALL);
    for (uint32_t i = 0; i < ALL; i++)
        assert_int_equal(weld.of[i], i % VERTICES);
    arena_free(&memory);
    free(numbers);
    free(indices);
}

// --- a scene's meshes

// A square whose first texture coordinates are mirrored and whose second ones are not, with a normal-mapped material.
static lam_scene *normal_mapped_square(int set, const float transform[2][3])
{
    static const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
                       normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const float mirrored[] = {1, 0, 0, 0, 0, 1, 1, 1}, straight[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const uint8_t flat[] = {128, 128, 255, 255};
    lam_error error = {0};
    lam_image image = {.width = 1, .height = 1, .format = LAM_RGBA8, .pixels = (void *)(uintptr_t)flat};
    lam_scene *scene = lam_scene_make(&error);
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_NUMBERS, NULL, &error);
    assert_non_null(texture);
    lam_texture_map map = {.texture = texture, .texcoords = set};
    memcpy(map.transform, transform, sizeof map.transform);
    lam_material material = lam_material_default();
    if (set >= 0)
        material.maps[LAM_MAP_NORMAL] = &map;
    const lam_part part = {.triangle_count = 2, .material = lam_scene_add_material(scene, &material, &error)};
    assert_int_equal(part.material, 0);
    const lam_mesh mesh = quad_mesh(positions, normals, mirrored, straight, &part);
    assert_int_equal(lam_scene_add_mesh(scene, &mesh, &error), 0);
    lam_texture_free(texture);
    return scene;
}

// The tangents belong to the normal map's texture coordinates, and the bitangent points up in its picture.
TEST(tangents_of_a_normal_map)
{
    static const float same[2][3] = {{0}}, upside_down[2][3] = {{1, 0, 0}, {0, -1, 1}};
    static const struct {
        int set;
        const float (*transform)[3];
        float x, w;
    } rows[] = {
        {-1, same, -1, -1}, {0, same, -1, 1}, {1, same, 1, -1}, {0, upside_down, -1, -1}, {1, upside_down, 1, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        AUTO_SCENE scene = normal_mapped_square(rows[i].set, rows[i].transform);
        assert_true(lam_scene_make_tangents(scene, NULL, NULL));
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        const struct mesh_tangents made = {(float *)(uintptr_t)mesh->tangents, mesh->tangent_count,
                                           (uint32_t *)(uintptr_t)mesh->tangent_indices};
        for (uint32_t c = 0; c < 6; c++)
            expect(&made, c, rows[i].x, 0, 0, rows[i].w);
    }
}

// --- the tangents of Mikkelsen's code

static const struct {
    const char *model, *mesh; // below ../shared/models; name of the mesh, which has one primitive
    uint32_t corners;
    size_t first_float; // in the file of tangents
} references[] = {
    {"glb/playcanvas/NormalTangentTest.glb", "NormalTangentTest_low", 23322, 0},
    {"gltf-tests/khronos/ClearCoatTest/glTF-Binary/ClearCoatTest.glb", "ClearCoatSampleMesh", 6180, 93288},
    {"gltf-tests/khronos/ClearCoatTest/glTF-Binary/ClearCoatTest.glb", "Labels_Mesh", 12, 118008},
    {"glb/bevy/GolfBall.glb", "polyhedronisme-tdtI.001", 1068, 118056},
};
enum { REFERENCE_FLOATS = 118056 + 4 * 1068 };

static float *read_references(const char *models)
{
    char path[600], command[700];
    snprintf(path, sizeof path, "%s/../reference-pictures/mikktspace/tangents.f32.xz", models);
    FILE *there = fopen(path, "rb");
    if (!there)
        return NULL;
    fclose(there);
    snprintf(command, sizeof command, "xz -dc '%s' 2>/dev/null", path);
    FILE *pipe = popen(command, "r");
    float *floats = malloc(REFERENCE_FLOATS * sizeof *floats);
    assert_non_null(pipe);
    assert_non_null(floats);
    size_t count = fread(floats, sizeof *floats, REFERENCE_FLOATS, pipe);
    if (pclose(pipe) != 0 || count != REFERENCE_FLOATS) {
        free(floats);
        return NULL;
    }
    return floats;
}

static void compare_reference(const char *models, int row, const float *expected)
{
    char path[600];
    lam_error error = {0};
    snprintf(path, sizeof path, "%s/%s", models, references[row].model);
    AUTO_SCENE scene = lam_scene_load(path, NULL, NULL, &error);
    SUCCEEDS(scene);
    const lam_mesh *mesh = NULL;
    for (int i = 0; i < lam_scene_mesh_count(scene); i++)
        if (strcmp(lam_scene_mesh(scene, i)->name, references[row].mesh) == 0)
            mesh = lam_scene_mesh(scene, i);
    assert_non_null(mesh);
    assert_int_equal(3 * mesh->triangle_count, references[row].corners);
    const lam_material *material = lam_scene_material(scene, mesh->parts->material);
    assert_true(!mesh->tangents == !material->maps[LAM_MAP_NORMAL]);
    struct mesh_tangents made = tangents_of(mesh, true);
    uint32_t signs = 0, directions = 0;
    double worst = 0;
    for (uint32_t c = 0; c < references[row].corners; c++) {
        const float *found = made.tangents + 4 * (size_t)made.indices[c], *from = expected + 4 * (size_t)c;
        double distance = sqrt(pow((double)found[0] - (double)from[0], 2) + pow((double)found[1] - (double)from[1], 2) +
                               pow((double)found[2] - (double)from[2], 2));
        signs += found[3] != from[3];
        if (mesh->tangents) // made while loading
            assert_memory_equal(mesh->tangents + 4 * (size_t)mesh->tangent_indices[c], found, 4 * sizeof *found);
        directions += !(distance <= 1e-4);
        worst = distance > worst ? distance : worst;
    }
    print_message("%s: %u corners, %u tangents; %u signs differ, %u directions by more than 1e-4, at most %.2g\n",
                  references[row].mesh, references[row].corners, made.count, signs, directions, worst);
    assert_int_equal(signs, 0);
    assert_int_equal(directions, 0);
}

TEST(tangents_of_mikkelsens_code)
{
    const char *models = getenv("LAMBENT_MODELS");
    models = models ? models : "../shared/models";
    float *expected = read_references(models);
    if (!expected) {
        print_message("%s/../reference-pictures/mikktspace or xz is not there: not compared with Mikkelsen's code\n",
                      models);
        skip();
    }
    for (size_t i = 0; i < sizeof references / sizeof *references; i++)
        compare_reference(models, (int)i, expected + references[i].first_float);
    free(expected);
}

// --- tangents of scenes (lam_scene_make_tangents)

static lam_scene *square_scene(const float *texcoords)
{
    static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    lam_mesh mesh = quad_mesh(square, normals, texcoords, NULL, NULL);
    mesh.texcoord_count = texcoords ? 4 : 0;
    mesh.second_texcoord_count = 0;
    mesh.part_count = 0;
    lam_scene *scene = lam_scene_make(NULL);
    assert_int_equal(lam_scene_add_mesh(scene, &mesh, NULL), 0);
    return scene;
}

static const float *tangent_at(const lam_mesh *mesh, uint32_t corner)
{
    return mesh->tangents + 4 * (size_t)mesh->tangent_indices[corner];
}

TEST(tangents_of_a_square)
{
    static const float straight[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const float turned[] = {0, 0, 0, 1, -1, 1, -1, 0}; // s along −y
    static const float mirrored[] = {1, 0, 0, 0, 0, 1, 1, 1}; // s along −x, t along y
    static const float nowhere[] = {0, 0, 0, 0, 0, 0, 0, 0};
    static const struct {
        const float *texcoords;
        float expected[4];
    } rows[] = {{straight, {1, 0, 0, 1}}, {turned, {0, -1, 0, 1}}, {mirrored, {-1, 0, 0, -1}}, {nowhere, {1, 0, 0, 1}}};
    for (int r = 0; r < 4; r++) {
        AUTO_SCENE scene = square_scene(rows[r].texcoords);
        assert_true(lam_scene_make_tangents(scene, NULL, NULL));
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        assert_non_null(mesh->tangents);
        assert_int_equal(mesh->tangent_count, 4); // shared by the corners of a vertex
        for (uint32_t corner = 0; corner < 6; corner++)
            for (int i = 0; i < 4; i++)
                assert_true(fabsf(tangent_at(mesh, corner)[i] - rows[r].expected[i]) <= 1e-7f);
    }
    AUTO_SCENE bare = square_scene(NULL);
    assert_true(lam_scene_make_tangents(bare, NULL, NULL));
    assert_null(lam_scene_mesh(bare, 0)->tangents);
}

// A shape's own tangents, from its formula, equal the tangents from its texture coordinates, except for the error of
// the segments.
TEST(tangents_of_a_torus)
{
    lam_scene *exact = lam_scene_make(NULL), *made = lam_scene_make(NULL);
    assert_int_equal(lam_scene_add_shape(exact, "torus", NULL, NULL), 0);
    const lam_mesh *from = lam_scene_mesh(exact, 0);
    assert_non_null(from->tangents);
    assert_non_null(from->texcoords);
    lam_mesh bare = *from;
    bare.tangents = NULL;
    bare.tangent_indices = NULL;
    bare.tangent_count = 0;
    assert_int_equal(lam_scene_add_mesh(made, &bare, NULL), 0);
    assert_true(lam_scene_make_tangents(made, NULL, NULL));
    const lam_mesh *mesh = lam_scene_mesh(made, 0);
    double least = 1;
    for (uint32_t corner = 0; corner < 3 * mesh->triangle_count; corner++) {
        const uint32_t *by = from->tangent_indices ? from->tangent_indices : from->indices;
        const float *a = from->tangents + 4 * (size_t)(by ? by[corner] : corner), *b = tangent_at(mesh, corner);
        double dot = (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
        least = fmin(least, dot);
        assert_true(a[3] == b[3]);
    }
    assert_true(least >= 1 - 2e-3);
    // Existing tangents are kept.
    const float *kept = mesh->tangents;
    assert_true(lam_scene_make_tangents(made, NULL, NULL));
    assert_ptr_equal(lam_scene_mesh(made, 0)->tangents, kept);
    lam_scene_free(exact);
    lam_scene_free(made);
}

TEST(tangents_can_be_bounded)
{
    lam_error error;
    for (int i = 0; i < 2; i++) {
        static const float straight[] = {0, 0, 1, 0, 1, 1, 0, 1};
        AUTO_SCENE scene = square_scene(straight);
        lam_cancel cancel = {1};
        lam_control control = i ? (lam_control){.memory_limit_bytes = 16} : (lam_control){.cancel = &cancel};
        assert_false(lam_scene_make_tangents(scene, &control, &error));
        assert_int_equal(error.code, i ? LAM_LIMIT : LAM_CANCELLED);
        assert_null(lam_scene_mesh(scene, 0)->tangents);
    }
    assert_false(lam_scene_make_tangents(NULL, NULL, &error));
}
