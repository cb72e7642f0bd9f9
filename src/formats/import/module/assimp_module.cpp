// assimp_module.cpp: reads files with Assimp (https://github.com/assimp/assimp), in the program lambent-import.
#include "flat_scene.h"

#include <assimp/Importer.hpp>
#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <algorithm>
#include <map>
#include <set>

namespace
{

using namespace flat; // NOLINT: the module is this file

std::string matrix(const aiMatrix4x4 &m)
{
    const aiMatrix4x4 columns = aiMatrix4x4(m).Transpose();
    return m.IsIdentity() ? "" : numbers(&columns.a1, 16);
}

// The axes as columns.
aiMatrix4x4 frame(const aiVector3D &x, const aiVector3D &y, const aiVector3D &z, const aiVector3D &p)
{
    return {x.x, y.x, z.x, p.x, x.y, y.y, z.y, p.y, x.z, y.z, z.z, p.z, 0, 0, 0, 1};
}

// Looks along −z, as cameras and lights of glTF do.
aiMatrix4x4 looking(const aiVector3D &p, const aiVector3D &direction, aiVector3D up)
{
    aiVector3D back = -aiVector3D(direction);
    back.NormalizeSafe();
    if ((up ^ back).SquareLength() == 0)
        up = aiVector3D(back.y, back.z, back.x);
    aiVector3D right = up ^ back;
    right.NormalizeSafe();
    return frame(right, back ^ right, back, p);
}

class builder
{
  public:
    builder(const aiScene &from, flat::scene &to, const import_request &request)
        : in(from), out(to), format(request.format), raw(request.raw != 0)
    {
        order.push_back(in.mRootNode); // no recursion: files may be nested deeper than the stack
        for (size_t i = 0; i < order.size(); i++) {
            index.emplace(order[i]->mName.C_Str(), std::to_string(i));
            order.insert(order.end(), order[i]->mChildren, order[i]->mChildren + order[i]->mNumChildren);
        }
        for (unsigned i = 0; i < in.mNumAnimations; i++)
            for (unsigned k = 0; k < in.mAnimations[i]->mNumChannels; k++)
                moved.insert(in.mAnimations[i]->mChannels[k]->mNodeName.C_Str());
        for (unsigned i = 0; i < in.mNumLights; i++) {
            const aiColor3D &c = in.mLights[i]->mColorDiffuse;
            brightest = std::max({brightest, c.r, c.g, c.b});
            if (in.mLights[i]->mType == aiLightSource_AMBIENT)
                ambient = ambient + in.mLights[i]->mColorAmbient;
        }
        size_t child = 1;
        for (const aiNode *node : order) {
            out.nodes.push_back(make_node(*node, child));
            child += node->mNumChildren;
        }
        out.root = upright();
        out.nodes.insert(out.nodes.end(), extras.begin(), extras.end());
        for (unsigned i = 0; i < in.mNumAnimations; i++)
            animation(*in.mAnimations[i]);
    }

    std::set<std::string> lost; // what the file contains but the scene does not, as warnings

  private:
    const aiScene &in;
    flat::scene &out;
    const std::string format;
    const bool raw;                    // colours are linear
    std::vector<const aiNode *> order; // parents before children, children together
    std::map<std::string, std::string> index, pictures;
    std::set<std::string> moved; // nodes that an animation moves
    list extras;                 // nodes after the file's own
    std::map<unsigned, std::string> materials;
    std::string plain[2]; // materials
    float brightest = 1;  // light
    aiColor3D ambient;    // of the whole scene; the first light has it

    // --- nodes

    std::string extra(const std::string &node)
    {
        extras.push_back(node);
        return std::to_string(order.size() + extras.size() - 1);
    }

    // Returns the root node. FBX files state their axes, which Assimp leaves as they are; y becomes the up axis.
    std::string upright()
    {
        aiVector3D axes[2];
        for (int i = 0; i < 2; i++) {
            int axis = i, sign = 1;
            if (in.mMetaData) {
                in.mMetaData->Get(i ? "UpAxis" : "CoordAxis", axis);
                in.mMetaData->Get(i ? "UpAxisSign" : "CoordAxisSign", sign);
            }
            axes[i][static_cast<unsigned>(std::min(std::max(axis, 0), 2))] = sign < 0 ? -1.0F : 1.0F;
        }
        const aiVector3D third = axes[0] ^ axes[1];
        if (axes[1].y == 1 || third.SquareLength() == 0 || !in.mRootNode->mTransformation.IsIdentity())
            return "0";
        aiMatrix4x4 turn = frame(axes[0], axes[1], third, aiVector3D());
        return extra(object({{"matrix", matrix(turn.Transpose())}, {"children", "[0]"}}));
    }

    std::string make_node(const aiNode &node, size_t child)
    {
        const std::string name = text(node.mName.C_Str());
        list children, whole;
        for (unsigned i = 0; i < node.mNumChildren; i++)
            children.push_back(std::to_string(child + i));
        auto mesh_of = [&](const std::string &p) {
            return add(out.meshes, object({{"name", name}, {"primitives", p}}));
        };
        for (unsigned i = 0; i < node.mNumMeshes && node.mMeshes[i] < in.mNumMeshes; i++) {
            const aiMesh &mesh = *in.mMeshes[node.mMeshes[i]];
            const std::string own = primitive(mesh);
            if (!own.empty() && mesh.HasBones()) // a mesh with bones has its own skin, so it is a node of its own
                children.push_back(
                    extra(object({{"name", name}, {"mesh", mesh_of("[" + own + "]")}, {"skin", skin(mesh)}})));
            else if (!own.empty())
                whole.push_back(own);
        }
        for (unsigned i = 0; i < in.mNumCameras; i++)
            if (in.mCameras[i]->mName == node.mName && in.mCameras[i]->mHorizontalFOV > 0)
                children.push_back(camera(*in.mCameras[i]));
        for (unsigned i = 0; i < in.mNumLights; i++)
            if (in.mLights[i]->mName == node.mName)
                light(*in.mLights[i], children);
        members all = {{"name", name},
                       {"mesh", whole.empty() ? "" : mesh_of(array(whole))},
                       {"children", children.empty() ? "" : array(children)}};
        if (moved.count(node.mName.C_Str())) {
            aiVector3D scale, position;
            aiQuaternion q;
            node.mTransformation.Decompose(scale, q, position);
            const float rotation[4] = {q.x, q.y, q.z, q.w};
            all.insert(all.end(), {{"translation", numbers(&position.x, 3)},
                                   {"rotation", numbers(rotation, 4)},
                                   {"scale", numbers(&scale.x, 3)}});
        } else {
            all.emplace_back("matrix", matrix(node.mTransformation));
        }
        return object(all);
    }

    std::string camera(const aiCamera &from)
    {
        // Since Assimp 5.3, the angle of FBX cameras is the half one; that of all other cameras is whole.
        const bool half = format == "fbx" && (aiGetVersionMajor() > 5 || aiGetVersionMinor() > 2);
        const double aspect = from.mAspect > 0 ? static_cast<double>(from.mAspect) : 1,
                     angle = static_cast<double>(from.mHorizontalFOV) / (half ? 1 : 2),
                     high = 2 * std::atan(std::tan(angle) / aspect);
        const std::string near = number(std::max(from.mClipPlaneNear, 1e-4F)),
                          lens = object({{"yfov", number(high)}, {"znear", near}}),
                          own = add(out.cameras, object({{"type", "\"perspective\""},
                                                         {"perspective", lens},
                                                         {"name", text(from.mName.C_Str())}}));
        return extra(object({{"camera", own}, {"matrix", matrix(looking(from.mPosition, from.mLookAt, from.mUp))}}));
    }

    // Programs use different units, so the brightest light is at most 1. Lights of FBX do not fade.
    void light(const aiLight &from, list &children)
    {
        const bool sun = from.mType == aiLightSource_DIRECTIONAL, spot = from.mType == aiLightSource_SPOT;
        const float fading[3] = {from.mAttenuationConstant, from.mAttenuationLinear, from.mAttenuationQuadratic};
        const bool fades = format != "fbx" && fading[0] + fading[1] + fading[2] > 0;
        const aiColor3D color = from.mColorDiffuse * (1 / brightest);
        if (from.mType == aiLightSource_UNDEFINED || from.mType == aiLightSource_AREA)
            lost.insert("its area lights are not drawn");
        if (!sun && !spot && from.mType != aiLightSource_POINT)
            return;
        const std::string own = object({{"diffuse", numbers(&color.r, 3)},
                                        {"specular", numbers(&color.r, 3)},
                                        {"ambient", out.lights.empty() ? numbers(&ambient.r, 3) : ""},
                                        {"attenuation", fades ? numbers(fading, 3) : "[1,0,0]"}});
        const std::string cone = object({{"outerConeAngle", number(from.mAngleOuterCone / 2)},
                                         {"innerConeAngle", number(from.mAngleInnerCone / 2)}}),
                          kind = sun    ? "\"directional\""
                                 : spot ? "\"spot\""
                                        : "\"point\"",
                          lamp = add(out.lights, object({{"type", kind},
                                                         {"name", text(from.mName.C_Str())},
                                                         {"spot", spot ? cone : ""},
                                                         {"extensions", object({{"LAMBENT_light", own}})}}));
        children.push_back(
            extra(object({{"extensions", object({{"KHR_lights_punctual", object({{"light", lamp}})}})},
                          {"matrix", from.mDirection.SquareLength() > 0
                                         ? matrix(looking(from.mPosition, from.mDirection, aiVector3D(0, 1, 0)))
                                         : matrix(frame({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, from.mPosition))}})));
    }

    // --- meshes

    std::string primitive(const aiMesh &mesh)
    {
        const unsigned corners = mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE ? 3
                                 : mesh.mPrimitiveTypes & aiPrimitiveType_LINE   ? 2
                                                                                 : 1;
        std::vector<uint32_t> indices;
        for (unsigned i = 0; i < mesh.mNumFaces; i++)
            if (mesh.mFaces[i].mNumIndices == corners)
                indices.insert(indices.end(), mesh.mFaces[i].mIndices, mesh.mFaces[i].mIndices + corners);
        if (indices.empty() || !mesh.mVertices)
            return "";
        const size_t count = mesh.mNumVertices;
        members all = {{"POSITION", out.accessor(mesh.mVertices, count, F32, 3)}};
        if (mesh.HasNormals())
            all.emplace_back("NORMAL", out.accessor(mesh.mNormals, count, F32, 3));
        if (mesh.HasVertexColors(0)) {
            std::vector<aiColor4D> colors(mesh.mColors[0], mesh.mColors[0] + count);
            for (aiColor4D &c : colors)
                c = raw ? c : aiColor4D(linear(c.r), linear(c.g), linear(c.b), c.a);
            all.emplace_back("COLOR_0", out.accessor(colors.data(), count, F32, 4));
        }
        for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(set); set++) {
            std::vector<float> uv;
            for (size_t i = 0; i < count; i++) // the first row of a picture is at its top
                uv.insert(uv.end(), {mesh.mTextureCoords[set][i].x, 1 - mesh.mTextureCoords[set][i].y});
            all.emplace_back("TEXCOORD_" + std::to_string(set), out.accessor(uv.data(), count, F32, 2));
        }
        if (mesh.HasBones())
            put_weights(mesh, all);
        if (mesh.mNumAnimMeshes)
            lost.insert("its morph targets are not drawn");
        return object({{"attributes", object(all)},
                       {"indices", out.accessor(indices.data(), indices.size(), U32, 1)},
                       {"mode", corners == 3 ? "4" : std::to_string(corners - 1)},
                       {"material", material_of(mesh)}});
    }

    static float linear(float c) // from sRGB
    {
        return c <= 0.04045F ? c / 12.92F : c < 1 ? std::pow((c + 0.055F) / 1.055F, 2.4F) : c;
    }

    // At most four bones for each vertex (aiProcess_LimitBoneWeights).
    void put_weights(const aiMesh &mesh, members &all)
    {
        std::vector<uint16_t> joints(4 * static_cast<size_t>(mesh.mNumVertices));
        std::vector<float> weights(joints.size());
        std::vector<uint8_t> used(mesh.mNumVertices);
        for (unsigned b = 0; b < mesh.mNumBones; b++)
            for (unsigned i = 0; i < mesh.mBones[b]->mNumWeights; i++) {
                const aiVertexWeight &w = mesh.mBones[b]->mWeights[i];
                if (w.mVertexId >= mesh.mNumVertices || used[w.mVertexId] == 4)
                    continue;
                const size_t at = 4 * static_cast<size_t>(w.mVertexId) + used[w.mVertexId]++;
                joints[at] = static_cast<uint16_t>(b);
                weights[at] = w.mWeight;
            }
        all.emplace_back("JOINTS_0", out.accessor(joints.data(), mesh.mNumVertices, U16, 4));
        all.emplace_back("WEIGHTS_0", out.accessor(weights.data(), mesh.mNumVertices, F32, 4));
    }

    std::string skin(const aiMesh &mesh)
    {
        std::vector<aiMatrix4x4> inverse;
        list joints;
        for (unsigned b = 0; b < mesh.mNumBones; b++) {
            const auto found = index.find(mesh.mBones[b]->mName.C_Str());
            joints.push_back(found == index.end() ? "0" : found->second);
            inverse.push_back(aiMatrix4x4(mesh.mBones[b]->mOffsetMatrix).Transpose());
        }
        return add(out.skins, object({{"joints", array(joints)},
                                      {"inverseBindMatrices", out.accessor(inverse.data(), inverse.size(), F32, 16)}}));
    }

    // --- animations

    struct clip {
        double ticks;
        list samplers, channels;
    };

    static void put(std::vector<float> &to, const aiVector3D &v) { to.insert(to.end(), {v.x, v.y, v.z}); }
    static void put(std::vector<float> &to, const aiQuaternion &q) { to.insert(to.end(), {q.x, q.y, q.z, q.w}); }

    template <typename key>
    void channel(clip &to, const char *path, const std::string &node, const key *keys, unsigned count)
    {
        std::vector<float> times, values;
        for (unsigned i = 0; i < count; i++) {
            const float time = static_cast<float>(keys[i].mTime / to.ticks);
            if (!(time >= 0) || (!times.empty() && time <= times.back()))
                continue; // glTF's times increase
            times.push_back(time);
            put(values, keys[i].mValue);
        }
        if (times.empty())
            return;
        const std::string sampler =
            add(to.samplers,
                object({{"input", out.accessor(times.data(), times.size(), F32, 1)},
                        {"output", out.accessor(values.data(), times.size(), F32, values.size() / times.size())}}));
        add(to.channels, object({{"sampler", sampler}, {"target", object({{"node", node}, {"path", path}})}}));
    }

    void animation(const aiAnimation &from)
    {
        clip to = {from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 25, {}, {}};
        for (unsigned i = 0; i < from.mNumChannels; i++) {
            const aiNodeAnim &a = *from.mChannels[i];
            const std::string node = index.count(a.mNodeName.C_Str()) ? index[a.mNodeName.C_Str()] : "0";
            channel(to, "\"translation\"", node, a.mPositionKeys, a.mNumPositionKeys);
            channel(to, "\"rotation\"", node, a.mRotationKeys, a.mNumRotationKeys);
            channel(to, "\"scale\"", node, a.mScalingKeys, a.mNumScalingKeys);
        }
        if (!to.channels.empty())
            add(out.animations, object({{"name", text(from.mName.C_Str())},
                                        {"samplers", array(to.samplers)},
                                        {"channels", array(to.channels)}}));
    }

    // --- materials

    // Assimp gives a grey material to meshes that have none. Here they get the neutral grey, or white if their
    // vertices have colours.
    std::string material_of(const aiMesh &mesh)
    {
        const bool white = mesh.HasVertexColors(0);
        const aiMaterial &m = *in.mMaterials[std::min(mesh.mMaterialIndex, in.mNumMaterials - 1)];
        const bool none = format == "off" || std::strcmp(m.GetName().C_Str(), AI_DEFAULT_MATERIAL_NAME) == 0;
        std::string &own = none ? plain[white] : materials[mesh.mMaterialIndex];
        const std::string base = object({{"specular", "[0,0,0]"}, {"diffuse", white ? "[1,1,1,1]" : ""}});
        if (own.empty())
            own = add(out.materials, none ? own_material("", base, false) : material(m));
        return own;
    }

    static std::string own_material(const std::string &name, const std::string &fields, bool two_sided)
    {
        return object({{"name", name},
                       {"doubleSided", two_sided ? "true" : ""},
                       {"extensions", object({{"LAMBENT_material", fields}})}});
    }

    // Returns a textureInfo, or "" if the material has no such texture.
    std::string texture(const aiMaterial &m, aiTextureType type)
    {
        aiString name;
        int set = 0;
        if (m.GetTexture(type, 0, &name) != AI_SUCCESS || !name.length)
            return "";
        m.Get(AI_MATKEY_UVWSRC(type, 0), set);
        std::string &known = pictures[name.C_Str()];
        if (known.empty()) {
            const aiTexture *own = in.GetEmbeddedTexture(name.C_Str());
            const bool address = std::strncmp(name.C_Str(), "file://", 7) == 0;
            if (own && own->mHeight) {
                lost.insert("its pictures of raw pixels are not drawn");
                return "";
            }
            const std::string image =
                own ? object({{"bufferView", out.view(own->pcData, own->mWidth)}, {"mimeType", "\"image/png\""}})
                    : object({{"uri", text(name.C_Str() + (address ? 7 : 0))}});
            known = add(out.textures, object({{"source", add(out.images, image)}}));
        }
        return object({{"index", known}, {"texCoord", std::to_string(std::max(set, 0))}});
    }

    std::string material(const aiMaterial &m)
    {
        static const std::pair<const char *, aiTextureType> slots[] = {{"specular", aiTextureType_SPECULAR},
                                                                       {"emission", aiTextureType_EMISSIVE},
                                                                       {"normal", aiTextureType_NORMALS},
                                                                       {"bump", aiTextureType_HEIGHT},
                                                                       {"opacity", aiTextureType_OPACITY},
                                                                       {"metallic", aiTextureType_METALNESS},
                                                                       {"roughness", aiTextureType_DIFFUSE_ROUGHNESS},
                                                                       {"occlusion", aiTextureType_AMBIENT_OCCLUSION}};
        aiColor4D color(1, 1, 1, 1), shine(0, 0, 0, 1), glow(0, 0, 0, 1);
        float opacity = 1, metallic = 0, roughness = 0.5F, strength = 1, exponent = 0;
        int mode = 0, sides = 0;
        const std::string base = texture(m, aiTextureType_BASE_COLOR),
                          picture = base.empty() ? texture(m, aiTextureType_DIFFUSE) : base;
        // Assimp also computes a roughness from every exponent, which says nothing about the kind of material.
        const bool tinted = m.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS,
                   physical = tinted || !base.empty() || m.GetTextureCount(aiTextureType_METALNESS),
                   colored = tinted || m.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS;
        // Exporters write black beside a picture by mistake, as in MTL.
        if (!picture.empty() && (!colored || (color.r == 0 && color.g == 0 && color.b == 0)))
            color = aiColor4D(1, 1, 1, 1);
        m.Get(AI_MATKEY_OPACITY, opacity);
        m.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
        m.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness);
        m.Get(AI_MATKEY_SHININESS_STRENGTH, strength);
        m.Get(AI_MATKEY_SHININESS, exponent);
        m.Get(AI_MATKEY_SHADING_MODEL, mode);
        m.Get(AI_MATKEY_TWOSIDED, sides);
        m.Get(AI_MATKEY_COLOR_EMISSIVE, glow);
        color.a = std::min(std::max(opacity, 0.0F), 1.0F);
        // With an exponent of 1 the highlight would cover every lit point; programs write this for "none".
        const bool shines =
            exponent > 1 && mode != aiShadingMode_Gouraud && m.Get(AI_MATKEY_COLOR_SPECULAR, shine) == AI_SUCCESS;
        shine = shines ? shine * strength : aiColor4D(0, 0, 0, 1);
        members maps = {{"diffuse", picture}};
        for (const auto &slot : slots)
            maps.emplace_back(slot.first, texture(m, slot.second));
        const std::string own = object({{"diffuse", colored || !picture.empty() ? numbers(&color.r, 4) : ""},
                                        {"specular", numbers(&shine.r, 3)},
                                        {"shininess", shines ? number(exponent) : ""},
                                        {"emission", numbers(&glow.r, 3)},
                                        {"unlit", mode == aiShadingMode_NoShading ? "1" : ""},
                                        {"physical", physical ? "1" : ""},
                                        {"metallic", physical ? number(metallic) : ""},
                                        {"roughness", physical ? number(std::max(roughness, 0.0F)) : ""},
                                        {"maps", object(maps)}});
        return own_material(text(m.GetName().C_Str()), own, sides != 0);
    }
};

// Returns the metres per unit of length, or 0. Assimp converts COLLADA files to metres, and ignores the unit of AMF.
double unit_of(const aiScene &scene, const std::string &format, const std::string &head)
{
    double centimetres = 0;
    float single = 0; // of Assimp 5.2
    if (format == "fbx" && scene.mMetaData &&
        (scene.mMetaData->Get("UnitScaleFactor", single) || scene.mMetaData->Get("UnitScaleFactor", centimetres)))
        return (static_cast<double>(single) + centimetres) / 100;
    for (const auto &unit : {std::make_pair("inch", 0.0254), {"feet", 0.3048}, {"meter", 1.0}, {"micron", 1e-6}})
        if (format == "amf" && head.find(std::string("unit=\"") + unit.first + '"') != std::string::npos)
            return unit.second;
    return format == "dae" ? 1 : format == "amf" ? 1e-3 : 0;
}

// Returns whether a file has orthographic cameras, which Assimp reads as perspective ones.
bool has_orthographic(const std::string &format, const uint8_t *bytes, size_t size)
{
    using namespace std::string_literals;
    const std::string in_text = "\"CameraProjectionType\", \"enum\", \"\", \"\",1",
                      in_binary = "CameraProjectionTypeS\4\0\0\0enumS\0\0\0\0S\0\0\0\0I\1"s;
    auto contains = [&](const std::string &what) {
        return std::search(bytes, bytes + size, what.begin(), what.end()) != bytes + size;
    };
    return format == "fbx" ? contains(in_text) || contains(in_binary) : format == "dae" && contains("<orthographic>");
}

int convert(const import_request &request, const uint8_t *bytes, flat::scene &out, char *note)
{
    auto *importer = new Assimp::Importer;
    if (!importer->IsExtensionSupported(request.format)) {
        std::snprintf(note, IMPORT_NOTE_SIZE, "Assimp %u.%u does not read .%s", aiGetVersionMajor(),
                      aiGetVersionMinor(), request.format);
        return IMPORT_NO_MODULE;
    }
    const unsigned steps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
                           aiProcess_LimitBoneWeights | aiProcess_GenUVCoords | aiProcess_TransformUVCoords;
    const aiScene *scene =
        importer->ReadFileFromMemory(bytes, request.size, steps | aiProcess_ValidateDataStructure, request.format);
    std::string reason = importer->GetErrorString();
    const bool refused = !scene && reason.compare(0, 17, "Validation failed") == 0;
    if (refused) // the rest of the file is drawn: the glTF importer checks it again
        scene = importer->ReadFileFromMemory(bytes, request.size, steps, request.format);
    if (!scene || !scene->mRootNode) {
        reason = importer->GetErrorString();
        std::snprintf(note, IMPORT_NOTE_SIZE, "%s", reason.c_str());
        return reason.find("alloc") != std::string::npos ? IMPORT_NO_MEMORY : IMPORT_DAMAGED;
    }
    aiString generator;
    if (scene->mMetaData)
        scene->mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, generator);
    out.generator = text(generator.C_Str());
    out.unit_m = unit_of(*scene, request.format,
                         std::string(reinterpret_cast<const char *>(bytes), std::min<size_t>(request.size, 1000)));
    std::set<std::string> lost = builder(*scene, out, request).lost;
    if (refused)
        lost.insert("it contains an error, and is drawn as far as possible: " + reason);
    if (scene->mNumCameras && has_orthographic(request.format, bytes, request.size))
        lost.insert("its orthographic cameras show perspective");
    std::string all;
    for (const std::string &one : lost)
        all += (all.empty() ? "" : "; ") + one;
    std::snprintf(note, IMPORT_NOTE_SIZE, "%s", all.c_str());
    return IMPORT_READ;
}

int read(const import_request *request, const uint8_t *bytes, import_scene *scene, char *note)
{
    return flat::read(convert, request, bytes, scene, note);
}

const import_functions functions = {IMPORT_MODULE_VERSION, read};

} // namespace

extern "C" __attribute__((visibility("default"))) const import_functions *lambent_import_functions(void)
{
    return &functions;
}
