// test_exr.c: writing, reading and recognising EXR pictures.
#include "test.h"

#include <lambent/image.h>

static lam_image noise(int width, int height, uint32_t seed)
{
    lam_image image;
    assert_true(lam_image_make(&image, width, height, LAM_RGBA32F, NULL));
    float *p = image.pixels;
    for (int i = 0; i < width * height * 4; i++) {
        seed = seed * 1664525u + 1013904223u;
        p[i] = (float)(seed >> 8) * 0x1p-20f - 4.0f;
    }
    return image;
}

// Skips the test with the reason if OpenEXR is missing.
static bool encode(const lam_layer *layers, int count, lam_bytes *out)
{
    lam_error error = {0};
    if (lam_image_encode_layers(layers, count, out, &error))
        return true;
    if (error.code != LAM_UNSUPPORTED)
        fail_msg("%s", error.text);
    assert_non_null(strstr(error.text, "libopenexr"));
    print_message("%s\n", error.text);
    skip();
    return false;
}

static bool contains(lam_bytes bytes, const char *text)
{
    return memmem(bytes.data, bytes.size, text, strlen(text) + 1) != NULL; // including its end
}

static void load(lam_image *image, const void *bytes, size_t size, lam_error *error, bool good)
{
    char path[] = "/tmp/lambent-exr-XXXXXX";
    int file = mkstemp(path);
    assert_true(file >= 0 && write(file, bytes, size) == (ssize_t)size);
    close(file);
    bool ok = lam_image_load(image, path, NULL, error);
    unlink(path);
    if (ok != good)
        fail_msg("%s", ok ? "was read" : error->text);
}

TEST(test_round)
{
    static const int sizes[][2] = {{1, 1}, {37, 50}, {3, 16}, {130, 17}};
    for (int i = 0; i < 4; i++) {
        lam_image image = noise(sizes[i][0], sizes[i][1], 7), back;
        lam_bytes first, second;
        lam_error error = {0};
        if (!encode(&(lam_layer){.image = &image}, 1, &first))
            return;
        assert_true(lam_image_encode(&image, "exr", NULL, &second, &error));
        assert_int_equal(first.size, second.size);
        assert_memory_equal(first.data, second.data, first.size);
        load(&back, first.data, first.size, &error, true);
        assert_true(back.width == image.width && back.height == image.height && back.format == LAM_RGBA32F);
        assert_memory_equal(back.pixels, image.pixels, (size_t)image.width * (size_t)image.height * 16);
        for (size_t cut = 0; cut < first.size;
             cut += 1 + first.size / 40) { // truncated files: an error or, in the last chunk, pixels
            AUTO_IMAGE part = {0};
            char path[] = "/tmp/lambent-exr-XXXXXX";
            int file = mkstemp(path);
            assert_true(file >= 0 && write(file, first.data, cut) == (ssize_t)cut);
            close(file);
            lam_image_load(&part, path, NULL, &error);
            unlink(path);
        }
        lam_image_free(&image);
        lam_image_free(&back);
        lam_bytes_free(&first);
        lam_bytes_free(&second);
    }
}

static lam_layer layer(const char *name, const lam_image *image, const char *channels)
{
    return (lam_layer){.name = name, .image = image, .channels = channels};
}

TEST(test_layers)
{
    lam_image picture = noise(20, 40, 1), light = noise(20, 40, 2), back;
    const lam_layer layers[] = {layer("diffuse", &light, NULL), layer(NULL, &picture, NULL),
                                layer("depth", &light, "Z"), layer("n.l", &light, "Y")};
    lam_bytes bytes;
    lam_error error = {0};
    if (!encode(layers, 4, &bytes))
        return;
    static const char *const names[] = {"R", "G", "B", "A", "diffuse.R", "diffuse.G", "diffuse.B", "depth.Z", "n.l.Y"};
    for (int i = 0; i < 9; i++)
        assert_true(contains(bytes, names[i]));
    assert_false(contains(bytes, "diffuse.A"));
    load(&back, bytes.data, bytes.size, &error, true);
    assert_memory_equal(back.pixels, picture.pixels, 20 * 40 * 16);
    lam_image_free(&back);
    lam_bytes_free(&bytes);
    // Without the picture, the file contains nothing readable as a picture.
    assert_true(lam_image_encode_layers(layers, 1, &bytes, &error));
    load(&back, bytes.data, bytes.size, &error, false);
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    lam_bytes_free(&bytes);
    lam_image_free(&picture);
    lam_image_free(&light);
}

TEST(test_wrong)
{
    lam_image image = noise(4, 4, 1), other = noise(4, 5, 1), bytes_image;
    assert_true(lam_image_make(&bytes_image, 4, 4, LAM_RGBA8, NULL));
    lam_bytes bytes;
    lam_error error;
    const lam_layer twice[] = {layer("a", &image, NULL), layer("a", &image, "GX")};
    const lam_layer sizes[] = {layer("a", &image, NULL), layer("b", &other, NULL)};
    const lam_layer format = layer("a", &bytes_image, NULL), letters = layer("a", &image, "RGBAX");
    assert_false(lam_image_encode_layers(sizes, 2, &bytes, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_false(lam_image_encode_layers(&format, 1, &bytes, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_false(lam_image_encode_layers(NULL, 1, &bytes, &error));
    if (lam_image_encode_layers(twice, 1, &bytes, &error)) { // OpenEXR is installed
        lam_bytes_free(&bytes);
        assert_false(lam_image_encode_layers(twice, 2, &bytes, &error));
        assert_non_null(strstr(error.text, "a.G"));
        assert_false(lam_image_encode_layers(&letters, 1, &bytes, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    }
    lam_image_free(&image);
    lam_image_free(&other);
    lam_image_free(&bytes_image);
}
