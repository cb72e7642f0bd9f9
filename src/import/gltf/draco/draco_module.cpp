// draco_module.cpp: meshes decoded by Draco (https://google.github.io/draco/), for the importer of glTF (draco_module.h).
#include "draco_module.h"

#include <draco/compression/decode.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <new>

namespace
{

constexpr int DECODED = 1, DAMAGED = 0, NO_MEMORY = -1;

int damaged(char *reason, const char *text)
{
    std::snprintf(reason, DRACO_REASON_SIZE, "%s", text);
    return DAMAGED;
}

int decode(const uint8_t *bytes, size_t size, void **mesh, uint32_t *vertices, uint32_t *triangles, char *reason)
{
    // A thread's data of the C++ runtime are made by its first exception; without memory for them the C library ends the
    // program. Here they are made while there still is some.
    volatile int pending = std::uncaught_exceptions(); // volatile: it is called, whoever needs the number
    (void)pending;
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char *>(bytes), size);
        auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
        if (!type.ok())
            return damaged(reason, type.status().error_msg());
        if (type.value() != draco::TRIANGULAR_MESH)
            return damaged(reason, "they hold no triangles");
        draco::Decoder decoder;
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok())
            return damaged(reason, decoded.status().error_msg());
        std::unique_ptr<draco::Mesh> own = std::move(decoded).value();
        *vertices = own->num_points();
        *triangles = own->num_faces();
        for (draco::FaceIndex f(0); f < own->num_faces(); ++f)
            for (const draco::PointIndex &corner : own->face(f))
                if (corner.value() >= own->num_points())
                    return damaged(reason, "a triangle names a vertex that there is not");
        *mesh = own.release();
        return DECODED;
    } catch (const std::bad_alloc &) {
        return NO_MEMORY;
    } catch (const std::exception &e) {
        return damaged(reason, e.what());
    } catch (...) {
        return damaged(reason, "the decoder gave up");
    }
}

template <typename T> bool copy(const draco::PointAttribute &attribute, uint32_t count, int width, void *out)
{
    T *to = static_cast<T *>(out);
    for (draco::PointIndex i(0); i < count; ++i, to += width) {
        const draco::AttributeValueIndex value = attribute.mapped_index(i);
        if (value.value() >= attribute.size() || !attribute.ConvertValue<T>(value, static_cast<int8_t>(width), to))
            return false;
    }
    return true;
}

int attribute(const void *mesh, uint32_t id, int component, int width, void *out, char *reason)
{
    try {
        const auto *own = static_cast<const draco::Mesh *>(mesh);
        const draco::PointAttribute *found = own->GetAttributeByUniqueId(id);
        if (!found)
            return damaged(reason, "there is no such attribute");
        if (found->num_components() != width) {
            std::snprintf(reason, DRACO_REASON_SIZE, "it has %d numbers for each vertex, expected %d",
                          static_cast<int>(found->num_components()), width);
            return DAMAGED;
        }
        bool done = false;
        switch (component) { // of glTF
        case 5120:
            done = copy<int8_t>(*found, own->num_points(), width, out);
            break;
        case 5121:
            done = copy<uint8_t>(*found, own->num_points(), width, out);
            break;
        case 5122:
            done = copy<int16_t>(*found, own->num_points(), width, out);
            break;
        case 5123:
            done = copy<uint16_t>(*found, own->num_points(), width, out);
            break;
        case 5125:
            done = copy<uint32_t>(*found, own->num_points(), width, out);
            break;
        case 5126:
            done = copy<float>(*found, own->num_points(), width, out);
            break;
        }
        return done ? DECODED : damaged(reason, "a value does not fit the type of the accessor");
    } catch (const std::bad_alloc &) {
        return NO_MEMORY;
    } catch (...) {
        return damaged(reason, "the decoder gave up");
    }
}

void triangles(const void *mesh, uint32_t *out)
{
    const auto *own = static_cast<const draco::Mesh *>(mesh);
    for (draco::FaceIndex f(0); f < own->num_faces(); ++f)
        for (const draco::PointIndex &corner : own->face(f))
            *out++ = corner.value();
}

void free_mesh(void *mesh) { delete static_cast<draco::Mesh *>(mesh); }

const draco_functions functions = {DRACO_MODULE_VERSION, decode, attribute, triangles, free_mesh};

} // namespace

extern "C" __attribute__((visibility("default"))) const draco_functions *lambent_draco_functions(void)
{
    return &functions;
}
