// test_gltf_draco.c: primitives compressed by Draco: attributes by their ids, in the type of their accessors; every
// damaged or truncated buffer gives one error message. In a build without the decoder, files are refused or their
// uncompressed data is read.
#include "test.h"
#include "loading.h"

#include "gltf_meshes.h"

// A square of four vertices: attribute 7 is the positions, attribute 3 the texture coordinates as unsigned bytes;
// encoded by Draco's own encoder.
static const char compressed[] =
    "RFJBQ08CAgEBAAAABAIBAgAAAR//ARH/AREC/wAAAAAAAQAJAwAHAgEDAgIAAwEBAQEADwMBMC8BEAMAKIKYAAAA/P8AAAAAAP8/"
    "AAAAAAAAAAAAAAAAAAAAAIA/"
    "DgEBAQAJAwEgARATARADABSQBCALAAAAAMgAAAA=";
enum { COMPRESSED_BYTES = 122 };

static const char file[] =
    "{\"asset\": {\"version\": \"2.0\"}, %s \"nodes\": [{\"mesh\": 0}], \"meshes\": [{\"primitives\": "
    "[{\"attributes\": "
    "{\"POSITION\": 0, \"TEXCOORD_0\": 1}, \"indices\": 2, \"mode\": %d, \"extensions\": "
    "{\"KHR_draco_mesh_compression\": "
    "{\"bufferView\": 0, \"attributes\": {%s}}}}]}], \"accessors\": [{\"count\": %d, \"componentType\": 5126, "
    "\"type\": \"VEC3\"}, "
    "{\"count\": 4, \"componentType\": 5121, \"normalized\": true, \"type\": \"%s\"}, "
    "{\"count\": %d, \"componentType\": %d, \"type\": \"SCALAR\"}], \"bufferViews\": [{\"buffer\": 0, \"byteLength\": "
    "%d}], "
    "\"buffers\": [{\"byteLength\": 122, \"uri\": \"data:application/octet-stream;base64,%s\"}]}";

#define REQUIRED "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"],"
#define IDS      "\"POSITION\": 7, \"TEXCOORD_0\": 3"

struct made_of {
    const char *ids, *type;
    int mode, vertices, corners, component, bytes;
};
static const struct made_of good = {IDS, "VEC2", 4, 4, 6, 5121, COMPRESSED_BYTES};

static lam_scene *load_made(struct made_of m, const char *bytes, lam_error *error)
{
    char text[2000];
    snprintf(text, sizeof text, file, REQUIRED, m.mode, m.ids, m.vertices, m.type, m.corners, m.component, m.bytes,
             bytes);
    return lam_scene_load_memory(text, strlen(text), "a.gltf", NULL, NULL, error);
}

#if HAS_DRACO

TEST(decoded)
{
    static const int modes[] = {4, 5};
    for (int i = 0; i < 2; i++) {
        lam_error error = {0};
        struct made_of m = good;
        m.mode = modes[i];
        m.corners = i ? 4 : 6;
        m.component = i ? 5125 : 5121;
        lam_scene *scene = load_made(m, compressed, &error);
        SUCCEEDS(scene);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        assert_int_equal(mesh->vertex_count, 4);
        assert_int_equal(mesh->triangle_count, 2);
        bool seen[4] = {false};
        for (int v = 0; v < 4; v++) {
            static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}};
            static const float st[4][2] = {{0, 0}, {200, 0}, {200, 100}, {0, 100}};
            const float *p = mesh->positions + 3 * v;
            for (int k = 0; k < 4; k++) {
                float off = 0;
                for (int axis = 0; axis < 3; axis++)
                    off += p[axis] > corners[k][axis] ? p[axis] - corners[k][axis] : corners[k][axis] - p[axis];
                if (off > 1e-3f)
                    continue;
                seen[k] = true;
                for (int axis = 0; axis < 2; axis++)
                    assert_true(mesh->texcoords[2 * v + axis] == st[k][axis] / 255.0f);
            }
        }
        assert_true(seen[0] && seen[1] && seen[2] && seen[3]);
        lam_scene_free(scene);
    }
}

static void refuse_made(struct made_of m, const char *sentence)
{
    lam_error error = {0};
    assert_null(load_made(m, compressed, &error));
    assert_int_equal(error.code, LAM_CANNOT_READ);
    assert_string_equal(error.text, sentence);
}

#define PLACE "a.gltf: meshes[0].primitives[0]."
#define HERE  PLACE "extensions.KHR_draco_mesh_compression"

TEST(wrong)
{
    struct made_of m = good;
    m.ids = "\"POSITION\": 8";
    refuse_made(m, HERE ".attributes.POSITION: the compressed bytes are damaged: there is no such attribute");
    m.ids = "\"POSITION\": -1";
    refuse_made(m, HERE ".attributes.POSITION: found -1, expected the number of an attribute");
    m.ids = "\"NORMAL\": 7";
    refuse_made(m, HERE ".attributes.NORMAL: the primitive has no attribute of this name");
    m = good;
    m.vertices = 5;
    refuse_made(m, HERE ".attributes.POSITION: the compressed mesh has 4 vertices, expected 5, the accessor's count");
    m = good;
    m.type = "VEC3";
    refuse_made(
        m,
        HERE ".attributes.TEXCOORD_0: the compressed bytes are damaged: it has 2 numbers for each vertex, expected 3");
    m = good;
    m.corners = 9;
    refuse_made(m, PLACE "indices: the compressed mesh has 6 corners, expected 9, the accessor's count");
    m = good;
    m.mode = 6;
    refuse_made(m, PLACE "mode: found 6, expected 4 or 5 for a compressed mesh");
}

static int value_of(char c)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    return (int)(strchr(letters, c) - letters);
}

static void encode(const uint8_t *bytes, int count, char *out)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < count; i += 3) {
        unsigned group = (unsigned)bytes[i] << 16 | (i + 1 < count ? (unsigned)bytes[i + 1] << 8 : 0) |
                         (i + 2 < count ? bytes[i + 2] : 0);
        for (int k = 0; k < 4; k++)
            *out++ = i + k - 1 < count || k < 2 ? letters[group >> (18 - 6 * k) & 63] : '=';
    }
    *out = 0;
}

// Every truncation and every changed byte gives a mesh, or one error message that names the primitive.
TEST(damaged)
{
    uint8_t bytes[COMPRESSED_BYTES + 3];
    int refused = 0;
    for (int i = 0; i < COMPRESSED_BYTES; i++) {
        unsigned group = 0;
        for (int k = 0; k < 4; k++) {
            char c = compressed[i / 3 * 4 + k];
            group = group << 6 | (c == '=' ? 0 : (unsigned)value_of(c));
        }
        bytes[i] = (uint8_t)(group >> (16 - 8 * (i % 3)));
    }
    for (int i = 0; i < 5 * COMPRESSED_BYTES; i++) {
        static const uint8_t changes[] = {1, 0x80, 0xff, 0x24};
        char text[400];
        uint8_t changed[sizeof bytes];
        lam_error error = {0};
        struct made_of m = good;
        memcpy(changed, bytes, sizeof bytes);
        if (i < COMPRESSED_BYTES)
            m.bytes = i ? i : 1;
        else
            changed[i % COMPRESSED_BYTES] ^= changes[i / COMPRESSED_BYTES - 1];
        encode(changed, COMPRESSED_BYTES, text);
        lam_scene *scene = load_made(m, text, &error);
        if (!scene) {
            refused++;
            assert_true(error.code == LAM_CANNOT_READ || error.code == LAM_LIMIT);
            if (error.code == LAM_CANNOT_READ && strncmp(error.text, PLACE, strlen(PLACE)) != 0)
                fail_msg("%s", error.text);
            assert_null(strchr(error.text, '\n'));
        }
        lam_scene_free(scene);
    }
    assert_true(refused > COMPRESSED_BYTES);
}

#else

TEST(missing)
{
    lam_error error = {0};
    assert_null(load_made(good, compressed, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_string_equal(
        error.text, "a.gltf: is compressed by KHR_draco_mesh_compression, and its decoder is not installed (the module "
                    "lambent-draco.so, and Debian's package libdraco7)");
}

#endif

#if HAS_DRACO

// A file of some kilobytes with 100 attributes of 60 numbers for each of 6000 vertices, all zero, which the coder
// compresses to no bits; each takes 2.9 MB in Draco's memory.
enum { FACES = 2000, VERTICES = 3 * FACES, ATTRIBUTES = 100, BOMB_BYTES = 6200 };

static size_t make_bomb(uint8_t *out)
{
    // All symbols are the same: the encoding, bits, their number, their probability (4096 of 4096), bytes.
    static const uint8_t symbols[] = {1, 1, 1, 1, 64, 1, 0};
    static const uint8_t head[] = {
        'D',           'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, (FACES & 127) | 128, FACES >> 7, (VERTICES & 127) | 128,
        VERTICES >> 7, 0};
    uint8_t *at = out;
    memset(out, 0, BOMB_BYTES); // Draco requires three bytes for each triangle, used or not
    memcpy(at, head, sizeof head);
    at += sizeof head;
    memcpy(at, symbols, sizeof symbols);
    at += sizeof symbols;
    *at++ = 1; // decoder
    *at++ = ATTRIBUTES;
    for (int i = 0; i < ATTRIBUTES; i++) { // position, then others: type, unsigned 32 bits, width, not normalized, id
        const uint8_t attribute[] = {i ? 4 : 0, 6, i ? 60 : 3, 0, (uint8_t)i};
        memcpy(at, attribute, sizeof attribute);
        at += sizeof attribute;
    }
    memset(at, 1, ATTRIBUTES); // integers
    at += ATTRIBUTES;
    for (int i = 0; i < ATTRIBUTES; i++) { // unpredicted values; compressed
        *at++ = 0xfe;
        *at++ = 1;
        memcpy(at, symbols, sizeof symbols);
        at += sizeof symbols;
    }
    return at - out < BOMB_BYTES ? BOMB_BYTES : 0;
}

static lam_scene *load_bomb(const lam_control *control, lam_error *error)
{
    static uint8_t glb[12 + 8 + 800 + 8 + BOMB_BYTES];
    char text[801];
    int length = snprintf(
        text, sizeof text,
        "{\"asset\": {\"version\": \"2.0\"}, " REQUIRED " \"nodes\": [{\"mesh\": 0}], \"meshes\": [{\"primitives\": "
        "[{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, \"extensions\": {\"KHR_draco_mesh_compression\": "
        "{\"bufferView\": 0, \"attributes\": {\"POSITION\": 0}}}}]}], \"accessors\": [{\"count\": %d, "
        "\"componentType\": 5126, \"type\": \"VEC3\"}, {\"count\": %d, \"componentType\": 5125, \"type\": "
        "\"SCALAR\"}], "
        "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": %d}], \"buffers\": [{\"byteLength\": %d}]}",
        VERTICES, 3 * FACES, BOMB_BYTES, BOMB_BYTES);
    assert_in_range(length, 1, 800);
    memset(text + length, ' ', (size_t)(800 - length));
    const uint32_t head[] = {0x46546c67, 2, sizeof glb, 800, 0x4e4f534a}, second[] = {BOMB_BYTES, 0x004e4942};
    memcpy(glb, head, sizeof head);
    memcpy(glb + sizeof head, text, 800);
    memcpy(glb + sizeof head + 800, second, sizeof second);
    assert_int_equal(make_bomb(glb + sizeof head + 800 + sizeof second), BOMB_BYTES);
    return lam_scene_load_memory(glb, sizeof glb, "bomb.glb", NULL, control, error);
}

// AddressSanitizer ends a C program whose first C++ library is loaded later and throws, because it has not found the
// function.
#if defined __has_feature
#if __has_feature(address_sanitizer)
#define CANNOT_THROW
#endif
#endif
#if defined __SANITIZE_ADDRESS__
#define CANNOT_THROW
#endif

static void skip_if_it_cannot_throw(void)
{
#ifdef CANNOT_THROW
    print_message("AddressSanitizer ends programs whose loaded libraries throw: Draco's errors were not tested\n");
    skip();
#endif
}

// Draco's memory is counted during decoding: exceeding the limit is an error, whatever the header claimed.
TEST(memory_counted)
{
    lam_error error = {0};
    lam_scene *scene = load_bomb(&(lam_control){.memory_limit_bytes = 1000000000}, &error);
    SUCCEEDS(scene);
    assert_int_equal(lam_scene_triangle_count(scene), FACES);
    lam_scene_free(scene);
    skip_if_it_cannot_throw();
    assert_null(load_bomb(&(lam_control){.memory_limit_bytes = 100000000}, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    double limit, used, more;
    assert_int_equal(sscanf(error.text, "the memory limit of %lf MB is reached: %lf MB in use, %lf MB more needed",
                            &limit, &used, &more),
                     3);
    assert_true(limit == 100 && used > 90 && used <= 100 && used + more > 100 && more < 10);
}

// 36 million numbers take longer than the limit, so decoding ends early.
TEST(too_long)
{
    skip_if_it_cannot_throw();
    lam_error error = {0};
    assert_null(load_bomb(&(lam_control){.time_limit_s = 0.01}, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_string_equal(error.text, "the time limit of 0.01 s is over");
}

#endif

#define CLAIM(...) draco_header_read((const uint8_t[]){__VA_ARGS__}, sizeof((uint8_t[]){__VA_ARGS__}), &claim)

TEST(claims)
{
    struct draco_claim claim;
    // Sequential: faces, points; seven bits per byte.
    assert_true(CLAIM('D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 0x80, 0x01, 0xff, 0xff, 0xff, 0xff, 0x0f));
    assert_true(claim.faces == 128 && claim.points == UINT32_MAX);
    // Older: 32 bits.
    assert_true(CLAIM('D', 'R', 'A', 'C', 'O', 2, 1, 1, 0, 0, 0, 1, 2, 0, 0, 3, 0, 0, 1));
    assert_true(claim.faces == 513 && claim.points == 16777219);
    // Edgebreaker: the encoding, points, faces; in older files, the vertices of splits come first.
    assert_true(CLAIM('D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0, 2, 7, 9));
    assert_true(claim.faces == 9 && claim.points == 7);
    assert_true(CLAIM('D', 'R', 'A', 'C', 'O', 2, 1, 1, 1, 0, 0, 0, 5, 7, 9));
    assert_true(claim.faces == 9 && claim.points == 7);
    assert_true(CLAIM('D', 'R', 'A', 'C', 'O', 1, 2, 1, 1, 0, 0, 0, 5, 0, 0, 0, 7, 0, 0, 0, 9, 0, 0, 0));
    assert_true(claim.faces == 9 && claim.points == 7);
    // Metadata: one attribute's with one entry, and the mesh's with a nested one.
    assert_true(CLAIM('D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0x80, 1, 4, 1, 2, 'a', 'b', 3, 1, 2, 3, 0, 0, 1, 1, 'x',
                      0, 0, 6, 8));
    assert_true(claim.faces == 6 && claim.points == 8);
    assert_true(draco_claim_bytes(&claim) >= 6 * 36 + 8 * 24);
    // Unsupported files: a point cloud, a truncated file, a number of more than 32 bits, metadata nested in itself.
    assert_false(CLAIM('D', 'R', 'A', 'C', 'O', 2, 2, 0, 0, 0, 0, 1, 1));
    assert_false(CLAIM('D', 'R', 'A', 'C', 'O', 2, 2, 1, 2, 0, 0, 1, 1));
    assert_false(CLAIM('D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 0x80));
    assert_false(CLAIM('D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0x1f, 1));
    assert_false(CLAIM('D', 'R', 'A', 'C', 'X', 2, 2, 1, 0, 0, 0, 1, 1));
    uint8_t nested[200] = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0x80, 0};
    for (int i = 12; i < 200; i += 3)
        nested[i + 1] = 1; // no entries, one nested item with a name of 0 bytes
    assert_false(draco_header_read(nested, sizeof nested, &claim));
    for (size_t size = 0; size < 12; size++)
        assert_false(draco_header_read(nested, size, &claim));
}
