// target_3mf.c: fuzz target for 3MF. An input is the text of the model part, which the target packs; "%%" on a separate
// line begins another part, 3D/second.model. An input that begins like a ZIP archive is read unchanged.
#include "target.h"

#include <string.h>

enum { PACKAGE_BYTES = 1 << 20 };
static uint8_t package[PACKAGE_BYTES];

struct writer {
    size_t size, list_size;
    uint8_t list[1024];
    unsigned count;
};

static uint32_t checksum(const uint8_t *bytes, size_t size)
{
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

static uint8_t *put(uint8_t *at, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        *at++ = (uint8_t)(value >> 8 * i);
    return at;
}

// The fields that the header of a file and its row in the list of entries share.
static uint8_t *put_common(uint8_t *at, const char *name, const uint8_t *bytes, size_t size)
{
    at = put(at, 20, 2); // version
    at = put(at, 0, 8);  // flags, stored, time
    at = put(at, checksum(bytes, size), 4);
    at = put(at, (uint32_t)size, 4);
    at = put(at, (uint32_t)size, 4);
    at = put(at, (uint32_t)strlen(name), 2);
    return put(at, 0, 2); // extra field
}

static void add_file(struct writer *out, const char *name, const uint8_t *bytes, size_t size)
{
    size_t offset = out->size, length = strlen(name);
    uint8_t *at = put_common(put(package + offset, 0x04034b50, 4), name, bytes, size);
    memcpy(at, name, length);
    if (size)
        memcpy(at + length, bytes, size);
    out->size = (size_t)(at - package) + length + size;
    at = put_common(put(put(out->list + out->list_size, 0x02014b50, 4), 20, 2), name, bytes, size);
    at = put(put(at, 0, 8), 0, 2); // comment, disk, attributes
    at = put(at, 0, 2);
    at = put(at, (uint32_t)offset, 4);
    memcpy(at, name, length);
    out->list_size = (size_t)(at - out->list) + length;
    out->count++;
}

static void end_package(struct writer *out)
{
    size_t offset = out->size;
    memcpy(package + offset, out->list, out->list_size);
    uint8_t *at = put(put(package + offset + out->list_size, 0x06054b50, 4), 0, 4);
    at = put(put(at, out->count, 2), out->count, 2);
    at = put(put(at, (uint32_t)out->list_size, 4), (uint32_t)offset, 4);
    out->size = (size_t)(put(at, 0, 2) - package);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char relationships[] =
        "<Relationships xmlns='http://schemas.openxmlformats.org/package/2006/relationships'><Relationship "
        "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel' Target='/3D/3dmodel.model' Id='r'/>"
        "</Relationships>";
    static const char border[] = "\n%%\n";
    static const uint8_t picture[] = "P6 1 1 255\n\1\2\3";
    if (size >= 4 && memcmp(data, "PK\3\4", 4) == 0) {
        load_model(data, size, "fuzz.3mf", NULL, NULL, NULL);
        return 0;
    }
    if (size > PACKAGE_BYTES / 2)
        return 0;
    struct writer out = {0};
    const uint8_t *second = size ? memmem(data, size, border, sizeof border - 1) : NULL;
    size_t first = second ? (size_t)(second - data) : size, rest = second ? size - first - (sizeof border - 1) : 0;
    add_file(&out, "_rels/.rels", (const uint8_t *)relationships, sizeof relationships - 1);
    add_file(&out, "3D/3dmodel.model", data, first);
    if (second)
        add_file(&out, "3D/second.model", second + sizeof border - 1, rest);
    add_file(&out, "3D/a.ppm", picture, sizeof picture - 1);
    end_package(&out);
    load_model(package, out.size, "fuzz.3mf", NULL, NULL, NULL);
    return 0;
}
