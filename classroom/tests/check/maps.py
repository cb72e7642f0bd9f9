"""maps.py: shaders that read maps of base colour, metalness, roughness, normals, occlusion and emission: correct shaders, and edits that introduce
known mistakes. The rows have the same form as in correct.py and mistakes.py, which include them."""
B, G, T = "learnopengl-pbr-maps", "gltf-maps", "threejs-pbr-maps"


def frag(old, new):
    return ("frag", old, new)


def vert(old, new):
    return ("vert", old, new)


# LearnOpenGL's program with tangents as an attribute, of four numbers or of three and the bitangent.
B_FRAME = [frag("in vec2 TexCoords;", "in vec2 TexCoords;\nin mat3 TBN;"),
           frag("""    vec3 px = dFdx(WorldPos);
    vec3 py = dFdy(WorldPos);
    vec2 ux = dFdx(TexCoords);
    vec2 uy = dFdy(TexCoords);
    vec3 N = normalize(Normal);
    vec3 T = normalize(px * uy.t - py * ux.t);
    vec3 B = -normalize(cross(N, T));
    return normalize(mat3(T, B, N) * bump);
""", "    return normalize(TBN * bump);\n"),
           vert("out vec2 TexCoords;", "out vec2 TexCoords;\nout mat3 TBN;")]
B_TANGENT = B_FRAME + [vert("layout(location = 2) in vec2 aTexCoords;", "layout(location = 2) in vec2 aTexCoords;\nlayout(location = 3) in vec3 aTangent;")]
B_SIGNED = B_FRAME + [vert("layout(location = 2) in vec2 aTexCoords;", "layout(location = 2) in vec2 aTexCoords;\nlayout(location = 3) in vec4 aTangent;")]
B_BOTH = B_FRAME + [vert("layout(location = 2) in vec2 aTexCoords;",
                         "layout(location = 2) in vec2 aTexCoords;\nlayout(location = 3) in vec3 aTangent;\nlayout(location = 4) in vec3 aBitangent;")]
OUT = "    TexCoords = aTexCoords;\n"
GRAM = OUT + """    vec3 T = normalize(mat3(model) * aTangent);
    T = normalize(T - dot(T, Normal) * Normal);
    TBN = mat3(T, cross(Normal, T), Normal);
"""
SIGNED = OUT + """    vec3 T = normalize(mat3(model) * aTangent.xyz);
    TBN = mat3(T, cross(Normal, T) * aTangent.w, Normal);
"""
BOTH = OUT + "    TBN = mat3(normalize(mat3(model) * aTangent), normalize(mat3(model) * aBitangent), Normal);\n"

# glTF's program without tangents, as in Khronos' sample viewer.
G_DERIVED = [
    vert("in vec4 a_tangent;\n", ""), vert("out mat3 v_TBN;", "out vec3 v_Normal;"),
    vert("""    vec3 N = normalize(vec3(u_NormalMatrix * vec4(a_normal, 0.0)));
    vec3 T = normalize(vec3(u_ModelMatrix * vec4(a_tangent.xyz, 0.0)));
    vec3 B = cross(N, T) * a_tangent.w;
    v_TBN = mat3(T, B, N);
""", "    v_Normal = normalize(vec3(u_NormalMatrix * vec4(a_normal, 0.0)));\n"),
    frag("in mat3 v_TBN;", "in vec3 v_Normal;"),
    frag("    vec3 n = normalize(v_TBN * bump);\n", """    vec2 uv_dx = dFdx(v_texcoord_0);
    vec2 uv_dy = dFdy(v_texcoord_0);
    vec3 t_ = (uv_dy.t * dFdx(v_Position) - uv_dx.t * dFdy(v_Position)) / (uv_dx.s * uv_dy.t - uv_dy.s * uv_dx.t);
    vec3 ng = normalize(v_Normal);
    vec3 t = normalize(t_ - ng * dot(ng, t_));
    vec3 b = cross(ng, t);
    vec3 n = normalize(mat3(t, b, ng) * bump);
""")]
G_LEARNOPENGL = G_DERIVED[:-1] + [frag("    vec3 n = normalize(v_TBN * bump);\n", """    vec3 ng = normalize(v_Normal);
    vec3 t = normalize(dFdx(v_Position) * dFdy(v_texcoord_0).t - dFdy(v_Position) * dFdx(v_texcoord_0).t);
    vec3 n = normalize(mat3(t, -normalize(cross(ng, t)), ng) * bump);
""")]
# The cotangent frame of three.js.
COTANGENT = """    vec3 q0 = dFdx(vWorldPosition), q1 = dFdy(vWorldPosition), N = normalize(vWorldNormal);
    vec2 st0 = dFdx(vUv), st1 = dFdy(vUv);
    vec3 q1perp = cross(q1, N), q0perp = cross(N, q0);
    vec3 tt = q1perp * st0.x + q0perp * st1.x, bb = q1perp * st0.y + q0perp * st1.y;
    float det = max(dot(tt, tt), dot(bb, bb)), scale = det == 0.0 ? 0.0 : inversesqrt(det);
    vec3 n = normalize(mat3(tt * scale, bb * scale, N) * bump);
"""
T_DERIVED = [vert("attribute vec4 tangent;\n", ""), vert("varying vec3 vWorldTangent;\nvarying vec3 vWorldBitangent;\n", ""),
             vert("    vWorldTangent = normalize(mat3(modelMatrix) * tangent.xyz);\n    vWorldBitangent = cross(vWorldNormal, vWorldTangent) * tangent.w;\n", ""),
             frag("varying vec3 vWorldTangent;\nvarying vec3 vWorldBitangent;\n", ""),
             frag("    vec3 n = normalize(mat3(normalize(vWorldTangent), normalize(vWorldBitangent), normalize(vWorldNormal)) * bump);\n", COTANGENT)]

# name, shader, edits.
CORRECT = [
    ("learnopengl-pbr with maps", B, []),
    ("learnopengl-pbr with tangents", B, B_TANGENT + [vert(OUT, GRAM)]),
    ("learnopengl-pbr with tangents of four numbers", B, B_SIGNED + [vert(OUT, SIGNED)]),
    ("learnopengl-pbr with tangents and bitangents", B, B_BOTH + [vert(OUT, BOTH)]),
    ("learnopengl-pbr with the bitangent along v", B, [frag("-normalize(cross(N, T))", "normalize(cross(N, T))")]),
    ("learnopengl-pbr with maps of sRGB", B, [frag("pow(texture(albedoMap, TexCoords).rgb, vec3(2.2))", "decoded(texture(albedoMap, TexCoords).rgb)"), frag(
        "vec3 bentNormal()", """vec3 decoded(vec3 c)
{
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

vec3 bentNormal()""")]),
    ("learnopengl-pbr with a packed map", B, [
        frag("uniform sampler2D metallicMap;\nuniform sampler2D roughnessMap;", "uniform sampler2D metallicRoughnessMap;"),
        frag("texture(metallicMap, TexCoords).r", "texture(metallicRoughnessMap, TexCoords).b"),
        frag("texture(roughnessMap, TexCoords).r", "texture(metallicRoughnessMap, TexCoords).g")]),
    ("learnopengl-pbr with an emission map", B, [
        frag("uniform sampler2D aoMap;", "uniform sampler2D aoMap;\nuniform sampler2D emissionMap;"),
        frag("albedo * ao + Lo;", "albedo * ao + Lo + pow(texture(emissionMap, TexCoords).rgb, vec3(2.2));")]),
    ("gltf with maps", G, []),
    ("gltf with maps, without tangents", G, G_DERIVED),
    ("gltf with the names of the format", G, [
        frag("uniform sampler2D u_BaseColorSampler;", "uniform sampler2D baseColorTexture;"), frag("texture(u_BaseColorSampler,", "texture(baseColorTexture,"),
        frag("uniform sampler2D u_MetallicRoughnessSampler;", "uniform sampler2D metallicRoughnessTexture;"),
        frag("texture(u_MetallicRoughnessSampler,", "texture(metallicRoughnessTexture,"),
        frag("uniform sampler2D u_NormalSampler;", "uniform sampler2D normalTexture;"), frag("texture(u_NormalSampler,", "texture(normalTexture,"),
        frag("uniform sampler2D u_EmissiveSampler;", "uniform sampler2D emissiveTexture;"), frag("texture(u_EmissiveSampler,", "texture(emissiveTexture,")]),
    ("gltf with an unused occlusion map", G, [
        frag("uniform sampler2D u_EmissiveSampler;", "uniform sampler2D u_EmissiveSampler;\nuniform sampler2D u_OcclusionSampler;\nuniform float u_OcclusionStrength;"),
        frag("    color += u_EmissiveFactor", "    float ao = texture(u_OcclusionSampler, v_texcoord_0).r;\n    vec3 everywhere = vec3(0.0);\n"
             "    color += mix(everywhere, everywhere * ao, u_OcclusionStrength);\n    color += u_EmissiveFactor")]),
    ("gltf with textureLod and texelFetch", G, [frag("texture(u_BaseColorSampler, v_texcoord_0)", "textureLod(u_BaseColorSampler, v_texcoord_0 * 3.0, 2.0)"),
                                                frag("texture(u_MetallicRoughnessSampler, v_texcoord_0)", "texelFetch(u_MetallicRoughnessSampler, ivec2(0), 0)")]),
    ("threejs with maps", T, []),
    ("threejs with maps, without tangents", T, T_DERIVED),
]

BUMP = "texture(normalMap, TexCoords).xyz * 2.0 - 1.0"
G_BUMP = "texture(u_NormalSampler, v_texcoord_0).rgb * 2.0 - vec3(1.0)"
G_T = "normalize(vec3(u_ModelMatrix * vec4(a_tangent.xyz, 0.0)))"
MISTAKES = [
    (B, "base-map-not-decoded", [frag("pow(texture(albedoMap, TexCoords).rgb, vec3(2.2))", "texture(albedoMap, TexCoords).rgb")]),
    (B, "base-map-decoded-twice", [frag("pow(texture(albedoMap, TexCoords).rgb, vec3(2.2))", "pow(texture(albedoMap, TexCoords).rgb, vec3(2.2 * 2.2))")]),
    (B, "normal-map-not-unpacked", [frag(BUMP, "texture(normalMap, TexCoords).xyz")]),
    (B, "normal-map-left-out", [frag("return normalize(mat3(T, B, N) * bump);", "return normalize(N + 1e-9 * T.x * B.x * bump.x);")]),
    (B, "normal-map-decoded", [frag(BUMP, "pow(texture(normalMap, TexCoords).xyz, vec3(2.2)) * 2.0 - 1.0")]),
    (B, "normal-map-without-frame", [frag("return normalize(mat3(T, B, N) * bump);", "return normalize(bump);")]),
    (B, "bent-normal-not-unit", [frag("return normalize(mat3(T, B, N) * bump);", "return mat3(T, B, N) * bump;")]),
    (B, "frame-transposed", [frag("mat3(T, B, N) * bump", "bump * mat3(T, B, N)")]),
    (B, "tangent-bitangent-swapped", [frag("mat3(T, B, N)", "mat3(B, T, N)")]),
    (B, "tangent-reversed", [frag("vec3 T = normalize(", "vec3 T = -normalize("), frag("-normalize(cross(N, T))", "normalize(cross(N, T))")]),
    (B, "metallic-roughness-swapped", [frag("texture(metallicMap", "texture(swap"), frag("texture(roughnessMap", "texture(metallicMap"), frag("texture(swap", "texture(roughnessMap")]),
    (B, "roughness-inverted", [frag("texture(roughnessMap, TexCoords).r", "1.0 - texture(roughnessMap, TexCoords).r")]),
    (B, "data-map-decoded", [frag("texture(roughnessMap, TexCoords).r", "pow(texture(roughnessMap, TexCoords).r, 2.2)"),
                             frag("texture(metallicMap, TexCoords).r", "pow(texture(metallicMap, TexCoords).r, 2.2)")]),
    (B, "occlusion-dims-lamps", [frag("vec3(0.03) * albedo * ao + Lo", "(vec3(0.03) * albedo + Lo) * ao")]),
    (B, "occlusion-left-out", [frag("albedo * ao + Lo", "albedo + Lo")]),
    (B, "tangent-by-normal-matrix", B_TANGENT + [vert(OUT, GRAM.replace("mat3(model) * aTangent", "normalMatrix * aTangent"))]),
    (B, "bitangent-reversed", B_TANGENT + [vert(OUT, GRAM.replace("cross(Normal, T)", "cross(T, Normal)"))]),
    (B, "tangent-not-unit", B_BOTH + [vert(OUT, OUT + "    TBN = mat3(mat3(model) * aTangent, mat3(model) * aBitangent, Normal);\n")]),
    (B, "tangent-object-space", B_TANGENT + [vert(OUT, OUT + "    TBN = mat3(aTangent, cross(Normal, aTangent), Normal);\n")]),
    (B, "bitangent-sign-lost", B_SIGNED + [vert(OUT, SIGNED.replace(" * aTangent.w", ""))]),
    (B, "base-map-not-decoded bitangent-reversed", B_TANGENT + [vert(OUT, GRAM.replace("cross(Normal, T)", "cross(T, Normal)")),
                                                                frag("pow(texture(albedoMap, TexCoords).rgb, vec3(2.2))", "texture(albedoMap, TexCoords).rgb")]),
    (G, "base-map-decoded-twice", [frag("texture(u_BaseColorSampler, v_texcoord_0);", "vec4(pow(texture(u_BaseColorSampler, v_texcoord_0).rgb, vec3(2.2)), 1.0);")]),
    (G, "base-factor-left-out", [frag("u_BaseColorFactor * texture(", "texture(")]),
    (G, "base-map-left-out", [frag("u_BaseColorFactor * texture(u_BaseColorSampler, v_texcoord_0)", "u_BaseColorFactor + 1e-9 * texture(u_BaseColorSampler, v_texcoord_0)")]),
    (G, "metallic-from-red", [frag("u_MetallicFactor * data.b", "u_MetallicFactor * data.r")]),
    (G, "metallic-from-alpha", [frag("u_MetallicFactor * data.b", "u_MetallicFactor * data.a")]),
    (G, "metallic-from-green", [frag("u_MetallicFactor * data.b", "u_MetallicFactor * data.g")]),
    (G, "roughness-from-red", [frag("u_RoughnessFactor * data.g", "u_RoughnessFactor * data.r")]),
    (G, "roughness-from-blue", [frag("u_RoughnessFactor * data.g", "u_RoughnessFactor * data.b")]),
    (G, "roughness-from-alpha", [frag("u_RoughnessFactor * data.g", "u_RoughnessFactor * data.a")]),
    (G, "metallic-roughness-swapped", [frag("u_RoughnessFactor * data.g", "u_RoughnessFactor * data.b"), frag("u_MetallicFactor * data.b", "u_MetallicFactor * data.g")]),
    (G, "metallic-roughness-from-red", [frag("u_RoughnessFactor * data.g", "u_RoughnessFactor * data.r"), frag("u_MetallicFactor * data.b", "u_MetallicFactor * data.r")]),
    (G, "metallic-roughness-factors-left-out", [frag("u_RoughnessFactor * data.g", "data.g"), frag("u_MetallicFactor * data.b", "data.b")]),
    (G, "data-map-decoded", [frag("vec4 data = texture(u_MetallicRoughnessSampler, v_texcoord_0);", "vec4 data = pow(texture(u_MetallicRoughnessSampler, v_texcoord_0), vec4(2.2));")]),
    (G, "normal-map-not-unpacked", [frag(G_BUMP, "texture(u_NormalSampler, v_texcoord_0).rgb")]),
    (G, "bitangent-reversed", [frag("bump *= vec3(u_NormalScale, u_NormalScale, 1.0);", "bump *= vec3(u_NormalScale, -u_NormalScale, 1.0);")]),
    (G, "tangent-reversed", [vert("v_TBN = mat3(T, B, N);", "v_TBN = mat3(-T, B, N);")]),
    (G, "bitangent-sign-lost", [vert("cross(N, T) * a_tangent.w", "cross(N, T)")]),
    (G, "tangent-not-unit", [vert(G_T, "vec3(u_ModelMatrix * vec4(a_tangent.xyz, 0.0))")]),
    (G, "tangent-by-normal-matrix", [vert(G_T, "normalize(vec3(u_NormalMatrix * vec4(a_tangent.xyz, 0.0)))")]),
    (G, "frame-transposed", [frag("v_TBN * bump", "transpose(v_TBN) * bump")]),
    (G, "tangent-reversed", G_LEARNOPENGL),
    (G, "bitangent-reversed", G_DERIVED[:-1] + [(G_DERIVED[-1][0], G_DERIVED[-1][1], G_DERIVED[-1][2].replace("cross(ng, t)", "cross(t, ng)"))]),
    (B, "emission-map-not-decoded", [frag("uniform sampler2D aoMap;", "uniform sampler2D aoMap;\nuniform sampler2D emissionMap;"),
                                     frag("albedo * ao + Lo;", "albedo * ao + Lo + texture(emissionMap, TexCoords).rgb;")]),
    (G, "no-emission", [frag("    color += u_EmissiveFactor *", "    color += 1e-9 * u_EmissiveFactor *")]),
    (G, "emission-map-decoded-twice", [frag("texture(u_EmissiveSampler, v_texcoord_0).rgb;", "pow(texture(u_EmissiveSampler, v_texcoord_0).rgb, vec3(2.2));")]),
    (G, "emission-factor-left-out", [frag("color += u_EmissiveFactor *", "color +=")]),
    (G, "occlusion-dims-lamps", [frag("uniform sampler2D u_EmissiveSampler;", "uniform sampler2D u_EmissiveSampler;\nuniform sampler2D u_OcclusionSampler;"),
                                 frag("    color += u_EmissiveFactor", "    color *= texture(u_OcclusionSampler, v_texcoord_0).r;\n    color += u_EmissiveFactor")]),
    (G, "roughness-from-blue metallic-from-red", [frag("u_RoughnessFactor * data.g", "u_RoughnessFactor * data.b"), frag("u_MetallicFactor * data.b", "u_MetallicFactor * data.r")]),
    (G, "alpha-is-roughness", [frag("roughness * roughness", "roughness")]),
    (T, "metallic-from-red", [frag("texture2D(metalnessMap, vUv).b", "texture2D(metalnessMap, vUv).r")]),
    (T, "roughness-from-red", [frag("texture2D(roughnessMap, vUv).g", "texture2D(roughnessMap, vUv).r")]),
    (T, "base-map-decoded-twice", [frag("texture2D(map, vUv).rgb", "pow(texture2D(map, vUv).rgb, vec3(2.2))")]),
    (T, "bitangent-sign-lost", [vert(" * tangent.w", "")]),
    (T, "normal-map-not-unpacked", T_DERIVED + [frag("texture2D(normalMap, vUv).xyz * 2.0 - 1.0", "texture2D(normalMap, vUv).xyz")]),
]
