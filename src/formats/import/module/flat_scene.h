// flat_scene.h: writes a scene as binary glTF for the modules (import_module.h). C++. The glTF importer checks what a
// module writes, so a module only keeps the arrays of a mesh equally long.
#ifndef FLAT_SCENE_H
#define FLAT_SCENE_H

#include "import_module.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <jansson.h>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace flat
{

// --- JSON as text

using members = std::vector<std::pair<std::string, std::string>>;
using list = std::vector<std::string>;

// Members without a value are omitted.
inline std::string object(const members &all)
{
    std::string out;
    for (const auto &one : all)
        if (!one.second.empty())
            out += (out.empty() ? "{\"" : ",\"") + one.first + "\":" + one.second;
    return out.empty() ? "{}" : out + "}";
}

inline std::string array(const list &items)
{
    std::string out;
    for (const std::string &item : items)
        out += (out.empty() ? "[" : ",") + item;
    return out.empty() ? "[]" : out + "]";
}

// JSON has neither NaN nor infinity; they become 0.
inline std::string number(double value)
{
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", std::isfinite(value) ? value : 0.0);
    return digits;
}

template <typename T> std::string numbers(const T *values, size_t count)
{
    list out;
    for (size_t i = 0; i < count; i++)
        out.push_back(number(static_cast<double>(values[i])));
    return array(out);
}

// A name; "" if it is empty. Without UTF-8, bytes are read as Latin-1, since old formats have no encoding.
inline std::string text(const char *name)
{
    std::string latin;
    for (const char *at = name; *at; at++) {
        const auto byte = static_cast<unsigned char>(*at);
        latin += byte < 0x80
                     ? std::string(1, *at)
                     : std::string{static_cast<char>(0xc0 | byte >> 6), static_cast<char>(0x80 | (byte & 0x3f))};
    }
    json_t *value = json_string(name) ? json_string(name) : json_string(latin.c_str());
    char *json = *name && value ? json_dumps(value, JSON_ENCODE_ANY) : nullptr;
    return json ? json : "";
}

// --- the scene

enum { U8 = 5121, U16 = 5123, U32 = 5125, F32 = 5126 };

// Appends to a list and returns the index.
inline std::string add(list &to, const std::string &json)
{
    to.push_back(json);
    return std::to_string(to.size() - 1);
}

class scene
{
  public:
    list nodes, meshes, materials, textures, images, cameras, lights, skins, animations;
    std::string root = "0", generator; // the root node; the program that wrote the file
    double unit_m = 0;                 // metres per unit; 0: unknown

    std::string view(const void *data, size_t size)
    {
        binary.resize((binary.size() + 3) & ~static_cast<size_t>(3));
        const std::string offset = std::to_string(binary.size());
        const auto *bytes = static_cast<const uint8_t *>(data);
        binary.insert(binary.end(), bytes, bytes + size);
        return add(views, object({{"buffer", "0"}, {"byteOffset", offset}, {"byteLength", std::to_string(size)}}));
    }

    // `count` elements of `width` numbers; 16 numbers are a matrix.
    std::string accessor(const void *data, size_t count, int component, size_t width)
    {
        static const char *const types[] = {"\"SCALAR\"", "\"VEC2\"", "\"VEC3\"", "\"VEC4\""};
        return add(accessors, object({{"bufferView", view(data, count * width *
                                                                    (component == U8    ? 1
                                                                     : component == U16 ? 2
                                                                                        : 4))},
                                      {"componentType", std::to_string(component)},
                                      {"count", std::to_string(count)},
                                      {"type", width == 16 ? "\"MAT4\"" : types[width - 1]}}));
    }

    void finish(import_scene *out)
    {
        // clang-format off
        json = object({{"asset", object({{"version", "\"2.0\""}, {"generator", generator}})}, {"scene", "0"},
                       {"scenes", "[{\"nodes\":[" + root + "]}]"}, {"accessors", array(accessors)},
                       {"buffers", "[{\"byteLength\":" + std::to_string(binary.size()) + "}]"}, {"skins", array(skins)},
                       {"bufferViews", array(views)}, {"nodes", array(nodes)}, {"meshes", array(meshes)},
                       {"materials", array(materials)}, {"textures", array(textures)}, {"images", array(images)},
                       {"cameras", array(cameras)}, {"animations", array(animations)},
                       {"extensions", object({{"KHR_lights_punctual", object({{"lights", array(lights)}})}})}});
        // clang-format on
        *out = {json.data(), json.size(), binary.data(), binary.size(), unit_m};
    }

  private:
    list accessors, views;
    std::vector<uint8_t> binary;
    std::string json;
};

// Calls a module's reader, which may throw. Nothing frees the scene: the process ends when the scene has been sent.
template <typename reader>
int read(reader convert, const import_request *request, const uint8_t *bytes, import_scene *out, char *note)
{
    try {
        auto *own = new scene;
        const int result = convert(*request, bytes, *own, note);
        own->finish(out);
        return result;
    } catch (const std::bad_alloc &) {
        return IMPORT_NO_MEMORY;
    } catch (const std::exception &e) {
        std::snprintf(note, IMPORT_NOTE_SIZE, "%s", e.what());
    } catch (...) {
        std::snprintf(note, IMPORT_NOTE_SIZE, "the reader failed");
    }
    return IMPORT_DAMAGED;
}

} // namespace flat

#endif
