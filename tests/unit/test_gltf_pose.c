// test_gltf_pose.c: glTF: animations at a time, morph targets and skins.
#include "test.h"
#include "gltf_document.h"

#define ASSET "\"asset\": {\"version\": \"2.0\"}"

// The file is built from arrays: each is a separate bufferView and accessor.
struct builder {
    struct document document;
    char views[4096], accessors[4096], json[12000];
    int count;
};

static int add_array(struct builder *b, int component, const char *type, int count, const void *bytes, size_t size)
{
    while (b->document.data.size % 4)
        put_u8(&b->document.data, 0);
    size_t at = strlen(b->views);
    snprintf(b->views + at, sizeof b->views - at, "%s{\"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu}",
             b->count ? ", " : "", b->document.data.size, size);
    at = strlen(b->accessors);
    snprintf(b->accessors + at, sizeof b->accessors - at,
             "%s{\"bufferView\": %d, \"componentType\": %d, \"normalized\": %s, \"count\": %d, \"type\": \"%s\"}",
             b->count ? ", " : "", b->count, abs(component), component < 0 ? "true" : "false", count, type);
    put(&b->document.data, bytes, size);
    return b->count++;
}

#define ADD_FLOATS(b, type, count, ...)                                                                                \
    add_array(b, 5126, type, count, (float[]){__VA_ARGS__}, sizeof((float[]){__VA_ARGS__}))

// Positions (accessor 0) of one triangle, and its normals (1).
static void start(struct builder *b)
{
    *b = (struct builder){0};
    ADD_FLOATS(b, "VEC3", 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    ADD_FLOATS(b, "VEC3", 3, 0, 0, 1, 0, 0, 1, 0, 0, 1);
}

static void complete(struct builder *b, const char *more)
{
    snprintf(b->json, sizeof b->json, "{" ASSET ", %s, %%B, \"bufferViews\": [%s], \"accessors\": [%s]}", more,
             b->views, b->accessors);
    make_text(&b->document, b->json);
}

static lam_scene *load_at(const struct builder *b, const char *animation, double time_s)
{
    return load_with(b->document.text, strlen(b->document.text), "a.gltf",
                     &(lam_load_params){.animation = animation, .time_s = time_s});
}

static void refuse_at(const struct builder *b, const char *animation, lam_code code, const char *sentence)
{
    lam_error error = {0};
    assert_null(lam_scene_load_memory(b->document.text, strlen(b->document.text), "a.gltf",
                                      &(lam_load_params){.animation = animation}, NULL, &error));
    assert_string_equal(error.text, sentence);
    assert_int_equal(error.code, code);
}

static void warn_at(const struct builder *b, const char *animation, const char *problem)
{
    char sentence[400];
    snprintf(sentence, sizeof sentence, "%s; drawn without it", problem);
    warn_once(b->document.text, strlen(b->document.text), "a.gltf", &(lam_load_params){.animation = animation},
              sentence);
}

#define MESH "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1}}]}]"

// --- animations

static lam_mat4 transform_at(const struct builder *b, double time_s)
{
    lam_scene *scene = load_at(b, "move", time_s);
    lam_mat4 m = lam_scene_object(scene, 0)->transform;
    lam_scene_free(scene);
    return m;
}

static void make_translation(struct builder *b, const char *interpolation)
{
    char json[1000];
    start(b);
    ADD_FLOATS(b, "SCALAR", 3, 1, 2, 4);
    if (strcmp(interpolation, "CUBICSPLINE") == 0)
        ADD_FLOATS(b, "VEC3", 9, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 4, 0, 0, 3, 0, 0, 1, 1, 1, 9, 9, 9, 0, 0, 0);
    else
        ADD_FLOATS(b, "VEC3", 3, 0, 0, 0, 4, 0, 8, 9, 9, 9);
    snprintf(json, sizeof json,
             "\"nodes\": [{\"mesh\": 0, \"translation\": [7, 7, 7]}], " MESH ", \"animations\": [{\"name\": \"other\", "
             "\"channels\": [], \"samplers\": []}, {\"name\": \"move\", \"channels\": [{\"sampler\": 0, \"target\": "
             "{\"node\": 0, "
             "\"path\": \"translation\"}}, {\"sampler\": 0, \"target\": {\"path\": \"pointer\"}}], \"samplers\": "
             "[{\"input\": 2, "
             "\"output\": 3, \"interpolation\": \"%s\"}]}]",
             interpolation);
    complete(b, json);
}

TEST(test_interpolation)
{
    struct builder b;
    make_translation(&b, "LINEAR");
    static const double linear[][3] = {{-5, 0, 0},    {1, 0, 0}, {1.25, 1, 2}, {2, 4, 8},
                                       {3, 6.5, 8.5}, {4, 9, 9}, {99, 9, 9}};
    for (size_t i = 0; i < sizeof linear / sizeof *linear; i++) {
        lam_mat4 m = transform_at(&b, linear[i][0]);
        assert_near(m.m[0][3], linear[i][1], 1e-12);
        assert_near(m.m[2][3], linear[i][2], 1e-12);
    }
    make_translation(&b, "STEP");
    static const double step[][2] = {{0, 0}, {1.9, 0}, {2, 4}, {3.9, 4}, {4, 9}, {5, 9}};
    for (size_t i = 0; i < sizeof step / sizeof *step; i++)
        assert_true(transform_at(&b, step[i][0]).m[0][3] == step[i][1]);
    make_translation(&b, "CUBICSPLINE");
    // From 0 at 1 s, leaving with (1, 0, 0) per second, to (4, 0, 0) at 2 s, arriving with (0, 2, 0).
    double t = 0.25, t2 = t * t, t3 = t2 * t;
    lam_mat4 m = transform_at(&b, 1.25);
    assert_near(m.m[0][3], (t3 - 2 * t2 + t) * 1 + (3 * t2 - 2 * t3) * 4, 1e-12);
    assert_near(m.m[1][3], (t3 - t2) * 2, 1e-12);
    // Two seconds long, so its tangents count twice.
    m = transform_at(&b, 2.5);
    assert_near(m.m[0][3],
                (2 * t3 - 3 * t2 + 1) * 4 + 2 * (t3 - 2 * t2 + t) * 3 + 2 * (t3 - t2) * 1 + (3 * t2 - 2 * t3) * 9,
                1e-12);
    // The pose of the file itself.
    lam_scene *scene = load_at(&b, NULL, 2);
    assert_true(lam_scene_object(scene, 0)->transform.m[0][3] == 7);
    lam_scene_free(scene);
    scene = load_at(&b, "1", 2); // by its number
    assert_true(lam_scene_object(scene, 0)->transform.m[0][3] == 4);
    lam_scene_free(scene);
    refuse_at(&b, "turn", LAM_BAD_ARGUMENT,
              "a.gltf: there is no animation 'turn'; expected one of 0 ('other'), 1 ('move')");
}

// Rotations take the shorter way, at constant speed; normalised shorts are read.
TEST(test_rotation)
{
    for (int kind = 0; kind < 3; kind++) {
        struct builder b;
        start(&b);
        ADD_FLOATS(&b, "SCALAR", 2, 0, 1);
        const float h = 0.70710678f;
        if (kind == 0)
            ADD_FLOATS(&b, "VEC4", 2, 0, 0, 0, 1, 0, 0, h, h); // a quarter turn about z
        else if (kind == 1)
            ADD_FLOATS(&b, "VEC4", 2, 0, 0, 0, 1, 0, 0, -h, -h); // the same rotation in its other form
        else
            add_array(&b, -5122, "VEC4", 2, (int16_t[]){0, 0, 0, 32767, 0, 0, 23170, 23170}, 16);
        complete(
            &b, "\"nodes\": [{\"mesh\": 0}], " MESH
                ", \"animations\": [{\"name\": \"move\", \"channels\": [{\"sampler\": 0, "
                "\"target\": {\"node\": 0, \"path\": \"rotation\"}}], \"samplers\": [{\"input\": 2, \"output\": 3}]}]");
        for (int i = 0; i <= 4; i++) {
            lam_mat4 m = transform_at(&b, i / 4.0);
            double angle = i / 4.0 * 1.5707963267948966;
            assert_near(m.m[0][0], cos(angle), 1e-4);
            assert_near(m.m[1][0], sin(angle), 1e-4);
            assert_near(m.m[2][2], 1, 1e-9);
        }
    }
}

// --- morph targets

#define MORPHED                                                                                                        \
    "\"meshes\": [{\"weights\": [0.5, 0], \"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1}, "        \
    "\"targets\": "                                                                                                    \
    "[{\"POSITION\": 2, \"NORMAL\": 3}, {\"POSITION\": 3}]}]}]"

static void make_morph(struct builder *b, const char *node, const char *more)
{
    char json[2000];
    start(b);
    ADD_FLOATS(b, "VEC3", 3, 0, 0, 2, 0, 0, 4, 8, 0, 0);
    ADD_FLOATS(b, "VEC3", 3, 1, 0, 0, 1, 0, 0, 1, 0, 0);
    ADD_FLOATS(b, "SCALAR", 2, 0, 1);
    add_array(b, -5121, "SCALAR", 4, (uint8_t[]){0, 0, 255, 51}, 4);
    snprintf(json, sizeof json, "\"nodes\": [{\"mesh\": 0}, {\"mesh\": 0%s}], " MORPHED "%s", node, more);
    complete(b, json);
}

TEST(test_morph)
{
    struct builder b;
    // With the mesh's weights, which both nodes share.
    make_morph(&b, "", "");
    lam_scene *scene = load_at(&b, NULL, 0);
    assert_int_equal(lam_scene_mesh_count(scene), 1);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_corner(mesh, 0, 0, 0, 0, 1);
    assert_corner(mesh, 0, 1, 1, 0, 2);
    assert_corner(mesh, 0, 2, 4, 1, 0);
    assert_true(mesh->normals[0] == 0.5f && mesh->normals[2] == 1);
    lam_scene_free(scene);
    // With a node's own weights; both targets.
    make_morph(&b, ", \"weights\": [1, 2]", "");
    scene = load_at(&b, NULL, 0);
    assert_int_equal(lam_scene_mesh_count(scene), 2);
    assert_corner(lam_scene_mesh(scene, 0), 0, 1, 1, 0, 2);
    assert_corner(lam_scene_mesh(scene, 1), 0, 1, 3, 0, 4);
    assert_corner(lam_scene_mesh(scene, 1), 0, 2, 10, 1, 0);
    lam_scene_free(scene);
    // Weights of 0 leave the mesh unchanged: the file's own bytes.
    make_morph(&b, ", \"weights\": [0, 0]", "");
    scene = load_at(&b, NULL, 0);
    assert_corner(lam_scene_mesh(scene, 1), 0, 1, 1, 0, 0);
    assert_true(lam_scene_mesh(scene, 1)->positions + 9 == lam_scene_mesh(scene, 1)->normals);
    lam_scene_free(scene);
    // Animated: at 0.5 s, half of the way from (0, 0) to (1, 0.2).
    make_morph(
        &b, "",
        ", \"animations\": [{\"channels\": [{\"sampler\": 0, \"target\": {\"node\": 1, \"path\": \"weights\"}}], "
        "\"samplers\": [{\"input\": 4, \"output\": 5}]}]");
    scene = load_at(&b, "0", 0.5);
    lam_vec3 p = corner_at(lam_scene_mesh(scene, 1), 0, 1);
    assert_near(p.x, 1.1, 1e-6);
    assert_near(p.z, 2, 1e-6);
    assert_corner(lam_scene_mesh(scene, 0), 0, 1, 1, 0, 2); // the other node keeps the mesh's weights
    lam_scene_free(scene);
}

// --- skins

// Two joints: the first moves by (10, 0, 0), and the second is rotated by 90° about z around its own position, (0, 1,
// 0).
static void make_skin(struct builder *b, const char *more, bool bytes, bool inverse)
{
    char json[2000];
    start(b);
    if (bytes) {
        add_array(b, 5121, "VEC4", 3, (uint8_t[]){0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 12);
        add_array(b, -5121, "VEC4", 3, (uint8_t[]){255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0}, 12);
    } else {
        add_array(b, 5123, "VEC4", 3, (uint16_t[]){0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 24);
        ADD_FLOATS(b, "VEC4", 3, 0.5f, 0, 0, 0, 1, 0, 0, 0, 0.4f, 1.6f, 0, 0); // sums that are not 1
    }
    ADD_FLOATS(b, "MAT4", 2, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1,
               0, 1);
    snprintf(
        json, sizeof json,
        "\"scenes\": [{\"nodes\": [0, 1]}], \"nodes\": [{\"mesh\": 0, \"skin\": 0, \"translation\": [50, 50, 50]}, "
        "{\"translation\": [10, 0, 0]}, {\"translation\": [0, 1, 0], \"rotation\": [0, 0, 0.70710678, 0.70710678]}], "
        "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1, \"JOINTS_0\": 2, "
        "\"WEIGHTS_0\": "
        "3}}]}], \"skins\": [{\"joints\": [1, 2]%s%s}]",
        inverse ? ", \"inverseBindMatrices\": 4" : "", more);
    complete(b, json);
}

static void assert_point(const lam_mesh *mesh, uint32_t corner, double x, double y, double z)
{
    lam_vec3 p = corner_at(mesh, 0, corner);
    assert_near(p.x, x, 1e-5);
    assert_near(p.y, y, 1e-5);
    assert_near(p.z, z, 1e-5);
}

TEST(test_skin)
{
    for (int bytes = 0; bytes < 2; bytes++) {
        struct builder b;
        make_skin(&b, "", bytes, true);
        lam_scene *scene = load_at(&b, NULL, 0);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        lam_mat4 identity = lam_mat4_identity(); // the node's own transform is ignored
        assert_memory_equal(&lam_scene_object(scene, 0)->transform, &identity, sizeof identity);
        assert_point(mesh, 0, 10, 0, 0);
        assert_point(mesh, 1, 1, 2, 0);                  // (1, −1) rotated: (1, 1), plus (0, 1)
        assert_point(mesh, 2, 0.2 * 10 + 0.8 * 0, 1, 0); // (0, 1) is the position of the second joint
        lam_scene_free(scene);
        make_skin(&b, "", bytes, false); // without matrices: only the matrices of the joints
        scene = load_at(&b, NULL, 0);
        assert_point(lam_scene_mesh(scene, 0), 1, 0, 2, 0);
        lam_scene_free(scene);
    }
}

// The inverse transpose of the blended matrix transforms normals.
TEST(test_skinned_normals)
{
    struct builder b = {0};
    ADD_FLOATS(&b, "VEC3", 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    ADD_FLOATS(&b, "VEC3", 3, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0);
    add_array(&b, 5121, "VEC4", 3, (uint8_t[]){0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 12);
    ADD_FLOATS(&b, "VEC4", 3, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0); // the last has no weight and uses the first joint's
    complete(
        &b,
        "\"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"mesh\": 0, \"skin\": 0}, {\"scale\": [2, -1, 1]}], \"meshes\": "
        "[{\"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1, \"JOINTS_0\": 2, \"WEIGHTS_0\": 3}}]}], "
        "\"skins\": [{\"joints\": [1]}]");
    AUTO_SCENE scene = load_at(&b, NULL, 0);
    const float *n = lam_scene_mesh(scene, 0)->normals;
    double length = sqrt(0.09 + 0.64);
    for (int i = 0; i < 3; i++) {
        assert_near((double)n[3 * i], 0.3 / length, 1e-6);
        assert_near((double)n[3 * i + 1], -0.8 / length, 1e-6);
    }
    assert_point(lam_scene_mesh(scene, 0), 1, 2, 0, 0);
    assert_point(lam_scene_mesh(scene, 0), 2, 0, -1, 0);
}

// --- what is wrong is left out, with one warning

TEST(test_errors)
{
    static const struct {
        const char *piece, *by, *sentence;
    } rows[] = {
        {"\"input\": 2", "\"inputs\": 2", "a.gltf: animations[1].samplers[0]: input is missing"},
        {"\"input\": 2", "\"input\": 1",
         "a.gltf: animations[1].samplers[0].input: found VEC3 of FLOAT, expected SCALAR of FLOAT"},
        {"\"output\": 3", "\"output\": 0", NULL}, // three elements also fit
        {"\"output\": 3", "\"output\": 2",
         "a.gltf: animations[1].samplers[0].output: found SCALAR of FLOAT, expected VEC3 of FLOAT"},
        {"LINEAR", "CUBICSPLINE", "a.gltf: animations[1].samplers[0].output: found 3 elements for 3 keys, expected 9"},
        {"LINEAR", "CUBIC",
         "a.gltf: animations[1].samplers[0].interpolation: found \"CUBIC\", expected STEP, LINEAR or CUBICSPLINE; did "
         "you mean 'CUBICSPLINE'?"},
        {"\"sampler\": 0", "\"sampler\": 1", "a.gltf: animations[1]: a channel names sampler 1 of 1"},
        {"\"node\": 0", "\"node\": 3",
         "a.gltf: animations[1].channels[0].target.node: found 3, expected a number from 0 to 0 (nodes)"},
        {"\"translation\": [7, 7, 7]", "\"matrix\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
         "a.gltf: animations[1].channels[0].target.node: node 0 has a matrix, expected translation, rotation and "
         "scale"},
    };
    struct builder b;
    char json[12000];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        make_translation(&b, "LINEAR");
        const char *at = strstr(b.json, rows[i].piece);
        assert_non_null(at);
        snprintf(json, sizeof json, "%.*s%s%s", (int)(at - b.json), b.json, rows[i].by, at + strlen(rows[i].piece));
        make_text(&b.document, json);
        if (rows[i].sentence)
            warn_at(&b, "move", rows[i].sentence);
        else
            lam_scene_free(load_at(&b, "move", 1));
    }
    make_skin(&b, "", true, true);
    b.document.data.bytes[72 + 4] = 2; // the second vertex's first joint
    make_text(&b.document, b.json);
    warn_at(&b, NULL,
            "a.gltf: meshes[0].primitives[0].attributes.JOINTS_0: element 1: found joint 2, expected one below 2");
    make_skin(&b, "", true, true);
    static const struct {
        const char *piece, *by, *sentence;
    } skins[] = {
        {"\"joints\": [1, 2]", "\"joints\": []", "a.gltf: skins[0].joints: expected a list of at least one node"},
        {"\"joints\": [1, 2]", "\"joints\": [1, 5]",
         "a.gltf: skins[0].joints[1]: found 5, expected a number from 0 to 2 (nodes)"},
        {"\"joints\": [1, 2]", "\"joints\": [1, 2, 0]",
         "a.gltf: skins[0].inverseBindMatrices: found 2 matrices, expected 3, one for each joint"},
        {"\"inverseBindMatrices\": 4", "\"inverseBindMatrices\": 0",
         "a.gltf: skins[0].inverseBindMatrices: found VEC3 of FLOAT, expected MAT4 of FLOAT"},
        {"\"JOINTS_0\": 2", "\"JOINTS_0\": 1",
         "a.gltf: meshes[0].primitives[0].attributes.JOINTS_0: found VEC3 of FLOAT, expected VEC4 of UNSIGNED_BYTE or "
         "UNSIGNED_SHORT"},
        {"\"WEIGHTS_0\": 3", "\"WEIGHTS_0\": 0",
         "a.gltf: meshes[0].primitives[0].attributes.WEIGHTS_0: found VEC3 of FLOAT, expected VEC4 of FLOAT, "
         "or of "
         "normalized UNSIGNED_BYTE or UNSIGNED_SHORT"},
    };
    for (size_t i = 0; i < sizeof skins / sizeof *skins; i++) {
        const char *at = strstr(b.json, skins[i].piece);
        assert_non_null(at);
        snprintf(json, sizeof json, "%.*s%s%s", (int)(at - b.json), b.json, skins[i].by, at + strlen(skins[i].piece));
        make_text(&b.document, json);
        warn_at(&b, NULL, skins[i].sentence);
    }
    make_morph(&b, "", "");
    const char *at = strstr(b.json, "{\"POSITION\": 2,");
    assert_non_null(at);
    snprintf(json, sizeof json, "%.*s{\"POSITION\": 4,%s", (int)(at - b.json), b.json,
             at + strlen("{\"POSITION\": 2,"));
    make_text(&b.document, json);
    warn_at(&b, NULL,
            "a.gltf: meshes[0].primitives[0].targets[0].POSITION: found 2 elements of SCALAR of FLOAT, expected 3 of "
            "VEC3 of "
            "FLOAT");
}

TEST(test_memory)
{
    struct builder b;
    make_skin(&b, "", true, true);
    check_allocations(b.document.text, strlen(b.document.text), "a.gltf");
    assert_same_for_threads(b.document.text, strlen(b.document.text), "a.gltf");
    make_morph(&b, ", \"weights\": [1, 2]", "");
    check_allocations(b.document.text, strlen(b.document.text), "a.gltf");
}
