"""mutants.py: inserts every known mistake into a correct shader of every contract, in every version of GLSL.

A shader is a template with parts ($normal, $attenuation …). A contract supplies the parts, and a mistake replaces some of them. `mutants()` lists
them all;
`python3 classroom/tests/check/mutants.py FOLDER` writes them as files. classroom/tests/check/matrix.py checks them and prints a table."""
import random
import re
import string
import sys
import pathlib

import dialects

VERTEX = """$attributes
$vertex_uniforms
$varyings
$extra
void main() {
    vec4 at = $at, eye = $mv * at;
    vec3 point = $point, eye_point = $eye_point;
    $local_varyings
    N = $normal;
    V = $view;
    for (int i = 0; i < $count; i++) {
        vec4 seen = $seen, lamp = $light;
        L[i] = $way;
        $each
    }
    $light_here
    gl_Position = $position;
    $end
}
"""
FRAGMENT = """$fragment_uniforms
$varyings
$extra
void main() {
    $light_in_fragment
    gl_FragColor = $out;
}
"""
LIGHTING = """vec3 n = $unit_normal;
    vec3 v = $unit_view;
    $flip
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    for (int i = $first; i < $last; i++) {
        vec3 way = L[i], l = $unit_light;
        float d = $distance, attenuation = $attenuation, spot = $spot;
        float nl = dot(n, l), D = $D;
        $mirror
        float base = $base, S = $S;
        diffuse $add $kept_d * D * $light_color;
        specular $add $kept_s * S * $light_specular;
        $after
    }
    vec3 color = $sum;"""

COMMON = {
    "extra": "", "each": "", "end": "", "after": "", "flat": "", "flip": "", "point": "eye.xyz", "eye_point": "eye.xyz", "to_eye": "-eye_point", "view": "$to_eye", "infinite": "vec3(0.0, 0.0, 1.0)",
    "both": "", "light": "seen",
    "way": "seen.w == 0.0 ? lamp.xyz : lamp.xyz - point", "position": "$pr * eye", "normal": "normalize($nm_n)", "unit_normal": "normalize(N)",
    "unit_view": "normalize(V)", "unit_light": "normalize(way)", "distance": "length(way)", "attenuation": "1.0 / ($a + $b * d + $c * d * d)",
    "spot": "1.0", "D": "max(nl, 0.0)", "mirror": "vec3 h = normalize(l + v);", "base": "dot(n, h)", "S": "nl > 0.0 ? pow(max(base, 0.0), $shininess) : 0.0",
    "add": "+=", "kept_d": "attenuation * spot", "kept_s": "attenuation * spot", "first": "0", "last": "$count", "sum": "$ambient + $kd * diffuse + $ks * specular",
    "light_color": "1.0", "light_specular": "1.0", "alpha": "1.0", "ambient": "vec3(0.0)", "out_color": "vec4(color, $alpha)", "mv_n": "($mv * vec4($n, 0.0)).xyz",
}
PHONG = {"mirror": "vec3 r = reflect(-l, n);", "base": "dot(r, v)"}
NYU = {
    "attributes": "attribute vec4 position, normal;", "at": "position", "n": "normal.xyz", "mv": "modelViewMatrix", "pr": "projectionMatrix",
    "nm_n": "(normalMatrix * vec4($n, 0.0)).xyz", "n_nm": "(vec4($n, 0.0) * normalMatrix).xyz", "shininess": "64.0", "kd": "uColor", "ks": "vec3(1.0)",
    "a": "1.0", "b": "0.54", "c": "0.2", "vertex_uniforms": "uniform mat4 modelViewMatrix, projectionMatrix, normalMatrix;\n$lights",
    "fragment_uniforms": "uniform vec3 uColor;\n$lights",
}
NYU_LIST = "struct Light { vec3 lightPosition, lightColor, specularLightColor; };\nuniform Light lights[$count];"
LAMBENT_LIST = """struct Light { vec4 position, direction, attenuation, cone, diffuse, specular; };
uniform Light lights[$count];"""
WORLD = {
    "attributes": "attribute vec3 aPos, aNormal;", "at": "vec4(aPos, 1.0)", "n": "aNormal", "mv": "model", "pr": "projection * view", "count": "1",
    "nm_n": "normalMatrix * $n", "n_nm": "$n * normalMatrix", "to_eye": "viewPos - eye_point",
    "infinite": "vec3(view[0].z, view[1].z, view[2].z)",
}
THREE = {
    "at": "vec4(position, 1.0)", "n": "normal", "attenuation": "1.0", "shininess": "shininess", "ambient": "ambientLightColor * diffuseColor",
    "kd": "diffuseColor", "ks": "specularColor", "fragment_uniforms": "uniform vec3 ambientLightColor, diffuseColor, specularColor; uniform float shininess;",
}

CONTRACTS = {
    "pittsburgh": {
        "attributes": "attribute vec4 vPosition, vNormal;", "at": "vPosition", "n": "vNormal.xyz", "mv": "model_view", "pr": "projection",
        "vertex_uniforms": "uniform mat4 model_view, projection; uniform mat3 normal_matrix; uniform vec4 light_position;",
        "fragment_uniforms": "uniform vec4 ambient_product, diffuse_product, specular_product;\n"
                             "uniform float shininess, attenuation_constant, attenuation_linear, attenuation_quadratic;",
        "nm_n": "normal_matrix * $n", "n_nm": "$n * normal_matrix", "seen": "model_view * light_position", "given": "light_position", "count": "1",
        "a": "attenuation_constant", "b": "attenuation_linear", "c": "attenuation_quadratic", "shininess": "shininess", "ambient": "ambient_product.rgb",
        "kd": "diffuse_product.rgb", "ks": "specular_product.rgb", "alpha": "diffuse_product.a"},
    "oregon": {
        "attributes": "", "at": "gl_Vertex", "n": "gl_Normal", "mv": "gl_ModelViewMatrix", "pr": "gl_ProjectionMatrix",
        "vertex_uniforms": "uniform float uLightX, uLightY, uLightZ;",
        "fragment_uniforms": "uniform float uKa, uKd, uKs, uShininess; uniform vec3 uColor, uSpecularColor;",
        "nm_n": "gl_NormalMatrix * $n", "n_nm": "$n * gl_NormalMatrix", "seen": "vec4(uLightX, uLightY, uLightZ, 1.0)", "count": "1", "attenuation": "1.0",
        "shininess": "uShininess", "ambient": "uKa * uColor", "kd": "uKd * uColor", "ks": "uKs * uSpecularColor", **PHONG},
    "nyu": {**NYU, "lights": NYU_LIST, "count": "2", "seen": "vec4(lights[i].lightPosition, 1.0)", "light_color": "lights[i].lightColor",
            "light_specular": "lights[i].specularLightColor"},
    "nyu-point": {**NYU, "lights": "uniform vec3 lightPosition, lightColor, specularLightColor;", "count": "1", "seen": "vec4(lightPosition, 1.0)",
                  "light_color": "lightColor", "light_specular": "specularLightColor"},
    "nyu-direction": {**NYU, "lights": "uniform vec3 lightDirection, lightColor, specularLightColor;", "count": "1", "seen": "vec4(lightDirection, 0.0)",
                      "light_color": "lightColor", "light_specular": "specularLightColor", "attenuation": "1.0"},
    "lambent": {
        "attributes": "attribute vec3 position, normal;", "at": "vec4(position, 1.0)", "n": "normal", "mv": "model_view", "pr": "projection",
        "vertex_uniforms": "uniform mat4 model_view, projection; uniform mat3 normal_matrix;\n" + LAMBENT_LIST,
        "fragment_uniforms": "struct Material { vec4 ambient, diffuse, specular; float shininess; };\nuniform Material material; uniform vec4 ambient_light;\n" +
                             LAMBENT_LIST,
        "nm_n": "normal_matrix * $n", "n_nm": "$n * normal_matrix", "seen": "lights[i].position", "count": "3", "a": "lights[i].attenuation.x",
        "b": "lights[i].attenuation.y", "c": "lights[i].attenuation.z", "shininess": "material.shininess", "ambient": "material.ambient.rgb * ambient_light.rgb",
        "kd": "material.diffuse.rgb", "ks": "material.specular.rgb", "alpha": "material.diffuse.a", "light_color": "lights[i].diffuse.rgb",
        "light_specular": "lights[i].specular.rgb", "flip": "n = gl_FrontFacing ? n : -n;", "cos": "dot(-l, lights[i].direction.xyz)",
        "spot": "lights[i].cone.x > -1.0 ? ($inside ? pow(max($cos, 0.0), $spot_exponent) : 0.0) : 1.0", "inside": "$cos >= lights[i].cone.x",
        "spot_exponent": "lights[i].cone.y"},
    "learnopengl": {
        **WORLD, "vertex_uniforms": "uniform mat4 model, view, projection; uniform mat3 normalMatrix;",
        "fragment_uniforms": "struct Material { vec3 ambient, diffuse, specular; float shininess; };\nuniform Material material;",
        "both": "struct Light { vec3 position, ambient, diffuse, specular; float constant, linear, quadratic; };\n"
                "uniform Light light; uniform vec3 viewPos;",
        "seen": "vec4(light.position, 1.0)", "a": "light.constant", "b": "light.linear", "c": "light.quadratic", "shininess": "material.shininess",
        "ambient": "light.ambient * material.ambient", "kd": "material.diffuse", "ks": "material.specular", "light_color": "light.diffuse",
        "light_specular": "light.specular", **PHONG},
    "learnopengl-basic": {
        **WORLD, "vertex_uniforms": "uniform mat4 model, view, projection; uniform mat3 normalMatrix;",
        "fragment_uniforms": "const float ambientStrength = 0.1, specularStrength = 0.5;\nuniform vec3 lightColor, objectColor;",
        "both": "uniform vec3 lightPos, viewPos;", "seen": "vec4(lightPos, 1.0)", "attenuation": "1.0", "shininess": "32.0",
        "ambient": "ambientStrength * lightColor * objectColor", "kd": "objectColor", "ks": "specularStrength * objectColor",
        "light_color": "lightColor", "light_specular": "lightColor", **PHONG},
    "angel": {
        "attributes": "attribute vec4 vPosition; attribute vec3 vNormal;", "at": "vPosition", "n": "vNormal", "mv": "ModelView", "pr": "Projection",
        "vertex_uniforms": "uniform mat4 ModelView, Projection; uniform mat3 NormalMatrix; uniform vec4 LightPosition;",
        "fragment_uniforms": "uniform vec4 AmbientProduct, DiffuseProduct, SpecularProduct; uniform float Shininess;",
        "nm_n": "NormalMatrix * $n", "n_nm": "$n * NormalMatrix", "seen": "LightPosition", "count": "1", "attenuation": "1.0", "shininess": "Shininess",
        "ambient": "AmbientProduct.rgb", "kd": "DiffuseProduct.rgb", "ks": "SpecularProduct.rgb"},
    "mdn": {
        "attributes": "attribute vec4 aVertexPosition; attribute vec3 aVertexNormal; attribute vec2 aTextureCoord;", "at": "aVertexPosition",
        "n": "aVertexNormal", "mv": "uModelViewMatrix", "pr": "uProjectionMatrix",
        "vertex_uniforms": "uniform mat4 uModelViewMatrix, uProjectionMatrix, uNormalMatrix;\nconst vec3 ambientLight = vec3(0.3, 0.3, 0.3);\n"
                           "const vec3 directionalLightColor = vec3(1.0, 1.0, 1.0);\nconst vec3 directionalVector = vec3(0.58, 0.55, 0.6);",
        "fragment_uniforms": "", "both": "varying vec2 vTextureCoord;", "each": "vTextureCoord = aTextureCoord;", "out_vertex": "uniform sampler2D uSampler;",
        "nm_n": "(uNormalMatrix * vec4($n, 0.0)).xyz", "n_nm": "(vec4($n, 0.0) * uNormalMatrix).xyz", "seen": "vec4(normalize(directionalVector), 0.0)",
        "count": "1", "attenuation": "1.0", "shininess": "1.0", "kd": "vec3(1.0)", "ks": "vec3(0.0)", "ambient": "ambientLight",
        "light_color": "directionalLightColor", "out_lit": "vec4(texture2D(uSampler, vTextureCoord).rgb * lit.rgb, 1.0)"},
    "threejs": {
        **THREE, "vertex_uniforms": "", "mv": "modelMatrix", "pr": "projectionMatrix * viewMatrix", "nm_n": "transpose(inverse(mat3(modelMatrix))) * $n",
        "n_nm": "$n * transpose(inverse(mat3(modelMatrix)))", "attributes": "", "to_eye": "cameraPosition - eye_point", "infinite": "$eye_axis",
        "eye_axis": "vec3(viewMatrix[0].z, viewMatrix[1].z, viewMatrix[2].z)", "both": "uniform vec3 lightPosition, lightColor;", "count": "1",
        "seen": "vec4(lightPosition, 1.0)", "light_color": "lightColor", "light_specular": "lightColor"},
    "threejs-raw": {
        **THREE, "attributes": "attribute vec3 position, normal;", "mv": "modelViewMatrix", "pr": "projectionMatrix", "nm_n": "normalMatrix * $n",
        "n_nm": "$n * normalMatrix", "vertex_uniforms": "uniform mat4 modelViewMatrix, projectionMatrix; uniform mat3 normalMatrix;",
        "both": "struct PointLight { vec3 position, color; };\nuniform PointLight pointLights[3];", "count": "3",
        "seen": "vec4(pointLights[i].position, 1.0)", "light_color": "pointLights[i].color", "light_specular": "pointLights[i].color"},
}
DIALECTS = {"oregon": ("", "110", "120") + dialects.COMPATIBILITY, "mdn": dialects.OLD, "threejs": ("",)}
LIST_EXTRA = "varying vec3 X[$count];"

P_ONLY, O_ONLY, M_ONLY, A_ONLY = ("pittsburgh",), ("oregon",), ("lambent",), ("angel",)
NYUS, LEARN, THREES = ("nyu", "nyu-point", "nyu-direction"), ("learnopengl", "learnopengl-basic"), ("threejs", "threejs-raw")
POSITION = ("oregon", "nyu", "nyu-point", "lambent") + LEARN + THREES  # lights are positions in lighting space
EYE_LIGHT = POSITION + A_ONLY  # or directions, depending on their w
ATTENUATED = ("pittsburgh", "nyu", "nyu-point", "lambent", "learnopengl")
MATERIAL = ("pittsburgh", "oregon", "lambent", "learnopengl", "angel") + THREES
BLINN = ("pittsburgh", "lambent", "angel") + NYUS + THREES
MIRROR = ("oregon",) + LEARN
TERMS = ("pittsburgh", "oregon", "lambent", "learnopengl", "angel") + THREES
EVERY = tuple(CONTRACTS)
ALL = tuple(c for c in EVERY if c != "mdn")  # with a highlight
SHINY = tuple(c for c in ALL if c != "learnopengl-basic")  # whose exponent is not a number in the text; any exponent is allowed
CLIP_LIGHT, CLIP_POINT, CLIP_EYE = {"light": "$pr * seen"}, {"point": "($pr * eye).xyz"}, {"eye_point": "($pr * eye).xyz"}
CLIP_NORMAL = {"normal": "normalize(($pr * $mv * vec4($n, 0.0)).xyz)"}
NO_GATE = {"S": "pow(max(base, 0.0), $shininess)"}


def exponent(text):
    return {"S": f"nl > 0.0 ? pow(max(base, 0.0), {text}) : 0.0"}


# (id, contracts, where: f(ragment), v(ertex) or both, parts). Parts may be a list: forms of one mistake. Ids after a blank are also
# right, because they draw the same picture in these shaders.
MISTAKES = [
    ("normal-not-unit", ALL, "f", {"unit_normal": "N"}),
    ("normal-not-unit", MIRROR, "f", {"unit_normal": "N", "mirror": "vec3 r = normalize(reflect(-l, n));"}),
    ("normal-unit-late", ALL, "f", {"normal": "$nm_n"}),
    ("normal-never-unit", EVERY, "fv", {"normal": "$nm_n", "unit_normal": "N"}),
    ("normal-never-unit", MIRROR, "fv", {"normal": "$nm_n", "unit_normal": "N", "mirror": "vec3 r = normalize(reflect(-l, n));"}),
    ("normal-by-model-view", EVERY, "fv", {"normal": "normalize($mv_n)"}),
    ("normal-by-inverse", EVERY, "fv", {"normal": "normalize($n_nm)"}),
    ("normal-by-transpose", EVERY, "fv", {"normal": "normalize((vec4($n, 0.0) * $mv).xyz)"}),
    ("normal-as-point", EVERY, "fv", {"normal": "normalize(($mv * vec4($n, 1.0)).xyz)"}),
    ("normal-object-space", EVERY, "fv", {"normal": "normalize($n)"}),
    ("normal-eye-space", ("threejs",), "fv", {"normal": "normalize(normalMatrix * $n)"}),
    ("normal-clip-space", EVERY, "fv", CLIP_NORMAL),
    ("normal-with-w", NYUS, "fv", {"normal": "normalize(normalMatrix * vec4($n, 0.0)).xyz", "unit_normal": "N"}),
    ("normal-with-w-vertex", NYUS, "f", {"normal": "normalize(normalMatrix * vec4($n, 0.0)).xyz"}),
    ("normal-inward", EVERY, "fv", {"normal": "-normalize($nm_n)"}),
    ("clip-space", ALL, "fv", {**CLIP_NORMAL, **CLIP_LIGHT, **CLIP_POINT, **CLIP_EYE}),
    ("clip-space-vectors", ALL, "fv", {**CLIP_LIGHT, **CLIP_POINT, **CLIP_EYE}),
    ("clip-space-vertex", ("pittsburgh",) + EYE_LIGHT, "fv", {**CLIP_POINT, **CLIP_EYE}),
    ("clip-space-light", ("pittsburgh",) + EYE_LIGHT, "fv", {**CLIP_LIGHT, **CLIP_POINT}),
    ("light-not-moved", P_ONLY, "fv", {"light": "$given"}),
    ("light-in-object-space", P_ONLY, "fv", {"light": "$given", "point": "at.xyz"}),
    ("light-moved-twice", EYE_LIGHT + ("nyu-direction",), "fv", {"light": "$mv * seen"}),
    ("point-in-object-space", POSITION + A_ONLY, "fv", {"point": "at.xyz", "eye_point": "at.xyz"}),
    ("light-from-object-space", EYE_LIGHT, "fv", {"point": "at.xyz"}),
    ("eye-from-object-space", ALL, "fv", {"eye_point": "at.xyz"}),
    ("all-in-object-space", P_ONLY, "fv", {"normal": "normalize($n)", "light": "$given", "point": "at.xyz", "eye_point": "at.xyz"}),
    ("direction-as-point", ("pittsburgh", "angel", "nyu-direction"), "fv", {"way": "lamp.xyz - point"}),
    ("direction-reversed light-backwards", ("nyu-direction", "mdn"), "fv", {"way": "-lamp.xyz"}),
    ("direction-reversed", P_ONLY + A_ONLY, "fv", {"way": "seen.w == 0.0 ? -lamp.xyz : lamp.xyz - point"}),
    ("light-backwards", ("pittsburgh",) + EYE_LIGHT, "fv", {"way": "seen.w == 0.0 ? -lamp.xyz : point - lamp.xyz"}),
    ("eye-backwards", BLINN, "fv", {"view": "-($to_eye)"}),
    ("reflect-sign", MIRROR, "fv", {"view": "-($to_eye)"}),
    ("viewer-infinite", ALL, "fv", {"view": "$infinite"}),
    ("light-not-unit", ("pittsburgh",) + EYE_LIGHT, "fv", {"unit_light": "way"}),
    ("light-not-unit", MIRROR, "fv", {"unit_light": "way", "mirror": "vec3 r = normalize(reflect(-l, n));"}),
    ("half-of-raw-light", ("pittsburgh", "nyu", "nyu-point", "lambent", "angel") + THREES, "fv", {"mirror": "vec3 h = normalize(way + v);"}),
    ("half-of-raw-eye", ALL, "fv", {"unit_view": "V"}),
    ("half-of-raw-both", ("pittsburgh", "nyu", "nyu-point", "lambent", "angel") + THREES, "fv", {"mirror": "vec3 h = normalize(way + V);"}),
    ("eye-at-origin", LEARN + ("threejs",), "fv", {"view": "-eye_point"}),
    ("half-not-unit", BLINN, "fv", {"mirror": "vec3 h = l + v;"}),
    ("half-is-mean", BLINN, "fv", {"mirror": "vec3 h = (l + v) / 2.0;"}),
    ("unit-too-early", ("pittsburgh",) + EYE_LIGHT, "f", {"extra": LIST_EXTRA, "each": "X[i] = L[i]; L[i] = normalize(L[i]);", "distance": "length(X[i])",
                                                          "view": "normalize($to_eye)"}),
    ("light-unit-too-early", ("pittsburgh",) + EYE_LIGHT, "f", {"extra": LIST_EXTRA, "each": "X[i] = L[i]; L[i] = normalize(L[i]);", "distance": "length(X[i])"}),
    ("eye-unit-too-early", ALL, "f", {"view": "normalize($to_eye)"}),
    ("half-in-vertex-shader", BLINN, "f", {"extra": LIST_EXTRA, "each": "X[i] = normalize(normalize(L[i]) + normalize(V));", "mirror": "vec3 h = normalize(X[i]);"}),
    ("reflection-in-vertex-shader", MIRROR, "f", {"extra": LIST_EXTRA, "each": "X[i] = reflect(-normalize(L[i]), N);", "mirror": "vec3 r = normalize(X[i]);"}),
    ("distance-interpolated", ATTENUATED, "f", {"extra": "varying float X[$count];", "each": "X[i] = length(L[i]);", "distance": "X[i]"}),
    ("no-attenuation", ATTENUATED, "fv", {"attenuation": "1.0"}),
    ("specular-not-attenuated", ATTENUATED, "fv", {"kept_s": "spot"}),
    ("diffuse-not-attenuated", ATTENUATED, "fv", {"kept_d": "spot"}),
    ("ambient-attenuated", P_ONLY + ("learnopengl",), "fv", {"extra": "float kept;", "kept_d": "(kept = attenuation)", "sum": "kept * $ambient + $kd * diffuse + $ks * specular"}),
    ("attenuation-swapped", ATTENUATED, "fv", {"attenuation": "1.0 / ($a + $c * d + $b * d * d)"}),
    ("attenuation-inverted", ATTENUATED, "fv", {"attenuation": "($a + $b * d + $c * d * d)"}),
    ("distance-for-its-square", ATTENUATED, "fv", {"attenuation": "1.0 / ($a + $b * d + $c * d)"}),
    ("distance-squared", ATTENUATED, "fv", {"distance": "dot(way, way)"}),
    ("distance-of-unit-vector", ATTENUATED, "fv", {"distance": "length(l)"}),
    ("inverse-square", ATTENUATED, "fv", {"attenuation": "1.0 / (d * d)"}),
    ("inverse-distance", ATTENUATED, "fv", {"attenuation": "1.0 / d"}),
    ("no-gate", ALL, "f", NO_GATE),
    ("no-gate", ("pittsburgh", "oregon", "nyu-direction", "angel") + LEARN + THREES, "v", NO_GATE),
    ("no-clamp", ("pittsburgh", "oregon", "nyu", "lambent", "angel", "mdn") + LEARN + THREES, "fv", {"D": "nl"}),
    ("lit-from-behind", ALL, "fv", {"D": "abs(nl)", "S": "pow(abs(base), $shininess)"}),
    ("abs-of-n.l", EVERY, "fv", {"D": "abs(nl)"}),
    ("half-lambert", EVERY, "fv", {"D": "0.5 * nl + 0.5"}),
    ("half-lambert-squared", EVERY, "fv", {"D": "pow(0.5 * nl + 0.5, 2.0)"}),
    ("n.l-squared", EVERY, "fv", {"D": "max(nl, 0.0) * max(nl, 0.0)"}),
    ("phong-lobe", BLINN, "fv", PHONG),
    ("blinn-phong-lobe", MIRROR, "fv", {"mirror": COMMON["mirror"], "base": COMMON["base"]}),
    ("shininess-times-4", SHINY, "fv", exponent("$shininess * 4.0")),
    ("shininess-quarter", SHINY, "fv", exponent("$shininess / 4.0")),
    ("shininess-multiplied", SHINY, "fv", [exponent("$shininess * 2.0"), exponent("$shininess * 3.0"), exponent("$shininess * 10.0")]),
    ("shininess-divided", SHINY, "fv", [exponent("$shininess / 2.0"), exponent("0.3 * $shininess"), exponent("$shininess / 8.0")]),
    ("shininess-constant", MATERIAL, "fv", [exponent("32.0"), exponent("16.0"), {"S": "nl > 0.0 ? max(base, 0.0) : 0.0"}]),
    ("blinn-phong-times-4", ("oregon", "learnopengl"), "fv", {"mirror": COMMON["mirror"], "base": COMMON["base"], **exponent("4.0 * $shininess")}),
    ("phong-quarter", BLINN, "fv", {**PHONG, **exponent("$shininess / 4.0")}),
    ("reflect-sign", MIRROR, "fv", {"mirror": "vec3 r = reflect(l, n);"}),
    ("specular-times-n.l", ALL, "fv", {"kept_s": "attenuation * spot * max(nl, 0.0)"}),
    ("kd-ks-swapped", P_ONLY + M_ONLY + A_ONLY + ("learnopengl",) + THREES, "fv", {"sum": "$ambient + $ks * diffuse + $kd * specular"}),
    ("kd-ks-swapped", O_ONLY, "fv", {"kd": "uKs * uColor", "ks": "uKd * uSpecularColor"}),
    ("ka-missing", O_ONLY, "fv", {"ambient": "uColor"}),
    ("kd-missing", O_ONLY, "fv", {"kd": "uColor"}),
    ("ks-missing", O_ONLY, "fv", {"ks": "uSpecularColor"}),
    ("ka-kd-swapped", P_ONLY, "fv", {"ambient": "diffuse_product.rgb", "kd": "ambient_product.rgb"}),
    ("ka-kd-swapped", A_ONLY, "fv", {"ambient": "DiffuseProduct.rgb", "kd": "AmbientProduct.rgb"}),
    ("ka-kd-swapped", ("learnopengl",), "fv", {"ambient": "light.ambient * material.diffuse", "kd": "material.ambient"}),
    ("ka-kd-swapped", O_ONLY, "fv", {"ambient": "uKd * uColor", "kd": "uKa * uColor"}),
    ("specular-tinted", P_ONLY + M_ONLY + NYUS + A_ONLY + ("learnopengl",) + THREES, "fv", {"sum": "$ambient + $kd * diffuse + $ks * $kd * specular"}),
    ("specular-tinted", O_ONLY, "fv", {"ks": "uKs * uSpecularColor * uColor"}),
    ("specular-in-diffuse-colour", P_ONLY + M_ONLY + A_ONLY + ("learnopengl",) + THREES, "fv", {"sum": "$ambient + $kd * diffuse + $kd * specular"}),
    ("specular-in-diffuse-colour", O_ONLY, "fv", {"ks": "uKs * uColor"}),
    ("light-colour-missing", NYUS + M_ONLY + ("learnopengl",) + THREES, "fv", {"light_color": "1.0"}),
    ("specular-light-as-diffuse", NYUS + M_ONLY + ("learnopengl",), "fv", {"light_specular": "$light_color"}),
    ("no-ambient", MATERIAL + ("learnopengl-basic", "mdn"), "fv", {"sum": "$kd * diffuse + $ks * specular"}),
    ("no-diffuse", EVERY, "fv", {"sum": "$ambient + $ks * specular"}),
    ("no-specular", ALL, "fv", {"sum": "$ambient + $kd * diffuse"}),
    ("ambient-for-each-light", M_ONLY + ("threejs-raw",), "fv", {"sum": "3.0 * $ambient + $kd * diffuse + $ks * specular"}),
    ("first-light-only one-light-too-few", ("nyu",), "fv", {"last": "1"}),
    ("last-light-only first-light-missing", ("nyu",), "fv", [{"add": "="}, {"first": "1"}]),
    ("first-light-only", M_ONLY + ("threejs-raw",), "fv", {"last": "1"}),
    ("last-light-only", M_ONLY + ("threejs-raw",), "fv", {"add": "="}),
    ("one-light-too-few", M_ONLY + ("threejs-raw",), "fv", {"last": "2"}),
    ("first-light-missing", M_ONLY + ("threejs-raw",), "fv", {"first": "1"}),
    ("no-cone", M_ONLY, "f", {"spot": "lights[i].cone.x > 1.0 ? 0.0 : 1.0"}),
    ("no-cutoff", M_ONLY, "f", {"inside": "true"}),
    ("no-spot-exponent", M_ONLY, "f", {"spot_exponent": "0.0001"}),
    ("cone-in-degrees", M_ONLY, "f", [{"inside": "degrees(acos($cos)) <= lights[i].cone.x"}, {"spot": "degrees(acos($cos)) <= lights[i].cone.x ? "
                                      "pow(max($cos, 0.0), $spot_exponent) : 0.0"}, {"inside": "$cos >= cos(radians(lights[i].cone.x))"}]),
    ("cone-by-acos", M_ONLY, "f", [{"inside": "acos($cos) <= lights[i].cone.x"}, {"inside": "$cos >= cos(lights[i].cone.x)"},
                                   {"spot": "acos($cos) < lights[i].cone.x ? pow(max($cos, 0.0), $spot_exponent) : 0.0"}]),
    ("cone-inside-out", M_ONLY, "f", [{"inside": "$cos < lights[i].cone.x"}, {"spot": "$cos < lights[i].cone.x ? pow(max($cos, 0.0), $spot_exponent) : 0.0"}]),
    ("cone-reversed", M_ONLY, "f", {"cos": "dot(l, lights[i].direction.xyz)"}),
    ("no-flip", M_ONLY, "f", {"flip": ""}),
    ("alpha-one", P_ONLY + M_ONLY, "fv", {"alpha": "1.0"}),
    ("vertex-colour-clamped", P_ONLY + A_ONLY, "v", {"sum": "clamp($ambient + $kd * diffuse + $ks * specular, 0.0, 1.0)"}),
    ("encoded", ALL, "fv", {"out_color": "vec4(pow(clamp(color, 0.0, 1.0), vec3(1.0 / 2.2)), $alpha)"}),
    # --- the position and its light
    ("point-as-direction", ("pittsburgh",) + EYE_LIGHT, "fv", {"way": "lamp.xyz"}),
    ("point-as-direction", ATTENUATED, "f", {"extra": "varying vec3 X[$count];", "each": "X[i] = lamp.xyz;", "unit_light": "normalize(X[i])"}),
    ("light-plus-point", ("pittsburgh",) + EYE_LIGHT, "fv", {"way": "seen.w == 0.0 ? lamp.xyz : lamp.xyz + point"}),
    ("point-transformed-twice", ("pittsburgh",) + EYE_LIGHT, "fv", {"point": "($mv * eye).xyz", "eye_point": "($mv * eye).xyz"}),
    ("position-as-normal", ALL, "fv", [{"normal": "normalize($at.xyz)"}, {"normal": "normalize(($mv * vec4($at.xyz, 0.0)).xyz)"},
                                         {"normal": "normalize(eye.xyz)"}, {"n": "$at.xyz"}]),
    ("normal-transformed-twice", EVERY, "fv", {"normal": "normalize($nm_twice)"}),
    ("normal-transformed-twice", EVERY, "fv", {"normal": "normalize(($mv * vec4($mv_n, 0.0)).xyz)"}),
    ("normal-flat", tuple(c for c in ALL if c != "threejs"), "f", {"flat": "flat"}),  # not in old versions
    # --- terms
    ("attenuation-twice", ATTENUATED, "fv", {"kept_d": "attenuation * attenuation * spot", "kept_s": "attenuation * attenuation * spot"}),
    ("ambient-times-n.l", ("pittsburgh", "oregon", "learnopengl", "angel", "threejs"), "fv",
     {"extra": "float lit_cosine;", "after": "lit_cosine = max(nl, 0.0);", "sum": "lit_cosine * $ambient + $kd * diffuse + $ks * specular"}),
    ("n.r-for-v.r", MIRROR, "fv", {"base": "dot(r, n)"}),
    ("v.h-for-n.h", BLINN, "fv", {"base": "dot(v, h)"}),
    ("ambient-twice", TERMS, "fv", {"sum": "$ambient + $ambient + $kd * diffuse + $ks * specular"}),
    ("ambient-halved", TERMS, "fv", {"sum": "0.5 * $ambient + $kd * diffuse + $ks * specular"}),
    ("diffuse-twice", TERMS + NYUS, "fv", {"sum": "$ambient + 2.0 * $kd * diffuse + $ks * specular"}),
    ("diffuse-halved", TERMS + NYUS, "fv", {"sum": "$ambient + $kd * diffuse / 2.0 + $ks * specular"}),
    ("specular-twice", TERMS + NYUS, "fv", {"sum": "$ambient + $kd * diffuse + $ks * specular + $ks * specular"}),
    ("specular-halved", TERMS + NYUS, "fv", {"sum": "$ambient + $kd * diffuse + 0.5 * $ks * specular"}),
    ("lights-averaged", ("nyu", "threejs-raw") + M_ONLY, "fv", {"sum": "$ambient + ($kd * diffuse + $ks * specular) / float($count)"}),
    ("lights-multiplied", ("nyu", "threejs-raw"), "fv", {"extra": "vec3 product;", "after": "product = (i == 0 ? vec3(1.0) : product) * "
                                                        "($kd * $kept_d * D * $light_color + $ks * $kept_s * S * $light_specular);", "sum": "$ambient + product"}),
    ("lights-multiplied", M_ONLY, "f", {"extra": "vec3 product;", "after": "product = (i == 0 ? vec3(1.0) : product) * "
                                        "($kd * $kept_d * D * $light_color + $ks * $kept_s * S * $light_specular);", "sum": "$ambient + product"}),
    ("channels-mixed", ALL, "fv", [{"out_color": "vec4(color.bgr, $alpha)"}, {"out_color": "vec4(color.rrr, $alpha)"}]),
    ("tone-curve", ALL, "fv", [{"out_color": "vec4(color / (color + 1.0), $alpha)"}, {"out_color": "vec4(1.0 - exp(-color), $alpha)"}]),
    ("upside-down", EVERY, "fv", {"end": "gl_Position.y = -gl_Position.y;"}),
]


def fill(text, parts):
    while "$" in text:
        text = string.Template(text).substitute(parts)
    return text


def shader(contract, stage, dialect, parts):
    """The texts of a shader. `stage` is f or v: the stage that computes the lighting."""
    all_parts = {**COMMON, **CONTRACTS[contract]}
    all_parts["nm_twice"] = all_parts["nm_n"].replace("$n", "(%s)" % all_parts["nm_n"])
    both = all_parts["both"]
    all_parts.update({"vertex_uniforms": all_parts["vertex_uniforms"] + "\n" + both, "fragment_uniforms": all_parts["fragment_uniforms"] + "\n" + both})
    all_parts.update({"varyings": "$flat varying vec3 N; varying vec3 V, L[$count];", "local_varyings": "", "light_here": "", "light_in_fragment": LIGHTING, "out": "$out_color"})
    if stage == "v":
        all_parts.update({"varyings": "varying vec4 lit;", "local_varyings": "vec3 N, V, L[$count];", "light_here": LIGHTING + " lit = $out_color;",
                          "light_in_fragment": "", "out": "lit", "vertex_uniforms": all_parts["vertex_uniforms"] + "\n" + all_parts["fragment_uniforms"],
                          "fragment_uniforms": "", "flip": "", "spot": "1.0", "unit_normal": "N"})
        for twice in ("$lights", LAMBENT_LIST, both):
            if twice and all_parts["vertex_uniforms"].count(twice) == 2:
                all_parts["vertex_uniforms"] = all_parts["vertex_uniforms"].replace(twice, "", 1)
        all_parts.update({"fragment_uniforms": all_parts.get("out_vertex", ""), "out": all_parts.get("out_lit", "lit")})
        if contract == "mdn":
            all_parts["fragment_uniforms"] += "\n" + both
    all_parts.update(parts)
    texts = {"vert": fill(VERTEX, all_parts), "frag": fill(FRAGMENT, all_parts)}
    return {ending: dialects.translate(text, ending, dialect, precision="highp") for ending, text in texts.items()}


def stages(contract):
    """With lighting per vertex, back faces need OpenGL's own two colours; MDN's lesson computes lighting per vertex."""
    return {"lambent": "f", "mdn": "v"}.get(contract, "fv")


def dialects_of(contract):
    return DIALECTS.get(contract, dialects.ALL)


def clashes(a, b):
    """Whether two mistakes cannot occur in one shader, or whether one hides the other."""
    groups = ("normal", "unit_normal", "flat", "n"), ("light", "point", "eye_point", "way", "view", "unit_view", "unit_light", "mirror", "base", "each"), \
        ("attenuation", "distance", "kept_d", "kept_s", "extra"), ("S", "mirror", "base"), ("sum", "kd", "ks", "ambient", "alpha", "out_color"), ("D", "S", "kept_s"), \
        ("first", "last", "add", "light_color", "light_specular", "after"), ("spot", "inside", "cos", "spot_exponent"), ("end", "flip")
    return any(set(group) & set(a) and set(group) & set(b) for group in groups)


# These mistakes hide others. A few mistakes are missing where they are invisible: an unclamped n.l that only darkens black, a highlight of
# exponent 64 between vertices, a light's direction in shaders with only point lights.
ALONE = {"normal-as-point", "no-diffuse", "no-specular", "encoded", "upside-down", "lit-from-behind", "normal-inward", "cone-reversed", "vertex-colour-clamped"}


def mutants(versions=20, several=4):
    """Yields (name, contract, stage, dialect, lists of right ids, texts): each mistake in each contract, and `several` shaders with two mistakes and
    with three mistakes in each contract and stage. Each is written in `versions` versions of GLSL, in rotation."""
    turn = 0
    for contract in CONTRACTS:
        for stage in stages(contract):
            rows = [(ids.split(), form) for ids, contracts, where, forms in MISTAKES if contract in contracts and stage in where
                    for form in (forms if isinstance(forms, list) else [forms])]
            sets = [(ids[0], [[one] for one in ids], form) for ids, form in rows]
            choose = random.Random(contract + stage)
            for count in (2, 3):
                made = 0
                while made < several:
                    some = choose.sample(rows, count)
                    if any(clashes(a[1], b[1]) for i, a in enumerate(some) for b in some[i + 1:]) or any(ids[0] in ALONE for ids, _ in some):
                        continue
                    parts = {}
                    for _, form in some:
                        parts.update(form)
                    right = [[]]
                    for ids, _ in some:
                        right = [known + [one] for known in right for one in ids]
                    sets.append((" ".join(ids[0] for ids, _ in some), right, parts))
                    made += 1
            for name, right, parts in sets:
                turn += 1
                known = [d for d in dialects_of(contract) if "flat" not in parts or d not in dialects.OLD]
                for dialect in [known[(turn + k * len(known) // min(versions, len(known))) % len(known)] for k in range(min(versions, len(known)))]:
                    yield name, contract, stage, dialect, right, shader(contract, stage, dialect, parts)


def correct():
    """Yields the templates without a mistake in the same way."""
    for contract in CONTRACTS:
        for stage in stages(contract):
            for dialect in dialects_of(contract):
                yield contract, stage, dialect, shader(contract, stage, dialect, {})


if __name__ == "__main__":
    target = pathlib.Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    for number, (name, contract, stage, dialect, _, texts) in enumerate(mutants()):
        for ending, text in texts.items():
            (target / re.sub(r"[^\w.-]+", "-", f"{number:05}-{contract}-{stage}-{dialect}-{name}.{ending}")).write_text(text)
