"""mistakes.py: edits of this folder's correct shaders, each of which introduces known mistakes.

(shader, expected ids, [(ending, old text, new text), …]). The old text must occur in the file exactly once.
"""

P, Q, O, N, D, M = "pittsburgh", "pittsburgh-vertex", "oregon", "nyu", "nyu-direction", "lambent"
L, LM, LS, LL = "learnopengl", "learnopengl-materials", "learnopengl-spot", "learnopengl-lights"
A, AV, W, T, TR = "angel", "angel-vertex", "mdn", "threejs", "threejs-raw"


def frag(old, new):
    return ("frag", old, new)


def vert(old, new):
    return ("vert", old, new)


P_LIGHT = "L = light.w == 0.0 ? light.xyz : light.xyz - point.xyz;"
P_ATTENUATION = "1.0 / (attenuation_constant + attenuation_linear * d + attenuation_quadratic * d * d)"
P_SUM = "ambient + attenuation * (diffuse + specular)"
N_NORMAL = "normalize((normalMatrix * normal).xyz)"

# Clip space with 4-vectors: every vector of the vertex shader is multiplied by the projection.
P_FOUR = [
    vert("varying vec3 N;", "varying vec4 N;"), vert("varying vec3 L;", "varying vec4 L;"),
    vert("varying vec3 V;", "varying vec4 V;"),
    vert("N = normalize(normal_matrix * vNormal.xyz);", "N = normalize(projection * model_view * vNormal);"),
    vert(P_LIGHT, "L = projection * (light - point);"), vert("V = -point.xyz;", "V = vec4(0.0, 0.0, 0.0, 1.0) - projection * point;"),
    frag("varying vec3 N;", "varying vec4 N;"), frag("varying vec3 L;", "varying vec4 L;"),
    frag("varying vec3 V;", "varying vec4 V;"), frag("vec3 n = normalize(N)", "vec4 n = normalize(N)"),
    frag("vec3 l = normalize(L)", "vec4 l = normalize(L)"), frag("vec3 v = normalize(V)", "vec4 v = normalize(V)"),
    frag("vec3 h =", "vec4 h ="),
]
P_MINUS = [
    vert("varying vec3 L;", "varying vec4 L;"), vert(P_LIGHT, "L = light - point;"), frag("varying vec3 L;", "varying vec4 L;"),
    frag("vec3 l = normalize(L)", "vec4 l = normalize(L)"), frag("vec3 n = normalize(N)", "vec4 n = vec4(normalize(N), 0.0)"),
    frag("vec3 v = normalize(V)", "vec4 v = vec4(normalize(V), 0.0)"), frag("vec3 h =", "vec4 h ="),
]

MISTAKES = [
    # --- Pittsburgh's names, lit per fragment
    (P, "normal-not-unit", [frag("normalize(N)", "N")]),
    (P, "normal-unit-late", [vert("normalize(normal_matrix * vNormal.xyz)", "normal_matrix * vNormal.xyz")]),
    (P, "normal-never-unit", [frag("normalize(N)", "N"), vert("normalize(normal_matrix * vNormal.xyz)", "normal_matrix * vNormal.xyz")]),
    (P, "normal-by-model-view", [vert("normal_matrix * vNormal.xyz", "(model_view * vNormal).xyz")]),
    (P, "normal-object-space", [vert("normal_matrix * vNormal.xyz", "vNormal.xyz")]),
    (P, "normal-clip-space", [vert("normal_matrix * vNormal.xyz", "(projection * model_view * vNormal).xyz")]),
    (P, "normal-inward", [vert("normalize(normal_matrix", "-normalize(normal_matrix")]),
    (P, "clip-space", [vert("vec4 point = model_view * vPosition;", "vec4 point = projection * model_view * vPosition;"),
                       vert("vec4 light = model_view", "vec4 light = projection * model_view"),
                       vert("light.w == 0.0", "light_position.w == 0.0"),
                       vert("normal_matrix * vNormal.xyz", "(projection * model_view * vNormal).xyz"),
                       vert("gl_Position = projection * point", "gl_Position = point")]),
    (P, "clip-space-vectors", [vert("vec4 point = model_view * vPosition;", "vec4 point = projection * model_view * vPosition;"),
                               vert("vec4 light = model_view", "vec4 light = projection * model_view"),
                               vert("light.w == 0.0", "light_position.w == 0.0"),
                               vert("gl_Position = projection * point", "gl_Position = point")]),
    (P, "clip-space-four direction-as-point", P_FOUR),
    (P, "clip-space-vertex", [vert("vec4 point = model_view * vPosition;", "vec4 point = projection * model_view * vPosition;"),
                              vert("gl_Position = projection * point", "gl_Position = point")]),
    (P, "light-not-moved", [vert("vec4 light = model_view * light_position", "vec4 light = light_position")]),
    (P, "light-in-object-space", [vert("vec4 light = model_view * light_position", "vec4 light = light_position"),
                                  vert("light.xyz - point.xyz", "light.xyz - vPosition.xyz")]),
    (P, "eye-from-object-space", [vert("V = -point.xyz", "V = -vPosition.xyz")]),
    (P, "direction-as-point", [vert(P_LIGHT, "L = light.xyz - point.xyz;")]),
    (P, "direction-minus-point", P_MINUS),
    (P, "light-backwards", [vert(P_LIGHT, "L = light.w == 0.0 ? -light.xyz : point.xyz - light.xyz;")]),
    (P, "eye-backwards", [vert("V = -point.xyz", "V = point.xyz")]),
    (P, "viewer-infinite", [vert("V = -point.xyz", "V = vec3(0.0, 0.0, 1.0)")]),
    (P, "light-not-unit", [frag("normalize(L)", "L")]),
    (P, "half-of-raw-light", [frag("normalize(l + v)", "normalize(L + v)")]),
    (P, "half-of-raw-both", [frag("normalize(l + v)", "normalize(L + V)")]),
    (P, "half-not-unit", [frag("normalize(l + v)", "l + v")]),
    (P, "half-is-mean", [frag("normalize(l + v)", "(l + v) / 2.0")]),
    (P, "light-unit-too-early distance-interpolated", [
        vert("varying vec3 V;", "varying vec3 V;\nvarying float distance;"), frag("varying vec3 V;", "varying vec3 V;\nvarying float distance;"),
        vert(P_LIGHT, P_LIGHT + " distance = length(L); L = normalize(L);"), frag("length(L)", "distance")]),
    (P, "distance-interpolated", [
        vert("varying vec3 V;", "varying vec3 V;\nvarying float distance;"), frag("varying vec3 V;", "varying vec3 V;\nvarying float distance;"),
        vert(P_LIGHT, P_LIGHT + " distance = length(L);"), frag("length(L)", "distance")]),
    (P, "eye-unit-too-early", [vert("V = -point.xyz", "V = normalize(-point.xyz)")]),
    (P, "no-attenuation", [frag(P_SUM, "ambient + diffuse + specular")]),
    (P, "specular-not-attenuated", [frag(P_SUM, "ambient + attenuation * diffuse + specular")]),
    (P, "diffuse-not-attenuated", [frag(P_SUM, "ambient + diffuse + attenuation * specular")]),
    (P, "ambient-attenuated", [frag(P_SUM, "attenuation * (ambient + diffuse + specular)")]),
    (P, "attenuation-swapped", [frag(P_ATTENUATION, "1.0 / (attenuation_constant + attenuation_quadratic * d + attenuation_linear * d * d)")]),
    (P, "attenuation-inverted", [frag(P_ATTENUATION, "(attenuation_constant + attenuation_linear * d + attenuation_quadratic * d * d)")]),
    (P, "no-gate", [frag("dot(n, l) <= 0.0", "false")]),
    (P, "no-clamp", [frag("max(dot(n, l), 0.0)", "dot(n, l)")]),
    (P, "lit-from-behind", [frag("max(dot(n, l), 0.0)", "abs(dot(n, l))"), frag("max(dot(n, h), 0.0)", "abs(dot(n, h))"),
                            frag("dot(n, l) <= 0.0", "false")]),
    (P, "phong-lobe", [frag("max(dot(n, h), 0.0)", "max(dot(reflect(-l, n), v), 0.0)")]),
    (P, "phong-quarter", [frag("pow(max(dot(n, h), 0.0), shininess)", "pow(max(dot(reflect(-l, n), v), 0.0), shininess / 4.0)")]),
    (P, "shininess-times-4", [frag("0.0), shininess)", "0.0), 4.0 * shininess)")]),
    (P, "shininess-quarter", [frag("0.0), shininess)", "0.0), shininess / 4.0)")]),
    (P, "specular-times-n.l", [frag("specular_product *", "max(dot(n, l), 0.0) * specular_product *")]),
    (P, "kd-ks-swapped", [frag("vec4 diffuse = diffuse_product", "vec4 diffuse = specular_product"),
                          frag("vec4 specular = specular_product", "vec4 specular = diffuse_product")]),
    (P, "ka-kd-swapped", [frag("vec4 diffuse = diffuse_product", "vec4 diffuse = ambient_product"),
                          frag("vec4 ambient = ambient_product", "vec4 ambient = diffuse_product")]),
    (P, "specular-tinted", [frag("vec4 specular = specular_product", "vec4 specular = specular_product * diffuse_product")]),
    (P, "specular-in-diffuse-colour", [frag("vec4 specular = specular_product", "vec4 specular = diffuse_product")]),
    (P, "no-ambient", [frag("ambient + attenuation", "attenuation")]),
    (P, "no-diffuse", [frag("(diffuse + specular)", "specular")]),
    (P, "no-specular", [frag("(diffuse + specular)", "diffuse")]),
    (P, "alpha-one", [frag("color.rgb, diffuse_product.a", "color.rgb, 1.0")]),
    (P, "alpha-summed", [frag("vec4(color.rgb, diffuse_product.a)", "color")]),
    (P, "encoded", [frag("vec4(color.rgb,", "vec4(pow(min(color.rgb, 1.0), vec3(1.0 / 2.2)),")]),
    (P, "upside-down", [vert("gl_Position = projection * point;", "gl_Position = projection * point; gl_Position.y = -gl_Position.y;")]),
    # --- the same names, lit per vertex
    (Q, "normal-never-unit", [vert("normalize(normal_matrix * vNormal.xyz)", "normal_matrix * vNormal.xyz")]),
    (Q, "normal-by-model-view", [vert("normal_matrix * vNormal.xyz", "(model_view * vNormal).xyz")]),
    (Q, "no-gate", [vert("dot(n, l) > 0.0 ? pow(max(dot(n, h), 0.0), shininess) : 0.0", "pow(max(dot(n, h), 0.0), shininess)")]),
    (Q, "light-not-moved", [vert("vec4 light = model_view * light_position", "vec4 light = light_position")]),
    (Q, "direction-as-point", [vert("light.w == 0.0 ? light.xyz : light.xyz - point.xyz", "light.xyz - point.xyz")]),
    (Q, "direction-minus-origin", [vert("vec3 l = normalize(way);",
                                        "vec3 l = light.w == 0.0 ? normalize(light - vec4(0.0, 0.0, 0.0, 1.0)).xyz : normalize(way);")]),
    (Q, "half-of-raw-light", [vert("normalize(l + v)", "normalize(way + v)")]),
    (Q, "ambient-attenuated specular-not-attenuated", [
        vert("color = ambient_product + attenuation * (diffuse_product * max(dot(n, l), 0.0) + specular_product * s)",
             "color = attenuation * (ambient_product + diffuse_product * max(dot(n, l), 0.0)) + specular_product * s")]),
    (Q, "no-attenuation", [vert("attenuation * (diffuse_product", "(diffuse_product")]),
    (Q, "clip-space-vertex", [vert("vec4 point = model_view * vPosition;", "vec4 point = projection * model_view * vPosition;"),
                              vert("gl_Position = projection * point", "gl_Position = point")]),
    (Q, "alpha-one", [vert("color.a = diffuse_product.a", "color.a = 1.0")]),
    (Q, "vertex-colour-clamped", [vert("gl_Position = projection", "color = clamp(color, 0.0, 1.0);\n    gl_Position = projection"),
                                  vert("color = ambient_product", "color = 4.0 * ambient_product * 0.25")]),
    # --- Oregon's names
    (O, "normal-not-unit", [frag("normalize(uFlat ? vNf : vNs)", "(uFlat ? vNf : vNs)")]),
    (O, "normal-never-unit", [frag("normalize(uFlat ? vNf : vNs)", "(uFlat ? vNf : vNs)"),
                              vert("normalize(gl_NormalMatrix * gl_Normal)", "gl_NormalMatrix * gl_Normal")]),
    (O, "normal-by-model-view", [vert("gl_NormalMatrix * gl_Normal", "mat3(gl_ModelViewMatrix) * gl_Normal")]),
    (O, "normal-object-space", [vert("gl_NormalMatrix * gl_Normal", "gl_Normal")]),
    (O, "clip-space-vertex", [vert("(gl_ModelViewMatrix * gl_Vertex)", "(gl_ModelViewProjectionMatrix * gl_Vertex)")]),
    (O, "light-moved-twice", [vert("vec3(uLightX, uLightY, uLightZ)", "(gl_ModelViewMatrix * vec4(uLightX, uLightY, uLightZ, 1.0)).xyz")]),
    (O, "point-in-object-space", [vert("(gl_ModelViewMatrix * gl_Vertex).xyz", "gl_Vertex.xyz")]),
    (O, "light-from-object-space", [vert("uLightZ) - point", "uLightZ) - gl_Vertex.xyz")]),
    (O, "eye-from-object-space", [vert("vEs = -point", "vEs = -gl_Vertex.xyz")]),
    (O, "reflect-sign", [vert("vEs = -point", "vEs = point")]),
    (O, "unit-too-early", [vert("uLightZ) - point;", "uLightZ) - point; vLs = normalize(vLs);"), vert("vEs = -point", "vEs = normalize(-point)")]),
    (O, "no-gate", [frag("dot(n, l) > 0.0 ? pow(max(dot(r, e), 0.0), uShininess) : 0.0", "pow(max(dot(r, e), 0.0), uShininess)")]),
    (O, "reflect-sign", [frag("reflect(-l, n)", "reflect(l, n)")]),
    (O, "blinn-phong-lobe", [frag("dot(r, e)", "dot(normalize(l + e), n)")]),
    (O, "blinn-phong-times-4", [frag("max(dot(r, e), 0.0), uShininess", "max(dot(normalize(l + e), n), 0.0), 4.0 * uShininess")]),
    (O, "shininess-times-4", [frag("0.0), uShininess", "0.0), 4.0 * uShininess")]),
    (O, "no-ambient no-gate", [frag("uKa * uColor + ", ""), frag("dot(n, l) > 0.0 ? pow(max(dot(r, e), 0.0), uShininess) : 0.0",
                                                                  "pow(max(dot(r, e), 0.0), uShininess)")]),
    (O, "no-ambient", [frag("uKa * uColor + ", "")]),
    (O, "no-clamp", [frag("max(dot(n, l), 0.0)", "dot(n, l)")]),
    (O, "specular-in-diffuse-colour", [frag("uKs * s * uSpecularColor", "uKs * s * uColor")]),
    (O, "smooth-for-flat", [frag("uFlat ? vNf : vNs", "vNs"), frag("uFlat ? vLf : vLs", "vLs"), frag("uFlat ? vEf : vEs", "vEs")]),
    # --- NYU's names, two point lights
    (N, "normal-not-unit", [frag("normalize(varyingNormal)", "varyingNormal")]),
    (N, "normal-by-model-view no-gate normal-unit-late", [
        vert(N_NORMAL, "(modelViewMatrix * normal).xyz"),
        frag("dot(n, l) > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0", "pow(max(dot(n, h), 0.0), 64.0)")]),
    (N, "normal-with-w", [vert(N_NORMAL, "normalize(normalMatrix * normal).xyz"), frag("normalize(varyingNormal)", "varyingNormal")]),
    (N, "normal-with-w-vertex", [vert(N_NORMAL, "normalize(normalMatrix * normal).xyz")]),
    (N, "normal-by-model-view", [vert("normalMatrix * normal", "modelViewMatrix * normal")]),
    (N, "no-attenuation", [frag("attenuate(length(way) / 5.0, 2.7, 5.0)", "1.0")]),
    (N, "specular-not-attenuated", [frag("* s * attenuation", "* s")]),
    (N, "no-gate", [frag("dot(n, l) > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0", "pow(max(dot(n, h), 0.0), 64.0)")]),
    (N, "phong-lobe", [frag("dot(n, h)", "dot(reflect(-l, n), v)")]),
    (N, "half-of-raw-light", [frag("normalize(l + v)", "normalize(way + v)")]),
    (N, "first-light-only", [frag("for (int i = 0; i < 2", "for (int i = 0; i < 1")]),
    (N, "last-light-only", [frag("diffuse += ", "diffuse = "), frag("specular += ", "specular = ")]),
    (N, "specular-tinted", [frag("uColor * diffuse + specular", "uColor * (diffuse + specular)")]),
    # --- NYU's names, one directional light
    (D, "normal-not-unit", [frag("normalize(varyingNormal)", "varyingNormal")]),
    (D, "direction-reversed", [frag("float d = max(dot(n, lightDirection)", "vec3 away = -lightDirection;\n    float d = max(dot(n, away)"),
                               frag("v + lightDirection", "v + away")]),
    (D, "no-gate", [frag("d > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0", "pow(max(dot(n, h), 0.0), 64.0)")]),
    # --- Lambent's names, three lights
    (M, "normal-by-model-view", [vert("normal_matrix * normal", "mat3(model_view) * normal")]),
    (M, "no-flip", [frag("gl_FrontFacing ? normalize(eye_normal) : -normalize(eye_normal)", "normalize(eye_normal)")]),
    (M, "no-cone", [frag("lights[i].cone.x > -1.0", "false && lights[i].cone.x > -1.0")]),
    (M, "no-cutoff", [frag("c >= lights[i].cone.x ? pow(max(c, 0.0), lights[i].cone.y) : 0.0", "pow(max(c, 0.0), lights[i].cone.y)")]),
    (M, "no-spot-exponent", [frag("pow(max(c, 0.0), lights[i].cone.y)", "1.0")]),
    (M, "no-gate", [frag("dot(n, l) > 0.0 ? pow(max(dot(n, h), 0.0), material.shininess) : 0.0",
                         "pow(max(dot(n, h), 0.0), material.shininess)")]),
    (M, "first-light-only", [frag("for (int i = 0; i < 3", "for (int i = 0; i < 1")]),
    (M, "last-light-only", [frag("        color += attenuation", "        color = material.ambient.rgb * ambient_light.rgb + attenuation")]),
    (M, "ambient-for-each-light", [frag("color += attenuation * spot", "color += (i > 0 ? material.ambient.rgb * ambient_light.rgb : vec3(0.0)) + attenuation * spot"),
                                   frag("vec3 color = material", "vec3 color = 1.0 * material")]),
    (M, "no-attenuation", [frag("color += attenuation * spot", "color += spot")]),
    (M, "alpha-one", [frag("color, material.diffuse.a", "color, 1.0")]),
    # --- LearnOpenGL's names, lit in world space
    (L, "no-gate", [frag("diffuse > 0.0 ? pow(max(dot(v, r), 0.0), 32.0) : 0.0", "pow(max(dot(v, r), 0.0), 32.0)")]),
    (L, "normal-unit-late", [vert("normalize(mat3(transpose(inverse(model))) * aNormal)", "mat3(transpose(inverse(model))) * aNormal")]),
    (L, "normal-by-model-view", [vert("mat3(transpose(inverse(model)))", "mat3(model)")]),
    (L, "normal-object-space", [vert("mat3(transpose(inverse(model))) * aNormal", "aNormal")]),
    (L, "normal-eye-space", [vert("mat3(transpose(inverse(model)))", "mat3(transpose(inverse(view * model)))")]),
    (L, "point-in-object-space", [vert("FragPos = vec3(model * vec4(aPos, 1.0));", "FragPos = aPos;"),
                                  vert("view * vec4(FragPos, 1.0)", "view * model * vec4(aPos, 1.0)")]),
    (L, "eye-at-origin", [frag("normalize(viewPos - FragPos)", "normalize(-FragPos)")]),
    (L, "light-backwards", [frag("lightPos - FragPos", "FragPos - lightPos")]),
    (L, "blinn-phong-lobe", [frag("dot(v, r)", "dot(n, normalize(l + v))")]),
    (L, "no-clamp", [frag("max(dot(n, l), 0.0)", "dot(n, l)")]),
    (LM, "ambient-attenuated", [frag("ambient + attenuation * (diffuse + specular)", "attenuation * (ambient + diffuse + specular)")]),
    (LM, "no-attenuation", [frag("attenuation * (diffuse", "1.0 * (diffuse")]),
    (LM, "no-ambient", [frag("ambient + attenuation", "attenuation")]),
    (LM, "specular-tinted", [frag("s * material.specular", "s * material.specular * material.diffuse")]),
    (LM, "light-moved-twice", [vert("uniform mat4 view;", "uniform mat4 view;\nuniform mat4 unused;"),
                               frag("uniform vec3 viewPos;", "uniform vec3 viewPos;\nuniform mat4 model;"),
                               frag("light.position - FragPos", "vec3(model * vec4(light.position, 1.0)) - FragPos")]),
    (LS, "no-cone", [frag("attenuation * intensity * lit", "attenuation * lit")]),
    (LL, "one-light-too-few", [frag("for (int i = 0; i < NR_POINT_LIGHTS", "for (int i = 0; i < 2")]),
    # --- Angel's names
    (A, "normal-by-model-view", [vert("transpose(inverse(mat3(ModelView)))", "mat3(ModelView)")]),
    (A, "direction-as-point", [vert("LightPosition.w * point.xyz", "point.xyz")]),
    (A, "half-of-raw-eye", [frag("normalize(L + normalize(fE))", "normalize(L + fE)")]),
    (A, "light-from-object-space", [vert("LightPosition.w * point.xyz", "LightPosition.w * vPosition.xyz")]),
    (AV, "eye-backwards", [vert("L - normalize(pos)", "L + normalize(pos)")]),
    (AV, "no-gate", [vert("d > 0.0 ? pow(max(dot(N, H), 0.0), uShininess) : 0.0", "pow(max(dot(N, H), 0.0), uShininess)")]),
    # --- MDN's names: one light, a constant, and no highlight
    (W, "normal-never-unit", [vert("normalize((uNormalMatrix * vec4(aVertexNormal, 0.0)).xyz)", "(uNormalMatrix * vec4(aVertexNormal, 0.0)).xyz")]),
    (W, "normal-by-model-view", [vert("uNormalMatrix * vec4", "uModelViewMatrix * vec4")]),
    (W, "normal-inward", [vert("dot(normal, directionalVector)", "dot(normal, -directionalVector)")]),
    (W, "no-clamp", [vert("max(dot(normal, directionalVector), 0.0)", "dot(normal, directionalVector)")]),
    # --- three.js' names
    (T, "normal-eye-space", [vert("transpose(inverse(mat3(modelMatrix))) * normal", "normalMatrix * normal")]),
    (T, "eye-at-origin", [frag("cameraPosition - vWorldPosition", "-vWorldPosition")]),
    (T, "no-gate", [frag("d > 0.0 ? pow(max(dot(n, h), 0.0), shininess) : 0.0", "pow(max(dot(n, h), 0.0), shininess)")]),
    (T, "phong-lobe", [frag("max(dot(n, h), 0.0)", "max(dot(reflect(-l, n), v), 0.0)")]),
    (TR, "normal-object-space", [vert("normalMatrix * normal", "normal")]),
    (TR, "first-light-only", [frag("for (int i = 0; i < 2", "for (int i = 0; i < 1")]),
]
