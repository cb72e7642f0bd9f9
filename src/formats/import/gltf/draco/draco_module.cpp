// draco_module.cpp: decodes meshes with Draco (https://google.github.io/draco/) for the glTF importer (draco_module.h).
#include "draco_module.h"

#include <draco/compression/decode.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <malloc.h>
#include <memory>
#include <new>

namespace
{

// --- counting Draco's memory

// The memory that the current thread's decoding has allocated so far, and its limit. If another library of the process
// replaces operators new and delete before this one (a C++ program that links Lambent, or a sanitizer), no memory is
// counted. The only limit is then the estimate from the header.
struct account {
    draco_memory *memory;
    size_t taken;
};

// The account of the current thread. Only a pointer is thread_local, in the static storage of each thread
// (initial-exec), because other thread_local data allocate memory on first use.
thread_local account *counting __attribute__((tls_model("initial-exec"))) = nullptr;

void *take(std::size_t size)
{
    account *own = counting;
    if (own && own->memory->grant && size > own->memory->granted - own->taken) {
        constexpr std::size_t STEP = 1 << 20;
        const std::size_t missing = size - (own->memory->granted - own->taken);
        if (missing > SIZE_MAX - STEP || !own->memory->grant(own->memory, (missing + STEP - 1) / STEP * STEP))
            return nullptr;
    }
    void *block = std::malloc(size ? size : 1);
    // Counts the size of the block including the C library's padding, up to the granted memory. The uncounted rest is
    // smaller than STEP.
    if (own && block) {
        const std::size_t held = malloc_usable_size(block), left = own->memory->granted - own->taken;
        own->taken += held < left ? held : left;
    }
    return block;
}

void give_back(void *block)
{
    if (counting && block) {
        const std::size_t held = malloc_usable_size(block);
        counting->taken -= held < counting->taken ? held : counting->taken;
    }
    std::free(block);
}

class count_here
{
  public:
    explicit count_here(draco_memory *memory) : own{memory, 0} { counting = memory ? &own : nullptr; }
    ~count_here() { counting = nullptr; }
    count_here(const count_here &) = delete;
    count_here &operator=(const count_here &) = delete;

  private:
    account own;
};

// --- decoding

constexpr int DECODED = 1, DAMAGED = 0, NO_MEMORY = -1;

int damaged(char *reason, const char *text)
{
    std::snprintf(reason, DRACO_REASON_SIZE, "%s", text);
    return DAMAGED;
}

int decode(const uint8_t *bytes, size_t size, draco_memory *memory, void **mesh, uint32_t *vertices,
           uint32_t *triangles, char *reason)
{
    // The C++ runtime allocates a thread's exception data on first use, and the C library ends the program if that
    // fails. This call allocates the data early, while memory is available.
    volatile int pending = std::uncaught_exceptions(); // volatile, so that the compiler keeps the call
    (void)pending;
    const count_here here(memory);
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char *>(bytes), size);
        auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
        if (!type.ok())
            return damaged(reason, type.status().error_msg());
        if (type.value() != draco::TRIANGULAR_MESH)
            return damaged(reason, "they contain no triangles");
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
                    return damaged(reason, "a triangle refers to a vertex that does not exist");
        *mesh = own.release();
        return DECODED;
    } catch (const std::bad_alloc &) {
        return NO_MEMORY;
    } catch (const std::exception &e) {
        return damaged(reason, e.what());
    } catch (...) {
        return damaged(reason, "the decoder failed");
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
        switch (component) { // component types of glTF
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
        return damaged(reason, "the decoder failed");
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

// These operators serve this shared object and Draco's library, which it loaded. They use malloc and free, so that
// another operator delete may free blocks from this operator new, and vice versa.
void *operator new(std::size_t size)
{
    void *block = take(size);
    if (!block)
        throw std::bad_alloc();
    return block;
}

void *operator new[](std::size_t size) { return operator new(size); }
void operator delete(void *block) noexcept { give_back(block); }
void operator delete[](void *block) noexcept { give_back(block); }
void operator delete(void *block, std::size_t) noexcept { give_back(block); }
void operator delete[](void *block, std::size_t) noexcept { give_back(block); }

extern "C" __attribute__((visibility("default"))) const draco_functions *lambent_draco_functions(void)
{
    return &functions;
}
