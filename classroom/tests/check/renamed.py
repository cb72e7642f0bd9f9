#!/usr/bin/env python3
"""renamed.py PROGRAM [--every N] [--only TEXT]: right shaders in the forms of public repositories, and wrong ones, with their inputs renamed in four
ways, and the verdicts as a table. The exit code is 1 if a right shader differs, if a mistake gets a wrong name, or if too few have a verdict.

All texts are original; their forms are the forms of the pairs that docs/check/public.md lists. Each right shader is right because the normal is transformed
by the inverse transpose, all vectors are in one space and normalized, and the terms are sums of n.l and r.v or n.h."""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

EYE_VERT = """#version 330 core
in vec3 vertexPosition;
in vec3 vertexNormal;
uniform mat4 ModelViewMatrix, ProjectionMatrix;
uniform mat3 NormalMatrix;
out vec3 P;
out vec3 N;
void main() {
    vec4 p = ModelViewMatrix * vec4(vertexPosition, 1.0);
    P = p.xyz;
    N = normalize(NormalMatrix * vertexNormal);
    gl_Position = ProjectionMatrix * p;
}
"""
WORLD_VERT = """#version 330 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
uniform mat4 model, view, projection;
out vec3 FragPos;
out vec3 Normal;
void main() {
    FragPos = vec3(model * vec4(aPos, 1.0));
    Normal = mat3(transpose(inverse(model))) * aNormal;
    gl_Position = projection * view * vec4(FragPos, 1.0);
}
"""
ROWS_VERT = WORLD_VERT.replace("model * vec4(aPos, 1.0)", "vec4(aPos, 1.0) * model").replace(
    "mat3(transpose(inverse(model))) * aNormal", "aNormal * mat3(transpose(inverse(model)))").replace(
    "projection * view * vec4(FragPos, 1.0)", "vec4(aPos, 1.0) * model * view * projection")
OLD_VERT = """#version 120
varying vec3 n, p;
void main() {
    p = vec3(gl_ModelViewMatrix * gl_Vertex);
    n = gl_NormalMatrix * gl_Normal;
    gl_Position = ftransform();
}
"""
WEB_VERT = """attribute vec3 a_position;
attribute vec3 a_normal;
uniform mat4 u_world, u_worldViewProjection, u_worldInverseTranspose;
uniform vec3 u_lightWorldPosition, u_viewWorldPosition;
varying vec3 v_normal, v_surfaceToLight, v_surfaceToView;
void main() {
    gl_Position = u_worldViewProjection * vec4(a_position, 1.0);
    v_normal = mat3(u_worldInverseTranspose) * a_normal;
    vec3 surface = (u_world * vec4(a_position, 1.0)).xyz;
    v_surfaceToLight = u_lightWorldPosition - surface;
    v_surfaceToView = u_viewWorldPosition - surface;
}
"""
GOURAUD = """#version 330 core
in vec3 pos; in vec3 nrm;
uniform mat4 mv, proj; uniform mat3 nm;
uniform vec3 lightPos, ka, kd, ks; uniform float shine;
out vec3 color;
void main() {
    vec3 p = (mv * vec4(pos, 1.0)).xyz, n = normalize(nm * nrm), l = normalize(lightPos - p), v = normalize(-p);
    float d = max(dot(n, l), 0.0), s = d > 0.0 ? pow(max(dot(reflect(-l, n), v), 0.0), shine) : 0.0;
    color = ka + kd * d + ks * s;
    gl_Position = proj * vec4(p, 1.0);
}
"""
PLAIN_OUT = "#version 330 core\nin vec3 color; out vec4 f;\nvoid main() { f = vec4(color, 1.0); }\n"

EYE_HEAD = "#version 330 core\nin vec3 P; in vec3 N;\nout vec4 FragColor;\nuniform vec3 Ka, Kd, Ks;\nuniform float Shininess;\n"
WORLD_HEAD = "#version 330 core\nin vec3 FragPos; in vec3 Normal;\nout vec4 FragColor;\nuniform vec3 objectColor, lightColor, viewPos;\n"
BLINN = "pow(max(dot(n, normalize(l + v)), 0.0), Shininess)"
PHONG = "pow(max(dot(reflect(-l, n), v), 0.0), Shininess)"


def eye(uniforms, way, factor="1.0", lobe=BLINN, gate=True, rest=""):
    """Lighting in eye space: `way` is the vector to the light, `factor` multiplies diffuse and specular."""
    spec = f"d > 0.0 ? {lobe} : 0.0" if gate else lobe
    return EYE_VERT, EYE_HEAD + uniforms + f"""void main() {{
    vec3 n = normalize(N), v = normalize(-P), way = {way}, l = normalize(way);
    float r = length(way), d = max(dot(n, l), 0.0), s = {spec};
    vec3 c = Ka + {factor} * (Kd * d + Ks * s);
    {rest}
    FragColor = vec4(c, 1.0);
}}
"""


def world(uniforms, light, factor="1.0", exponent="32.0", rest="", vert=WORLD_VERT):
    return vert, WORLD_HEAD + uniforms + f"""void main() {{
    vec3 norm = normalize(Normal), toLight = {light}, lightDir = normalize(toLight), viewDir = normalize(viewPos - FragPos);
    float diff = max(dot(norm, lightDir), 0.0), spec = pow(max(dot(viewDir, reflect(-lightDir, norm)), 0.0), {exponent});
    vec3 result = (0.1 + {factor} * (diff + 0.5 * spec)) * lightColor * objectColor;
    {rest}
    FragColor = vec4(result, 1.0);
}}
"""


L = "uniform vec3 LightPosition;\n"
W = "uniform vec3 lightPos;\n"
LIGHTS = """struct Light { vec3 position; vec3 color; float linear; float quadratic; };
uniform Light lights[4]; uniform int count;
vec3 shade(Light light, vec3 n, vec3 v, vec3 p) {
    vec3 way = light.position - p; float r = length(way); vec3 l = way / r;
    float a = 1.0 / (1.0 + light.linear * r + light.quadratic * r * r), d = max(dot(n, l), 0.0);
    return a * light.color * (KD * d + KS * pow(max(dot(n, normalize(l + v)), 0.0), 24.0));
}
"""
RIGHT = {
    "eye blinn": eye(L, "LightPosition - P"),
    "eye phong": eye(L, "LightPosition - P", lobe=PHONG),
    "eye blinn without a gate": eye(L, "LightPosition - P", gate=False),
    "eye phong without a gate": eye(L, "LightPosition - P", lobe=PHONG, gate=False),
    "eye r by hand": eye(L, "LightPosition - P", lobe="pow(max(dot(2.0 * dot(n, l) * n - l, v), 0.0), Shininess)"),
    "light as a vec4": eye("uniform vec4 LightPosition;\n", "LightPosition.xyz - P"),
    "direction": eye("uniform vec3 LightDirection;\n", "LightDirection"),
    "direction reversed": eye("uniform vec3 LightDirection;\n", "-LightDirection"),
    "linear and quadratic": eye(L + "uniform float Linear, Quadratic;\n", "LightPosition - P", "(1.0 / (1.0 + Linear * r + Quadratic * r * r))"),
    "attenuation as numbers": eye(L, "LightPosition - P", "(1.0 / (1.0 + 0.09 * r + 0.032 * r * r))"),
    "attenuation as a vec3": eye(L + "uniform vec3 Attenuation;\n", "LightPosition - P", "(1.0 / dot(Attenuation, vec3(1.0, r, r * r)))"),
    "attenuation of the square": eye(L + "uniform float k;\n", "LightPosition - P", "(1.0 / (1.0 + k * dot(way, way)))"),
    "attenuation with a limit": eye(L + "uniform float k;\n", "LightPosition - P", "min(1.0, 1.0 / (0.3 + k * r * r))"),
    "attenuation with a radius": eye(L + "uniform float radius;\n", "LightPosition - P", "pow(clamp(1.0 - pow(r / (radius + 5.0), 4.0), 0.0, 1.0), 2.0) / (r * r + 1.0)"),
    "inverse square": eye(L, "LightPosition - P", "(1.0 / (r * r))"),
    "gamma at the end": eye(L, "LightPosition - P", rest="c = pow(c, vec3(1.0 / 2.2));"),
    "no highlight": (EYE_VERT, "#version 330 core\nin vec3 P; in vec3 N; out vec4 c; uniform vec3 LightPosition, Ka, Kd;\nvoid main() { c = vec4(Ka + Kd * max(0.0, dot(normalize(N), normalize(LightPosition - P))), 1.0); }\n"),
    "light moved by the view": eye("uniform mat4 View; uniform vec3 LightPosition;\n", "(View * vec4(LightPosition, 1.0)).xyz - P"),
    "exponent as an int": (EYE_VERT, eye(L, "LightPosition - P")[1].replace("float Shininess", "int Shininess").replace("0.0), Shininess)", "0.0), float(Shininess))")),
    "spot with a cutoff": eye(L + "uniform vec3 SpotDirection; uniform float SpotCutoff;\n", "LightPosition - P", "(dot(-l, normalize(SpotDirection)) > SpotCutoff ? 1.0 : 0.0)"),
    "spot with an exponent": eye(L + "uniform vec3 SpotDirection; uniform float SpotCutoff, SpotExponent;\n", "LightPosition - P",
                                 "(dot(-l, normalize(SpotDirection)) > SpotCutoff ? pow(dot(-l, normalize(SpotDirection)), SpotExponent) : 0.0)"),
    "spot with an angle": eye("struct Spot { vec3 position, direction; float falloff, cutoff; };\nuniform Spot spot;\n", "spot.position - P",
                              "(acos(dot(-l, normalize(spot.direction))) < radians(clamp(spot.cutoff, 0.0, 90.0)) ? pow(dot(-l, normalize(spot.direction)), spot.falloff) : 0.0)"),
    "fog": eye(L + "uniform vec3 FogColor; uniform float FogDensity;\n", "LightPosition - P", rest="c = mix(FogColor, c, exp(-FogDensity * -P.z));"),
    "two lights by hand": eye("uniform vec3 LightPosition, SecondPosition;\n", "LightPosition - P", rest="c += 0.4 * Kd * max(dot(n, normalize(SecondPosition - P)), 0.0);"),
    "functions": (EYE_VERT, EYE_HEAD + L + """float lambert(in vec3 n, in vec3 l) { return clamp(dot(n, l), 0.0, 1.0); }
float lobe(vec3 n, vec3 l, vec3 v) { vec3 h = normalize(l + v); return pow(clamp(dot(h, n), 0.0, 1.0), Shininess); }
void main() { vec3 n = normalize(N), l = normalize(LightPosition - P), v = normalize(-P);
    FragColor.rgb = Ka; FragColor.rgb += lambert(n, l) * Kd; if (lambert(n, l) > 0.0) { FragColor.rgb += lobe(n, l, v) * Ks; } FragColor.a = 1.0; }
"""),
    "macros": (EYE_VERT, EYE_HEAD + L + "#define SAT(x) clamp(x, 0.0, 1.0)\n#define DOT(a, b) SAT(dot(a, b))\nvoid main() { vec3 n = normalize(N), l = normalize(LightPosition - P); FragColor = vec4(Ka + DOT(n, l) * Kd + pow(DOT(n, normalize(l + normalize(-P))), Shininess) * Ks, 1.0); }\n"),
    "toon": eye(L, "LightPosition - P", rest="c = Ka + Kd * floor(d * 4.0) / 4.0 + Ks * step(0.5, s);"),
    "rim": eye(L, "LightPosition - P", rest="c += 0.3 * pow(1.0 - max(dot(n, v), 0.0), 3.0);"),
    "wrap": eye(L, "LightPosition - P", rest="c = Ka + Kd * (0.5 * dot(n, l) + 0.5);"),
    "hemisphere": eye("uniform vec3 LightPosition, Sky, Ground;\n", "LightPosition - P", rest="c += mix(Ground, Sky, 0.5 * dot(n, l) + 0.5);"),
    "rim by a power": eye(L, "LightPosition - P", rest="c += pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 2.0) * Kd;"),
    "fresnel": eye(L, "LightPosition - P", rest="c = Ka + Kd * d + Ks * s * (0.04 + 0.96 * pow(1.0 - max(dot(normalize(l + v), v), 0.0), 5.0));"),
    "hemisphere in the code": eye(L, "LightPosition - P", rest="c += Kd * (dot(n, vec3(0.0, 1.0, 0.0)) * 0.5 + 0.5);"),
    "two-sided": eye(L, "LightPosition - P", rest="if (!gl_FrontFacing) { c = vec3(0.0); }"),
    "world phong": world(W, "lightPos - FragPos"),
    "world with strengths": world(W + "uniform float ambientStrenth, specularStrenth, glossiness;\n", "lightPos - FragPos", exponent="glossiness"),
    "world with a direction": world("uniform vec3 lightDirection;\n", "-lightDirection"),
    "world spot": world("uniform vec3 lightPos, spotDirection; uniform float cutOff, outerCutOff;\n", "lightPos - FragPos",
                        "clamp((dot(lightDir, normalize(-spotDirection)) - outerCutOff) / (cutOff - outerCutOff), 0.0, 1.0)"),
    "world soft spot": world("uniform vec3 lightPos, spotDirection; uniform float cutOff, outerCutOff;\n", "lightPos - FragPos",
                             "smoothstep(outerCutOff, cutOff, dot(-lightDir, normalize(spotDirection)))"),
    "row vectors": world(W, "lightPos - FragPos", vert=ROWS_VERT),
    "light in the code": world("const vec3 lightPos = vec3(1.2, 1.0, 2.0);\n", "lightPos - FragPos"),
    "direction in the code": world("", "vec3(0.3, 0.9, 0.5)"),
    "world with fading light": world(W, "lightPos - FragPos", "(1.0 / (1.0 + 0.14 * length(toLight) + 0.07 * pow(length(toLight), 2.0)))"),
    "branch": world(W + "uniform bool blinn;\n", "lightPos - FragPos", rest="if (blinn) { result = 0.2 * objectColor + diff * objectColor + lightColor * pow(max(dot(norm, normalize(lightDir + viewDir)), 0.0), 16.0); }"),
    "texture": world(W + "uniform sampler2D image;\n", "lightPos - FragPos", rest="result *= texture(image, FragPos.xy).rgb;"),
    "array of lights": (WORLD_VERT, WORLD_HEAD + LIGHTS.replace("KD", "objectColor").replace("KS", "vec3(0.4)") + "void main() { vec3 n = normalize(Normal), v = normalize(viewPos - FragPos), sum = 0.05 * objectColor * lightColor;\n    for (int i = 0; i < count; i++) sum += shade(lights[i], n, v, FragPos);\n    FragColor = vec4(sum, 1.0); }\n"),
    "eye array of positions": (EYE_VERT, EYE_HEAD + "uniform vec3 LightPositions[3];\nvoid main() { vec3 n = normalize(N), v = normalize(-P), c = Ka;\n    for (int i = 0; i < 3; ++i) { vec3 l = normalize(LightPositions[i] - P); float d = max(dot(n, l), 0.0); c += Kd * d; if (d > 0.0) c += Ks * pow(max(dot(n, normalize(l + v)), 0.0), Shininess); }\n    FragColor = vec4(c, 1.0); }\n"),
    "sun and lamp": (WORLD_VERT, WORLD_HEAD + "struct Sun { vec3 direction; vec3 color; }; struct Lamp { vec3 position; vec3 color; float reach; };\nuniform Sun sun; uniform Lamp lamp;\nvec3 lit(vec3 n, vec3 l, vec3 v) { return objectColor * max(dot(n, l), 0.0) + pow(max(dot(v, reflect(-l, n)), 0.0), 20.0); }\nvoid main() { vec3 n = normalize(Normal), v = normalize(viewPos - FragPos), w = lamp.position - FragPos;\n    FragColor = vec4(0.1 * lightColor + sun.color * lit(n, normalize(-sun.direction), v) + lamp.color * lit(n, normalize(w), v) / (1.0 + lamp.reach * dot(w, w)), 1.0); }\n"),
    "struct of a material": (WORLD_VERT, WORLD_HEAD + W + "struct Material { vec3 ambient, diffuse, specular; float shininess; };\nuniform Material material;\nvoid main() { vec3 n = normalize(Normal), l = normalize(lightPos - FragPos), h = normalize(l + normalize(viewPos - FragPos));\n    FragColor = vec4(lightColor * (material.ambient + objectColor * material.diffuse * max(dot(n, l), 0.0) + material.specular * pow(max(dot(n, h), 0.0), material.shininess)), 1.0); }\n"),
    "web": (WEB_VERT, "precision mediump float;\nvarying vec3 v_normal, v_surfaceToLight, v_surfaceToView;\nuniform vec4 u_color; uniform float u_shininess;\nvoid main() { vec3 normal = normalize(v_normal), toLight = normalize(v_surfaceToLight), toView = normalize(v_surfaceToView), halfway = normalize(toLight + toView);\n    float light = max(dot(normal, toLight), 0.0), specular = 0.0; if (light > 0.0) { specular = pow(max(dot(normal, halfway), 0.0), u_shininess); }\n    gl_FragColor = u_color; gl_FragColor.rgb *= light; gl_FragColor.rgb += specular; }\n"),
    "old": (OLD_VERT, "#version 120\nvarying vec3 n, p;\nuniform vec3 lightPos; uniform vec4 diffuse, specular; uniform float shininess;\nvoid main() { vec3 N = normalize(n), L = normalize(lightPos - p), E = normalize(-p), R = normalize(-reflect(L, N));\n    gl_FragColor = diffuse * max(dot(N, L), 0.0) + specular * pow(max(dot(R, E), 0.0), 0.3 * shininess); }\n"),
    "gouraud": (GOURAUD, PLAIN_OUT),
    "gouraud cut off at 1": (GOURAUD.replace("kd * d + ks * s;", "kd * d + ks * s; color = min(color, vec3(1.0));"), PLAIN_OUT),
    "cut off at 1": eye(L, "LightPosition - P", rest="c = clamp(c + Kd, 0.0, 1.0);"),
    "prototypes": (EYE_VERT, EYE_HEAD + L + """float lambert(vec3 n, vec3 l);
void main() { vec3 n = normalize(N), l = normalize(LightPosition - P); FragColor = vec4(Ka + lambert(n, l) * Kd, 1.0); }
float lambert(vec3 n, vec3 l) { return max(dot(n, l), 0.0); }
"""),
    "vertices in world space": ("#version 330 core\nin vec3 p, n; uniform mat4 cameraView, lensProjection; out vec3 q, m;\nvoid main() { q = p; m = n; gl_Position = lensProjection * cameraView * vec4(p, 1.0); }\n",
                                "#version 330 core\nin vec3 q, m; uniform vec3 lamp, viewer, kd; out vec4 o;\nvoid main() { vec3 n = normalize(m), l = normalize(lamp - q), v = normalize(viewer - q); o = vec4(0.1 * kd + kd * max(dot(n, l), 0.0) + 0.3 * pow(max(dot(reflect(-l, n), v), 0.0), 12.0), 1.0); }\n"),
    "old colours": (OLD_VERT.replace("void main() {", "void main() {\n    gl_FrontColor = gl_Color;"),
                    "#version 120\nvarying vec3 n, p;\nuniform vec3 lightPos;\nvoid main() { gl_FragColor = gl_Color * (0.1 + max(dot(normalize(n), normalize(lightPos - p)), 0.0)); }\n"),
    "gouraud with a direction": (GOURAUD.replace("lightPos - p", "lightPos"), PLAIN_OUT),
    "gouraud in world space": ("#version 330 core\nin vec3 p, n; uniform mat4 M, V, P; uniform vec3 lamp, eye, kd, ks; out vec3 color;\nvoid main() { vec4 w = M * vec4(p, 1.0); vec3 N = normalize(transpose(inverse(mat3(M))) * n), L = normalize(lamp - w.xyz), H = normalize(L + normalize(eye - w.xyz)); color = 0.1 * kd + kd * max(dot(N, L), 0.0) + ks * pow(max(dot(N, H), 0.0), 40.0); gl_Position = P * V * w; }\n", PLAIN_OUT),
    "factors per vertex": (GOURAUD.replace("out vec3 color", "out float dd, ss").replace("color = ka + kd * d + ks * s;", "dd = d; ss = s;"), "#version 330 core\nin float dd, ss; out vec4 f; uniform vec3 ka, kd, ks;\nvoid main() { f = vec4(ka + kd * dd + ks * ss, 1.0); }\n"),
    "blocks": ("#version 330 core\nlayout(location = 0) in vec3 pos; layout(location = 1) in vec3 nrm;\nlayout(std140) uniform Camera { mat4 view; mat4 proj; vec3 eye; };\nuniform mat4 model;\nout Surface { vec3 p; vec3 n; } s;\nvoid main() { s.p = (model * vec4(pos, 1.0)).xyz; s.n = transpose(inverse(mat3(model))) * nrm; gl_Position = proj * view * vec4(s.p, 1.0); }\n",
               "#version 330 core\nin Surface { vec3 p; vec3 n; } s;\nlayout(std140) uniform Camera { mat4 view; mat4 proj; vec3 eye; };\nuniform vec3 lamp, kd, ks; out vec4 o;\nvoid main() { vec3 n = normalize(s.n), l = normalize(lamp - s.p), v = normalize(eye - s.p); o = vec4(kd * max(dot(n, l), 0.0) + ks * pow(max(dot(n, normalize(l + v)), 0.0), 50.0), 1.0); }\n"),
    "object space": ("attribute vec3 p, n; uniform mat4 mvp; varying vec3 q, m;\nvoid main() { q = p; m = n; gl_Position = mvp * vec4(p, 1.0); }\n",
                     "precision highp float; varying vec3 q, m; uniform vec3 lamp, eye, kd;\nvoid main() { vec3 n = normalize(m), l = normalize(lamp - q), v = normalize(eye - q); gl_FragColor = vec4(0.1 * kd + kd * max(dot(n, l), 0.0) + 0.3 * pow(max(dot(reflect(-l, n), v), 0.0), 12.0), 1.0); }\n"),
    "distant viewer": eye("uniform vec3 LightDirection;\n", "LightDirection", lobe="pow(max(dot(n, normalize(l + vec3(0.0, 0.0, 1.0))), 0.0), Shininess)"),
    "combined matrix": ("#version 330 core\nin vec3 p, n; uniform mat4 VP, M; uniform mat4 N; out vec3 q, m;\nvoid main() { vec4 w = M * vec4(p, 1.0); q = w.xyz; m = (N * vec4(n, 0.0)).xyz; gl_Position = VP * w; }\n",
                        "#version 330 core\nin vec3 q, m; uniform vec3 lamp, eye, tint; out vec4 o;\nvoid main() { vec3 n = normalize(m), l = normalize(lamp - q), v = normalize(eye - q), h = normalize(l + v); o = vec4(tint * (0.1 + max(dot(n, l), 0.0)) + 0.4 * pow(max(dot(h, n), 0.0), 64.0), 1.0); }\n"),
}

# Wrong shaders: (name of the right shader, ids that are true, edits).
WRONG = [
    ("eye blinn", {"normal-not-unit"}, [("frag", "n = normalize(N)", "n = N")]),
    ("eye blinn", {"normal-by-model-view"}, [("vert", "NormalMatrix * vertexNormal", "mat3(ModelViewMatrix) * vertexNormal")]),
    ("eye blinn", {"normal-object-space"}, [("vert", "NormalMatrix * vertexNormal", "vertexNormal")]),
    ("eye blinn", {"normal-inward"}, [("vert", "normalize(NormalMatrix * vertexNormal)", "-normalize(NormalMatrix * vertexNormal)")]),
    ("eye blinn", {"light-not-unit"}, [("frag", "l = normalize(way)", "l = way")]),
    ("eye blinn", {"half-not-unit"}, [("frag", "normalize(l + v)", "(l + v)")]),
    ("eye blinn", {"half-of-raw-eye"}, [("frag", "v = normalize(-P)", "v = -P")]),
    ("eye blinn", {"eye-backwards"}, [("frag", "v = normalize(-P)", "v = normalize(P)")]),
    ("eye blinn", {"light-backwards"}, [("frag", "way = LightPosition - P", "way = P - LightPosition")]),
    ("eye blinn", {"light-plus-point"}, [("frag", "way = LightPosition - P", "way = LightPosition + P")]),
    ("eye blinn", {"no-clamp"}, [("frag", "d = max(dot(n, l), 0.0)", "d = dot(n, l)")]),
    ("eye blinn", {"abs-of-n.l"}, [("frag", "d = max(dot(n, l), 0.0)", "d = abs(dot(n, l))")]),
    ("eye blinn", {"specular-times-n.l"}, [("frag", "Ks * s)", "Ks * s * d)")]),
    ("eye blinn", {"point-in-object-space", "eye-from-object-space", "light-from-object-space"}, [("vert", "P = p.xyz", "P = vertexPosition")]),
    ("eye blinn", {"clip-space-vectors", "clip-space-vertex"}, [("vert", "P = p.xyz", "P = (ProjectionMatrix * p).xyz")]),
    ("eye phong", {"reflect-sign", "eye-backwards"}, [("frag", "reflect(-l, n)", "reflect(l, n)")]),
    ("eye phong", {"n.r-for-v.r"}, [("frag", "dot(reflect(-l, n), v)", "dot(reflect(-l, n), n)")]),
    ("eye phong", {"eye-backwards", "reflect-sign"}, [("frag", "v = normalize(-P)", "v = normalize(P)")]),
    ("eye phong", {"normal-not-unit"}, [("frag", "n = normalize(N)", "n = N")]),
    ("eye phong", {"light-not-unit"}, [("frag", "l = normalize(way)", "l = way")]),
    ("world phong", {"normal-by-model-view"}, [("vert", "mat3(transpose(inverse(model)))", "mat3(model)")]),
    ("world phong", {"normal-object-space"}, [("vert", "mat3(transpose(inverse(model))) * aNormal", "aNormal")]),
    ("world phong", {"normal-by-inverse"}, [("vert", "mat3(transpose(inverse(model)))", "mat3(inverse(model))")]),
    ("world phong", {"normal-by-transpose"}, [("vert", "mat3(transpose(inverse(model)))", "mat3(transpose(model))")]),
    ("world phong", {"normal-as-point"}, [("vert", "mat3(transpose(inverse(model))) * aNormal", "(model * vec4(aNormal, 1.0)).xyz")]),
    ("world phong", {"eye-at-origin"}, [("frag", "normalize(viewPos - FragPos)", "normalize(-FragPos)"), ("frag", "(diff +", "(viewPos.x * diff +")]),
    ("world phong", {"light-backwards"}, [("frag", "toLight = lightPos - FragPos", "toLight = FragPos - lightPos")]),
    ("world phong", {"eye-backwards", "reflect-sign"}, [("frag", "normalize(viewPos - FragPos)", "normalize(FragPos - viewPos)")]),
    ("world phong", {"no-clamp"}, [("frag", "diff = max(dot(norm, lightDir), 0.0)", "diff = dot(norm, lightDir)")]),
    ("world phong", {"reflect-sign", "eye-backwards"}, [("frag", "reflect(-lightDir, norm)", "reflect(lightDir, norm)")]),
    ("world phong", {"point-in-object-space"}, [("vert", "FragPos = vec3(model * vec4(aPos, 1.0))", "FragPos = aPos"), ("vert", "vec4(FragPos, 1.0)", "model * vec4(aPos, 1.0)")]),
    ("old", {"normal-object-space"}, [("vert", "gl_NormalMatrix * gl_Normal", "gl_Normal")]),
    ("old", {"normal-not-unit", "normal-never-unit"}, [("frag", "N = normalize(n)", "N = n")]),
    ("web", {"light-not-unit"}, [("frag", "normalize(v_surfaceToLight)", "v_surfaceToLight")]),
    ("web", {"normal-by-model-view"}, [("vert", "mat3(u_worldInverseTranspose)", "mat3(u_world)")]),
    ("gouraud", {"normal-not-unit", "normal-never-unit"}, [("vert", "normalize(nm * nrm)", "nm * nrm")]),
    ("gouraud", {"light-backwards"}, [("vert", "lightPos - p", "p - lightPos")]),
    ("gouraud", {"eye-backwards", "reflect-sign"}, [("vert", "v = normalize(-p)", "v = normalize(p)")]),
    ("gouraud with a direction", {"no-clamp"}, [("vert", "max(dot(n, l), 0.0)", "dot(n, l)"), ("vert", "d > 0.0 ? pow(max(dot(reflect(-l, n), v), 0.0), shine) : 0.0", "0.0")]),
    ("vertices in world space", {"normal-object-space"}, [("vert", "cameraView, lensProjection", "move, viewAndLens"), ("vert", "lensProjection * cameraView", "viewAndLens * move")]),
    ("linear and quadratic", {"half-not-unit"}, [("frag", "normalize(l + v)", "(l + v)")]),
    ("array of lights", {"half-not-unit"}, [("frag", "normalize(l + v)", "(l + v)")]),
    ("world spot", {"reflect-sign", "eye-backwards"}, [("frag", "reflect(-lightDir, norm)", "reflect(lightDir, norm)")]),
    ("direction", {"normal-by-model-view"}, [("vert", "NormalMatrix * vertexNormal", "mat3(ModelViewMatrix) * vertexNormal")]),
    ("two lights by hand", {"normal-not-unit"}, [("frag", "n = normalize(N)", "n = N")]),
    ("toon", {"normal-not-unit", "normal-never-unit"}, [("frag", "n = normalize(N)", "n = N")]),
    ("toon", {"no-clamp"}, [("frag", "floor(d * 4.0)", "floor(dot(n, l) * 4.0)")]),
    ("rim by a power", {"normal-by-model-view"}, [("vert", "NormalMatrix * vertexNormal", "mat3(ModelViewMatrix) * vertexNormal")]),
    ("web", {"normal-by-model-view", "unit-too-early"}, [("vert", "mat3(u_worldInverseTranspose)", "mat3(u_world)"),
                                                         ("vert", "u_lightWorldPosition - surface", "normalize(u_lightWorldPosition - surface)"),
                                                         ("vert", "u_viewWorldPosition - surface", "normalize(u_viewWorldPosition - surface)")]),
    ("sun and lamp", {"reflect-sign", "eye-backwards"}, [("frag", "viewPos - FragPos", "FragPos - viewPos")]),
]

# Right shaders that are no sums of an ambient, a diffuse and a specular term: the last statements of the eye-space shader above. They may have no
# verdict, but never differ.
STYLES = {
    "gooch": "vec3 warm = Kd, cool = Ks; c = mix(cool, warm, 0.5 * (1.0 + dot(n, l)));",
    "half lambert": "float h = dot(n, l) * 0.5 + 0.5; c = Ka + Kd * h * h;",
    "wrap by an input": "c = Ka + Kd * max(0.0, (dot(n, l) + Shininess) / (1.0 + Shininess));",
    "wrap that is not clamped": "c = Ka + Kd * (dot(n, l) * Shininess + (1.0 - Shininess));",
    "soft border": "c = Ka + Kd * smoothstep(-0.2, 0.2, dot(n, l));",
    "both sides": "c = Ka + Kd * floor(abs(dot(n, l)) * 4.0) / 4.0;",
    "smooth rim": "c += smoothstep(0.6, 1.0, 1.0 - max(dot(v, n), 0.0)) * vec3(0.5);",
    "outline": "if (dot(n, v) < 0.3) c = vec3(0.0);",
    "ramp of branches": "float i = dot(n, l); c = i > 0.95 ? vec3(1.0, 0.5, 0.5) : i > 0.5 ? vec3(0.6, 0.3, 0.3) : vec3(0.2, 0.1, 0.1);",
    "reinhard": "c = c / (c + vec3(1.0));",
    "exposure": "c = vec3(1.0) - exp(-c * 1.5);",
    "minnaert": "c = Ka + Kd * pow(max(d * max(dot(n, v), 0.0), 0.0), 0.7) * d;",
    "schlick's lobe": "float x = max(dot(n, normalize(l + v)), 0.0); c = Ka + Kd * d + Ks * x / (8.0 - 7.0 * x);",
    "gaussian lobe": "float x = acos(clamp(dot(n, normalize(l + v)), 0.0, 1.0)) / 0.3; c = Ka + Kd * d + Ks * exp(-x * x);",
    "cook-torrance": "vec3 h = normalize(l + v); float nh = max(dot(n, h), 0.001), nv = max(dot(n, v), 0.001), vh = max(dot(v, h), 0.001);\n"
                     "float g = min(1.0, min(2.0 * nh * nv / vh, 2.0 * nh * d / vh)), f = 0.04 + 0.96 * pow(1.0 - vh, 5.0);\n"
                     "c = Ka + Kd * d + (d > 0.0 ? Ks * g * f * exp((nh * nh - 1.0) / (0.09 * nh * nh)) / (nh * nh * nh * nh * nv) : vec3(0.0));",
    "light from behind": "c += pow(clamp(dot(v, -normalize(l + n * 0.3)), 0.0, 1.0), 4.0) * Kd;",
    "scattering": "c += pow(clamp(dot(v, -l), 0.0, 1.0), 4.0) * Kd;",
    "headlight": "c = Kd * floor(4.0 * max(dot(n, v), 0.0)) / 4.0;",
    "turned to the eye": "vec3 m = faceforward(n, -v, n); c = Ka + Kd * max(dot(m, l), 0.0);",
    "posterized": "c = floor(c * 5.0) / 5.0;",
    "inverted": "c = 1.0 - c;",
}

FOREIGN = """augenPosition lichtPunkt farbe koerper glanz matriz vista proyeccion normales luz posicion kamera oeil modele brillo sombra couleur lumiere
observador richtung ecke welt sicht objekt regard punto direccion intensidad fuerza radio anzahl grundlicht streuung spiegelung""".split()
MISLEADING = """light eye color normal position camera shadow diffuse specular ambient texture view model projection world direction exponent
lightColor eyeColor lightDir viewDir spotLight sunPos lampColor cameraNormal halfVector shine strength radius cone cutoff range""".split()
WAYS = ("language", "letters", "misleading", "capitals")


def inputs(texts):
    """The names of uniforms, of attributes, and of the members of structs of uniforms."""
    found = []
    for ending, text in texts.items():
        plain = re.sub(r"//.*", "", text)
        kinds = "uniform|attribute|in" if ending == "vert" else "uniform"
        for body in re.findall(r"struct\s+\w+\s*\{(.*?)\}", plain, re.S) + re.findall(r"uniform\s+\w+\s*\{(.*?)\}", plain, re.S):
            for line in body.split(";"):
                found += re.findall(r"\w+", re.sub(r"^\s*\w+\s", "", re.sub(r"\[.*?\]", "", line)))
        for names in re.findall(r"(?:^|;|\)|\n)\s*(?:%s)\s+(?:highp\s+|mediump\s+)?\w+\s+([^;{(]+);" % kinds, plain):
            found += re.findall(r"\w+", re.sub(r"\[.*?\]", "", names))
    return list(dict.fromkeys(n for n in found if not n.startswith("gl_")))


def rename(texts, way, seed):
    names, rng = inputs(texts), random.Random(seed)
    taken = set(re.findall(r"\w+", " ".join(texts.values())))
    pool = {"language": FOREIGN, "letters": [a + b for a in "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ" for b in ("", "0", "1")],
            "misleading": MISLEADING, "capitals": [n.upper() + "_IN%d" % i for i, n in enumerate(names)]}[way]
    pool = [p for p in pool if p not in taken]
    if way != "capitals":
        rng.shuffle(pool)
    while len(pool) < len(names):
        pool.append("x%d" % len(pool))
    new = dict(zip(names, pool))
    return {e: re.sub(r"\b(%s)\b" % "|".join(map(re.escape, names)), lambda m: new[m[1]], t) if names else t for e, t in texts.items()}


def rows(only=""):
    """(kind, name, way, texts, true ids)"""
    for name, (vert, frag) in RIGHT.items():
        texts = {"vert": vert, "frag": frag}
        for way in ("own",) + WAYS:
            if only in name:
                yield "right", name, way, texts if way == "own" else rename(texts, way, name), set()
    for number, (name, ids, edits) in enumerate(WRONG):
        texts = {"vert": RIGHT[name][0], "frag": RIGHT[name][1]}
        for ending, old, new in edits:
            assert texts[ending].count(old) == 1, (name, old)
            texts[ending] = texts[ending].replace(old, new)
        for way in ("own",) + WAYS:
            if only in name:
                yield "wrong", f"{name}: {' '.join(sorted(ids))}", way, texts if way == "own" else rename(texts, way, number), ids


def judge(program, row, folder):
    kind, name, way, texts, ids = row
    for ending, text in texts.items():
        pathlib.Path(folder, "s." + ending).write_text(text)
    done = subprocess.run([program, "check", "s.frag", "--vertex", "s.vert", "--json", "-s", "48"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    report = json.loads(done.stdout or b"{}")
    names = [{m["id"], *(m["also"] or "").split()} for m in report.get("mistakes", [])]
    if "error" in report or not report:
        return "no verdict", report.get("error", {}).get("text", done.stderr.decode())[:150]
    if report["verdict"] in ("refused", "crashes", "endless"):
        return "error", str(report["notes"])[:200]
    if kind == "right":
        return ("passes", "") if report["verdict"] == "passes" else ("differs", " ".join(sorted(set().union(*names))))
    if report["verdict"] == "passes":
        return "passes", ""
    return ("true name", "") if any(n & ids for n in names) else ("wrong name" if names else "differs", " ".join(sorted(set().union(*names, set()))))


def main():
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("program")
    words.add_argument("--every", type=int, default=1)
    words.add_argument("--only", default="")
    words.add_argument("--jobs", type=int, default=2)
    words = words.parse_args()
    program, chosen = str(pathlib.Path(words.program).resolve()), list(rows(words.only))[::words.every]
    counts, bad = collections.defaultdict(collections.Counter), []

    def one(row):
        with tempfile.TemporaryDirectory(prefix="lambent-renamed-") as folder:
            return judge(program, row, folder)
    with concurrent.futures.ThreadPoolExecutor(words.jobs) as pool:
        for row, (verdict, detail) in zip(chosen, pool.map(one, chosen)):
            counts[row[0], row[2]][verdict] += 1
            counts[row[0], "all"][verdict] += 1
            if verdict not in ("passes", "true name") or (row[0] == "wrong" and verdict == "passes"):
                bad.append(f"  {row[0]}, {row[1]}, {row[2]}: {verdict} {detail}")
    print("| shaders | names | passes | true name | no verdict | differs | wrong name | error |\n|---|---|--:|--:|--:|--:|--:|--:|")
    for (kind, way), c in counts.items():
        print(f"| {kind} | {way} |", " | ".join(str(c[x]) for x in ("passes", "true name", "no verdict", "differs", "wrong name", "error")), "|")
    print("\n".join(bad))
    right, wrong = counts["right", "all"], counts["wrong", "all"]
    return int(right["differs"] + right["error"] + wrong["error"] + wrong["wrong name"] > 0 or right["passes"] < 0.85 * sum(right.values()) or
               wrong["true name"] < 0.8 * sum(wrong.values()))


if __name__ == "__main__":
    sys.exit(main())
