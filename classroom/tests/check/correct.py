"""correct.py: correct shaders in unusual valid styles, in every contract and many versions of GLSL. Each must pass.

SHADERS is a list of (name, options of the command line, {"vert": text, "frag": text}). All texts are original, in the styles of lectures, tutorials,
games and code golf. `python3 classroom/tests/check/correct.py FOLDER` writes them as files."""
import pathlib
import sys

import maps
from dialects import translate

FOLDER = pathlib.Path(__file__).parent


def read(name, ending):
    return (FOLDER / f"{name}.{ending}").read_text()


P_VERT, P_FRAG = read("pittsburgh", "vert"), read("pittsburgh", "frag")
P_UNIFORMS = """uniform vec4 ambient_product, diffuse_product, specular_product;
uniform float shininess, attenuation_constant, attenuation_linear, attenuation_quadratic;
"""
P_IN = "varying vec3 N, L, V;\n"
P_HEAD = P_UNIFORMS + P_IN
P_UNIT = "vec3 n = normalize(N), l = normalize(L), v = normalize(V); float d = length(L);\n"
P_ATT = "float att = 1.0 / (attenuation_constant + attenuation_linear * d + attenuation_quadratic * d * d);\n"
P_OUT = "gl_FragColor = vec4(ambient_product.rgb + att * (D * diffuse_product.rgb + S * specular_product.rgb), diffuse_product.a);\n"
O_VERT, O_FRAG = read("oregon", "vert"), read("oregon", "frag")
N_VERT, N_FRAG = read("nyu", "vert"), read("nyu", "frag")
M_VERT, M_FRAG = read("lambent", "vert"), read("lambent", "frag")
M_OLD = {"vert": M_VERT.replace("#version 330 core\n", "").replace("in vec3", "attribute vec3").replace("out vec3", "varying vec3"),
         "frag": M_FRAG.replace("#version 330 core\n", "").replace("\nin vec3", "\nvarying vec3").replace("out vec4 pixel;\n", "").replace("pixel", "gl_FragColor")}
SHADERS = []


def add(name, vert, frag, options="", dialect=None):
    texts = {"vert": vert, "frag": frag}
    if dialect is not None:
        texts = {ending: translate(text, ending, dialect) for ending, text in texts.items() if text}
    SHADERS.append((name, options.split(), {e: t for e, t in texts.items() if t}))


def p(name, body, head=P_HEAD, dialect="120", vert=P_VERT, options=""):
    """Pittsburgh's names, with a separate fragment shader."""
    add("pittsburgh " + name, vert, head + "void main() {\n" + body + "}\n", options, dialect)


# --- the versions of GLSL
for dialect in ("", "110", "130", "140", "150", "330 core", "400", "450", "330 compatibility", "100", "web", "300 es", "310 es"):
    add(f"pittsburgh in {dialect or 'no version'}", P_VERT, P_FRAG, "", dialect)
for dialect in ("110", "150", "300 es"):
    add(f"pittsburgh lit per vertex in {dialect}", read("pittsburgh-vertex", "vert"), read("pittsburgh-vertex", "frag"), "", dialect)
for dialect in ("110", "150", "100", "310 es"):
    add(f"nyu in {dialect}", N_VERT, N_FRAG, "", dialect)
for dialect in ("120", "140", "300 es"):
    add(f"lambent in {dialect}", M_OLD["vert"], M_OLD["frag"], "", dialect)
for dialect in ("130", "400 compatibility"):
    add(f"oregon in {dialect}", *(t.replace("330 compatibility", dialect) for t in (O_VERT, O_FRAG)))
smooth = [("flat out vec3 vNf, vLf, vEf;\n", ""), ("flat in vec3 vNf, vLf, vEf;\n", ""), ("out vec3", "varying vec3"), ("in vec3", "varying vec3"),
          ("    vNf = vNs;\n    vLf = vLs;\n    vEf = vEs;\n", ""), ("uniform bool uFlat;\n", ""), ("uFlat ? vNf : vNs", "vNs"),
          ("uFlat ? vLf : vLs", "vLs"), ("uFlat ? vEf : vEs", "vEs"), ("#version 330 compatibility", "#version 120")]
o_smooth = [O_VERT, O_FRAG]
for old, new in smooth:
    o_smooth = [t.replace(old, new) for t in o_smooth]
add("oregon without flat shading", *o_smooth)

# --- different ways to write one expression
p("on one line", "vec3 n=normalize(N),l=normalize(L),h=normalize(l+normalize(V));float d=length(L),q=dot(n,l);gl_FragColor=vec4(ambient_product.xyz+"
  "(max(q,0.)*diffuse_product.xyz+(q>0.?pow(max(dot(n,h),0.),shininess):0.)*specular_product.xyz)/(attenuation_constant+d*(attenuation_linear+d*"
  "attenuation_quadratic)),diffuse_product.w);\n")
p("gate by step", P_UNIT + P_ATT + "float nl = dot(n, l), D = clamp(nl, 0.0, 1.0);\n"
  "float S = step(0.0, nl) * pow(clamp(dot(n, normalize(l + v)), 0.0, 1.0), shininess);\n" + P_OUT)
p("gate by sign and mix", P_UNIT + P_ATT + "float nl = dot(n, l), D = 0.5 * (nl + abs(nl));\n"
  "float S = mix(0.0, pow(max(0.0, dot(n, normalize(l + v))), shininess), float(nl > 0.0));\n" + P_OUT)
p("exp2 and log2", P_UNIT + P_ATT + "float nl = dot(n, l), D = nl > 0.0 ? nl : 0.0, b = dot(n, normalize(v + l));\n"
  "float S = nl > 0.0 && b > 0.0 ? exp2(shininess * log2(b)) : 0.0;\n" + P_OUT)
p("inversesqrt", "float d2 = dot(L, L), i = inversesqrt(d2), d = d2 * i; vec3 n = N * inversesqrt(dot(N, N)), l = L * i, v = V / sqrt(dot(V, V));\n"
  "vec3 h = l + v; h /= length(h);\nfloat att = 1.0 / (attenuation_constant + attenuation_linear * d + attenuation_quadratic * d2);\n"
  "float D = max(dot(l, n), 0.0), S = D > 0.0 ? pow(max(dot(h, n), 0.0), shininess) : 0.0;\n" + P_OUT)
p("half vector without h", P_UNIT + P_ATT + "float D = max(dot(n, l), 0.0);\n"
  "float S = D > 0.0 ? pow(max((dot(n, l) + dot(n, v)) / sqrt(2.0 + 2.0 * dot(l, v)), 0.0), shininess) : 0.0;\n" + P_OUT)
p("arrays and loops", P_UNIT + P_ATT + "float weights[3]; vec3 colors[3]; colors[0] = ambient_product.rgb; colors[1] = diffuse_product.rgb;\n"
  "colors[2] = specular_product.rgb; weights[0] = 1.0; weights[1] = att * max(dot(n, l), 0.0);\n"
  "weights[2] = dot(n, l) > 0.0 ? att * pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\nvec3 sum = vec3(0.0);\n"
  "for (int i = 0; i < 3; ++i) { if (weights[i] <= 0.0) continue; sum += weights[i] * colors[i]; }\ngl_FragColor.bgr = sum.bgr; gl_FragColor.a = diffuse_product.a;\n")
p("out parameters, prototypes, overloads", "vec2 t; vec3 n; lit(t, n); float a = 1.0 / dot(k(), vec3(1.0, length(L), dot(L, L)));\n"
  "gl_FragColor = vec4(ambient_product.rgb, 0.0) + vec4(a * lit(t), diffuse_product.a);\n",
  P_HEAD + "void lit(out vec2 t, inout vec3 n); vec3 lit(const in vec2 t);\n"
  "vec3 k() { return vec3(attenuation_constant, attenuation_linear, attenuation_quadratic); }\n"
  "vec3 lit(const in vec2 t) { return t.s * diffuse_product.rgb + t[1] * specular_product.rgb; }\n"
  "void lit(out vec2 t, inout vec3 n) { n = normalize(N); vec3 l = normalize(L); t = vec2(max(dot(n, l), 0.0), 0.0);\n"
  "  if (t.x > 0.0) { t.y = pow(max(dot(n, normalize(l + normalize(V))), 0.0), shininess); } }\n")
p("structs", "Ray r = Ray(normalize(L), length(L)); Surface s = Surface(normalize(N), normalize(V)); gl_FragColor = sum(s, r);\n",
  P_HEAD + "struct Ray { vec3 way; float length; };\nstruct Surface { vec3 n, v; };\n"
  "vec4 sum(Surface s, Ray r) {\n float nl = dot(s.n, r.way); if (nl <= 0.0) return vec4(ambient_product.rgb, diffuse_product.a);\n"
  " float a = attenuation_constant + (attenuation_linear + attenuation_quadratic * r.length) * r.length;\n"
  " return vec4(ambient_product.rgb + (nl * diffuse_product.rgb + pow(max(dot(s.n, normalize(r.way + s.v)), 0.0), shininess) * specular_product.rgb) / a, diffuse_product.a); }\n")
p("macros", "gl_FragColor = vec4(AMB.rgb + FALL(length(L)) * (LAM * DIF.rgb + SPC * specular_product.rgb), DIF.a);\n",
  "#define AMB ambient_product\n#define DIF diffuse_product\n#define U(x) normalize(x)\n#define POS(x) max(x, 0.0)\n#define LAM POS(dot(U(N), U(L)))\n"
  "#define SPC (LAM > 0.0 ? pow(POS(dot(U(N), \\\n    U(U(L) + U(V)))), shininess) : 0.0)\n"
  "#define FALL(d) (1.0 / (attenuation_constant + attenuation_linear * (d) + attenuation_quadratic * (d) * (d)))\n" +
  P_HEAD.replace("ambient_product, diffuse_product", "AMB, DIF"))
p("the preprocessor", P_UNIT + "#if __VERSION__ >= 120 && !defined(NEVER)\n" + P_ATT + "#else\nfloat att = 0.5 /* wrong */;\n#endif\n#line 900\n"
  "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0; // a comment \\\n that goes on\n" + P_OUT,
  "/* * / */ // #version 330\n#extension GL_ARB_gpu_shader5 : disable\n#pragma optimize(on)\n#if 0\nthis is no GLSL at all ('\n#endif\n#ifdef NEVER\n"
  "uniform vec4 emission;\n#endif\n" + P_HEAD)
p("faceforward", P_UNIT + P_ATT + "n = faceforward(n, -v, n); float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" + P_OUT)
p("two sides by gl_FrontFacing", P_UNIT + P_ATT + "n *= gl_FrontFacing ? 1.0 : -1.0; float D = max(dot(n, l), 0.0);\n"
  "float S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" + P_OUT)
p("while, do, break", P_UNIT + P_ATT + "float D = 0.0, S = 0.0; int i = 0; while (true) { if (i++ > 0) break; D = max(dot(n, l), 0.0); }\n"
  "do { if (D <= 0.0) break; S = pow(max(dot(n, normalize(l + v)), 0.0), shininess); } while (false);\n" + P_OUT)
p("switch, integers, constants", P_UNIT + P_ATT + "float D = max(dot(n, l), zero), S; switch (int(D > zero)) { case 0: S = zero; break; default:\n"
  "S = pow(max(dot(n, normalize(l + v)), zero), shininess); }\nuint bits = 1u << 3u; if ((bits & 8u) == 0u) discard;\n" + P_OUT,
  P_HEAD + "const float zero = float(0); const vec2 unused[2] = vec2[2](vec2(1), vec2(2));\n", "330 core")
p("doubles", P_UNIT + "double e = length(dvec3(L)); float att = float(1.0 / (attenuation_constant + attenuation_linear * e + attenuation_quadratic * e * e));\n"
  "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" + P_OUT, dialect="400")
p("Phong's highlight", P_UNIT + P_ATT + "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(normalize(reflect(-l, n)), v), 0.0), shininess) : 0.0;\n" + P_OUT,
  options="--highlight phong")
p("gl_FragData", P_UNIT + P_ATT + "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" +
  P_OUT.replace("gl_FragColor", "gl_FragData[0]"))

# --- between the stages
add("pittsburgh with a matrix of varyings", """attribute vec3 vPosition, vNormal;
uniform mat4 model_view, projection; uniform mat3 normal_matrix; uniform vec4 light_position;
varying mat3 frame; invariant gl_Position;
void main() { vec4 p = model_view * vec4(vPosition, 1.0); vec4 q = model_view * light_position;
  frame = mat3(normalize(normal_matrix * vNormal), q.xyz - q.w * p.xyz, -p.xyz); gl_Position = projection * p; }
""", P_UNIFORMS + "varying mat3 frame;\nvoid main() { vec3 n = normalize(frame[0]), l = normalize(frame[1]), v = normalize(frame[2]); float d = length(frame[1]);\n" +
    P_ATT + "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" + P_OUT + "}\n", dialect="120")
add("pittsburgh with the light in the fragment shader", """attribute vec4 vPosition; attribute vec4 vNormal;
uniform mat4 model_view, projection;
varying vec4 at; varying vec3 N;
mat3 cofactors(mat3 m) { return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])); }
void main() { at = model_view * vPosition; N = normalize(cofactors(mat3(model_view)) * vNormal.xyz); gl_Position = projection * at; }
""", P_UNIFORMS + "uniform mat4 model_view; uniform vec4 light_position;\nvarying vec4 at; varying vec3 N;\nvoid main() {\n"
    "vec4 place = model_view * light_position; vec3 L = place.xyz - at.xyz * place.w, V = -at.xyz;\n" + P_UNIT + P_ATT +
    "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" + P_OUT + "}\n", dialect="120")
add("pittsburgh with blocks and locations", """#version 450 core
layout(location = 3) in vec4 vNormal; layout(location = 0) in vec4 vPosition;
layout(std140, binding = 1) uniform Matrices { mat4 model_view, projection; mat3 normal_matrix; } m;
layout(location = 7) uniform vec4 light_position;
layout(location = 2) smooth out vec3 out_n; layout(location = 0) out vec4 out_l; layout(location = 1) out vec3 out_p;
void main() { vec4 p = m.model_view * vPosition; out_p = p.xyz; out_n = normalize(m.normal_matrix * vNormal.xyz);
  out_l = m.model_view * light_position; gl_Position = m.projection * p; }
""", """#version 450 core
layout(std140) uniform Material { vec4 ambient_product; vec4 diffuse_product; vec4 specular_product; float shininess; };
uniform float attenuation_constant, attenuation_linear, attenuation_quadratic;
layout(location = 0) in vec4 in_l; layout(location = 1) in vec3 in_p; layout(location = 2) smooth in vec3 in_n;
layout(location = 0) out vec4 result;
void main() { vec3 L = in_l.xyz - in_l.w * in_p, N = in_n, V = -in_p;
""" + P_UNIT + P_ATT + "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" +
    P_OUT.replace("gl_FragColor", "result") + "}\n")
add("pittsburgh with a struct between the stages", """#version 330
in vec4 vPosition, vNormal; uniform mat4 model_view, projection, model_view_inverse_transpose; uniform vec4 light_position;
struct Point { vec3 n, l, v; }; out Point point;
void main() { vec4 p = model_view * vPosition, q = model_view * light_position;
  point = Point(normalize((model_view_inverse_transpose * vec4(vNormal.xyz, 0)).xyz), q.xyz - q.w * p.xyz, -p.xyz); gl_Position = projection * p; }
""", "#version 330\n" + P_UNIFORMS + "struct Point { vec3 n, l, v; }; in Point point; out vec4 c;\nvoid main() { vec3 N = point.n, L = point.l, V = point.v;\n" +
    P_UNIT + P_ATT + "float D = max(dot(n, l), 0), S = D > 0 ? pow(max(dot(n, normalize(l + v)), 0), shininess) : 0;\n" + P_OUT.replace("gl_FragColor", "c") + "}\n")
add("pittsburgh with a mark, CRLF and umlauts", "\ufeff" + P_VERT.replace("\n", "\r\n"), "\ufeff" + P_FRAG.replace("void main", "// Fl\u00e4che, \u5149\nvoid main").replace("\n", "\r\n"))
add("pittsburgh with a light that moves with the camera", P_VERT.replace("model_view * light_position", "light_position"), P_FRAG, "--light-frame camera")
add("pittsburgh without a vertex shader", None, P_HEAD + "void main() {\n" + P_UNIT + P_ATT +
    "float D = max(dot(n, l), 0.0), S = D > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), shininess) : 0.0;\n" + P_OUT + "}\n", dialect="web")
add("pittsburgh, diffuse and ambient light alone", P_VERT, "uniform vec4 ambient_product, diffuse_product;\nvarying vec3 N, L;\n"
    "uniform float attenuation_constant, attenuation_linear, attenuation_quadratic;\nvoid main() { float d = length(L);\n" + P_ATT +
    "gl_FragColor = vec4(ambient_product.rgb + att * max(dot(normalize(N), L / d), 0.0) * diffuse_product.rgb, diffuse_product.a); }\n", dialect="120")

# --- NYU's exercises: one term at a time, one light or a list
NYU_D = """attribute vec4 position; attribute vec4 normal; uniform mat4 modelViewMatrix, projectionMatrix, normalMatrix;
varying vec3 varyingNormal, varyingPosition;
void main() { vec4 p = modelViewMatrix * position; varyingPosition = p.xyz; varyingNormal = normalize((normalMatrix * normal).xyz);
  gl_Position = projectionMatrix * p; }
"""
N_IN = "varying vec3 varyingNormal, varyingPosition;\n"
add("nyu diffuse light, white", NYU_D, "uniform vec3 lightDirection, uColor;\n" + N_IN +
    "void main() { gl_FragColor = vec4(uColor * max(dot(normalize(varyingNormal), lightDirection), 0.0), 1.0); }\n", dialect="110")
add("nyu diffuse light, coloured", NYU_D, "uniform vec3 lightDirection, lightColor, uColor;\n" + N_IN +
    "void main() { gl_FragColor = vec4(lightColor * uColor * max(dot(normalize(varyingNormal), normalize(lightDirection)), 0.0), 1.0); }\n", dialect="web")
add("nyu specular light alone", NYU_D, "uniform vec3 lightDirection, specularLightColor;\n" + N_IN +
    "void main() { vec3 n = normalize(varyingNormal), v = normalize(-varyingPosition), h = normalize(lightDirection + v);\n"
    "float s = dot(n, lightDirection) > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0; gl_FragColor = vec4(specularLightColor * s, 1.0); }\n", dialect="120")
add("nyu specular light alone, white", NYU_D, "uniform vec3 lightDirection;\n" + N_IN +
    "void main() { vec3 n = normalize(varyingNormal), v = normalize(-varyingPosition), h = normalize(lightDirection + v);\n"
    "float s = dot(n, lightDirection) > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0; gl_FragColor = vec4(vec3(s), 1.0); }\n", dialect="150")
add("nyu with one colour for both terms", NYU_D, "uniform vec3 lightDirection, lightColor, uColor;\n" + N_IN +
    "void main() { vec3 n = normalize(varyingNormal), h = normalize(lightDirection - normalize(varyingPosition)); float d = max(dot(n, lightDirection), 0.0);\n"
    "gl_FragColor = vec4(lightColor * (uColor * d + (d > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0)), 1.0); }\n", dialect="120")
add("nyu with one point light", NYU_D, "uniform vec3 lightPosition, lightColor, specularLightColor, uColor;\n" + N_IN +
    "void main() { vec3 w = lightPosition - varyingPosition, l = normalize(w), n = normalize(varyingNormal), h = normalize(l - normalize(varyingPosition));\n"
    "float d = length(w), a = 1.0 / (1.0 + 0.54 * d + 0.2 * d * d), nl = max(dot(n, l), 0.0);\n"
    "gl_FragColor = vec4(a * (lightColor * uColor * nl + specularLightColor * (nl > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0)), 1.0); }\n", dialect="300 es")
add("nyu with a list of eight, mostly unused", N_VERT, N_FRAG.replace("lights[2]", "lights[COUNT]").replace("i < 2", "i < COUNT").replace(
    "struct Light", "#define COUNT 8\nstruct Light"))

# --- Lambent's own names
add("lambent with spots of a normalized axis", M_VERT, M_FRAG.replace("dot(-l, lights[i].direction.xyz)", "dot(l, normalize(-lights[i].direction.xyz))")
    .replace("float spot = 1.0;\n        if (lights[i].cone.x > -1.0)\n            spot =", "float spot ="))
add("lambent without a loop", M_VERT, M_FRAG.replace("void main()\n{", "vec3 one(Light light, vec3 n, vec3 v)\n{").replace(
    "    vec3 n = gl_FrontFacing ? normalize(eye_normal) : -normalize(eye_normal);\n    vec3 v = normalize(-eye_position);\n", "").replace(
    "vec3 color = material.ambient.rgb * ambient_light.rgb;", "vec3 color = vec3(0);").replace("for (int i = 0; i < 3; i++) {", "{").replace("lights[i]", "light").replace(
    "    pixel = vec4(color, material.diffuse.a);\n}", "    return color;\n}\n\nvoid main()\n{\n    vec3 n = normalize(eye_normal) * (gl_FrontFacing ? 1.0 : -1.0);\n"
    "    vec3 v = normalize(-eye_position);\n    pixel.a = material.diffuse.a;\n"
    "    pixel.rgb = material.ambient.rgb * ambient_light.rgb + one(lights[0], n, v) + one(lights[1], n, v) + one(lights[2], n, v);\n}"))
add("lambent with one directional light", M_VERT, """#version 330 core
struct Light { vec4 direction, diffuse, specular; };
uniform Light lights[1];
uniform struct { vec4 ambient, diffuse, specular; float shininess; } material;
uniform vec4 ambient_light;
in vec3 eye_position, eye_normal;
out vec4 o;
void main() {
    vec3 n = normalize(gl_FrontFacing ? eye_normal : -eye_normal), l = -lights[0].direction.xyz, h = normalize(l - normalize(eye_position));
    float d = max(dot(n, l), 0.0);
    o = material.ambient * ambient_light + lights[0].diffuse * material.diffuse * d;
    if (d > 0.0) o += lights[0].specular * material.specular * pow(max(dot(n, h), 0.0), material.shininess);
    o.a = material.diffuse.a;
}
""")
add("lambent turned to the eye", M_VERT, M_FRAG.replace("gl_FrontFacing ? normalize(eye_normal) : -normalize(eye_normal)",
                                                        "normalize(eye_normal); n = dot(n, eye_position) > 0.0 ? -n : n"))

# --- Oregon's names
add("oregon with its own reflection", o_smooth[0], o_smooth[1].replace("reflect(-l, n)", "2.0 * dot(l, n) * n - l").replace(
    "uKs * s * uSpecularColor", "uSpecularColor * (uKs * s)"))
add("oregon with a reflection made unit", o_smooth[0], o_smooth[1].replace("reflect(-l, n)", "normalize(reflect(-l, n))"))
add("oregon with a white highlight", o_smooth[0], o_smooth[1].replace("uniform vec3 uColor, uSpecularColor", "uniform vec3 uColor").replace("uSpecularColor", "vec3(1.0)"))
add("oregon lit per vertex", """#version 120
uniform float uKa, uKd, uKs, uShininess, uLightX, uLightY, uLightZ; uniform vec3 uColor, uSpecularColor; varying vec4 vColor;
void main() { vec3 p = vec3(gl_ModelViewMatrix * gl_Vertex), n = normalize(gl_NormalMatrix * gl_Normal), l = normalize(vec3(uLightX, uLightY, uLightZ) - p);
  float d = max(dot(n, l), 0.), s = d > 0. ? pow(max(dot(reflect(-l, n), -normalize(p)), 0.), uShininess) : 0.;
  vColor = vec4(uColor * (uKa + uKd * d) + uKs * s * uSpecularColor, 1.); gl_Position = ftransform(); }
""", "#version 120\nvarying vec4 vColor;\nvoid main() { gl_FragColor = vColor; }\n")

# --- written by a teacher independently of the others
add("learnopengl with numbers in the sum", """#version 330 core
layout (location = 0) in vec3 aPos;
layout (location = 1) in vec3 aNormal;
out vec3 FragPos; out vec3 Normal;
uniform mat4 model, view, projection;
void main() {
    mat3 nm = transpose(inverse(mat3(model)));
    FragPos = (model * vec4(aPos, 1)).xyz;
    Normal = normalize(nm * aNormal);
    gl_Position = projection * view * model * vec4(aPos, 1);
}
""", """#version 330 core
in vec3 FragPos; in vec3 Normal; out vec4 FragColor;
uniform vec3 lightPos, viewPos, lightColor, objectColor;
float lambert(vec3 n, vec3 l) { return clamp(dot(n, l), 0., 1.); }
void main() {
    vec3 N = normalize(Normal), L = normalize(lightPos - FragPos), V = normalize(viewPos - FragPos);
    vec3 R = 2. * dot(N, L) * N - L;
    float kd = lambert(N, L);
    float ks = kd <= 0. ? 0. : .7 * pow(clamp(dot(V, R), 0., 1.), 64.);
    FragColor = vec4((vec3(.2) + kd + ks) * lightColor * objectColor, 1.);
}
""")
add("pittsburgh with an interface block", """#version 150
in vec4 vPosition; in vec4 vNormal;
uniform mat4 model_view, projection; uniform mat3 normal_matrix; uniform vec4 light_position;
out Lighting { vec3 n; vec3 l; vec3 v; } to;
void main() {
    vec4 p = model_view * vPosition;
    to.n = normalize(normal_matrix * vNormal.xyz);
    vec4 lp = model_view * light_position;
    to.l = lp.xyz - lp.w * p.xyz;
    to.v = -p.xyz;
    gl_Position = projection * p;
}
""", """#version 150
in Lighting { vec3 n; vec3 l; vec3 v; } got;
uniform vec4 ambient_product, diffuse_product, specular_product;
uniform float shininess, attenuation_constant, attenuation_linear, attenuation_quadratic;
out vec4 colour;
float att(float d) { return 1.0 / dot(vec3(1.0, d, d * d), vec3(attenuation_constant, attenuation_linear, attenuation_quadratic)); }
void main() {
    vec3 n = normalize(got.n), l = normalize(got.l), h = normalize(l + normalize(got.v));
    float nl = dot(n, l);
    vec4 c = ambient_product;
    if (nl > 0.0) {
        float a = att(length(got.l));
        c += a * (nl * diffuse_product + pow(max(0.0, dot(n, h)), shininess) * specular_product);
    }
    colour = vec4(c.rgb, diffuse_product.a);
}
""")
add("angel with step and exp2", """#version 120
attribute vec4 vPosition; attribute vec3 vNormal;
uniform mat4 ModelView, Projection; uniform vec4 LightPosition; uniform mat3 NormalMatrix;
varying vec3 fN, fL, fE;
void main() {
    vec3 pos = (ModelView * vPosition).xyz;
    fN = normalize(NormalMatrix * vNormal); fE = -pos; fL = mix(LightPosition.xyz, LightPosition.xyz - pos, LightPosition.w);
    gl_Position = Projection * vec4(pos, 1.0);
}
""", """#version 120
varying vec3 fN, fL, fE;
uniform vec4 AmbientProduct, DiffuseProduct, SpecularProduct; uniform float Shininess;
void main() {
    vec3 N = normalize(fN), L = normalize(fL), E = normalize(fE);
    vec3 H = normalize(L + E);
    float Kd = max(dot(L, N), 0.0);
    float Ks = step(1e-9, dot(L, N)) * exp2(Shininess * log2(max(dot(N, H), 1e-20)));
    gl_FragColor = vec4((AmbientProduct + Kd * DiffuseProduct + Ks * SpecularProduct).rgb, 1.0);
}
""")
add("nyu with continue and division by the distance", """attribute vec4 position; attribute vec4 normal;
uniform mat4 modelViewMatrix, projectionMatrix, normalMatrix;
varying vec3 varyingNormal, varyingPosition;
void main() { vec4 p = modelViewMatrix * position; varyingPosition = p.xyz; varyingNormal = (normalMatrix * vec4(normal.xyz, 0.0)).xyz;
  varyingNormal = normalize(varyingNormal); gl_Position = projectionMatrix * p; }
""", """precision highp float;
varying vec3 varyingNormal, varyingPosition; uniform vec3 uColor;
struct Light { vec3 lightPosition; vec3 lightColor; vec3 specularLightColor; };
uniform Light lights[2];
void main() {
  vec3 n = normalize(varyingNormal), v = -normalize(varyingPosition), sum = vec3(0.0);
  for (int i = 0; i < 2; ++i) {
    vec3 d = lights[i].lightPosition - varyingPosition; float r = length(d); vec3 l = d / r;
    float a = 1.0 / (1.0 + 0.54 * r + 0.20 * pow(r, 2.0));
    float nl = dot(n, l); if (nl <= 0.0) continue;
    sum += a * (nl * lights[i].lightColor * uColor + pow(max(dot(n, normalize(v + l)), 0.0), 64.0) * lights[i].specularLightColor);
  }
  gl_FragColor = vec4(sum, 1.0);
}
""")

# --- metalness and roughness: forms that are equivalent to the expected one
B_VERT, B_FRAG = read("learnopengl-pbr", "vert"), read("learnopengl-pbr", "frag")
G_VERT, G_FRAG = read("gltf", "vert"), read("gltf", "frag")
H_VERT, H_FRAG = read("threejs-pbr", "vert"), read("threejs-pbr", "frag")
B_SUM = "4.0 * nl * nv + 0.0001"
B_TONE = "    color = color / (color + vec3(1.0));\n"
SMITH = """float masking(float cosine)
{
    float a = roughness * roughness;
    return 2.0 * cosine / max(cosine + sqrt(a * a + (1.0 - a * a) * cosine * cosine), 1e-6);
}
"""


def edit(text, *pairs):
    for old, new in pairs:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def between(text, start, end, new):
    return text[:text.index(start)] + new + text[text.index(end):]


add("learnopengl-pbr without a vertex shader", "", B_FRAG)
add("learnopengl-pbr with lights as a list of structs", B_VERT, edit(
    B_FRAG, ("uniform vec3 lightPositions[4];\nuniform vec3 lightColors[4];", "struct Light { vec3 position, color; };\nuniform Light lights[2];"),
    ("i < 4", "i < 2"), ("lightPositions[i]", "lights[i].position"), ("lightColors[i]", "lights[i].color")))
add("learnopengl-pbr with one light", B_VERT, edit(
    B_FRAG, ("uniform vec3 lightPositions[4];\nuniform vec3 lightColors[4];", "uniform vec3 lightPos, lightColor;"), ("i < 4", "i < 1"),
    ("lightPositions[i]", "lightPos"), ("lightColors[i]", "lightColor")))
add("learnopengl-pbr with lights that have pi in them", B_VERT, edit(B_FRAG, (" / PI + specular)", " + PI * specular)")))
add("learnopengl-pbr with lights that have pi in them, and sRGB", B_VERT, edit(
    B_FRAG, (" / PI + specular)", " + PI * specular)"),
    ("pow(color, vec3(1.0 / 2.2))", "mix(1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, 12.92 * color, lessThanEqual(color, vec3(0.0031308)))")))
add("learnopengl-pbr with another ambient light", B_VERT, edit(B_FRAG, ("vec3(0.03)", "vec3(0.1, 0.15, 0.2)")))
add("learnopengl-pbr without a tone curve", B_VERT, edit(B_FRAG, (B_TONE, "")))
add("learnopengl-pbr with an exponential tone curve", B_VERT, edit(B_FRAG, (B_TONE, "    color = vec3(1.0) - exp(-color);\n")))
add("learnopengl-pbr with a fit of ACES", B_VERT, edit(
    B_FRAG, (B_TONE, "    color = clamp(color * (2.51 * color + 0.03) / (color * (2.43 * color + 0.59) + 0.14), 0.0, 1.0);\n")))
add("learnopengl-pbr with Smith's masking as a product", B_VERT, between(B_FRAG, "float masking", "\nvoid main", SMITH))
add("learnopengl-pbr with correlated heights and glTF's diffuse part", B_VERT, edit(
    B_FRAG, ("float G = masking(nl) * masking(nv);", "float a2 = pow(roughness, 4.0), V = 0.5 / max(nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2), 1e-6);"),
    ("G * F / (" + B_SUM + ")", "(nv > 0.0 ? V : 0.0) * F"), ("(vec3(1.0) - F) * (1.0 - metallic)", "vec3(0.96 * (1.0 - pow(1.0 - max(dot(h, v), 0.0), 5.0)) * (1.0 - metallic))")))
add("gltf with n.v clamped, as Khronos has it", G_VERT, edit(G_FRAG, ("nv = abs(dot(n, v))", "nv = max(dot(n, v), 0.0)")))
add("gltf without a highlight where n.v is below 0", G_VERT, edit(G_FRAG, ("float shine = nl > 0.0 ?", "float shine = nl > 0.0 && dot(n, v) > 0.0 ?")))
add("gltf with Schlick's masking and the mixed F0", G_VERT, edit(
    G_FRAG, ("0.5 / (l + v) : 0.0", "1.0 / (4.0 * nl * nv + 0.0001) * nl * nv / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k)) : 0.0"),
    ("    return l + v > 0.0", "    float k = (u_RoughnessFactor + 1.0) * (u_RoughnessFactor + 1.0) / 8.0;\n    return l + v > 0.0"),
    ("mix(dielectric, metal, u_MetallicFactor)", "((1.0 - F) * (1.0 - u_MetallicFactor) * u_BaseColorFactor.rgb / M_PI + shine * F)"),
    ("        vec3 dielectric", "        vec3 F = mix(mix(vec3(0.04), u_BaseColorFactor.rgb, u_MetallicFactor), vec3(1.0), power);\n        vec3 dielectric")))
add("gltf with Reinhard's tone curve", G_VERT, edit(G_FRAG, ("pow(color,", "pow(color / (1.0 + color),")))
add("three.js, metalness and roughness, gamma-encoded", H_VERT, edit(
    H_FRAG, ("gl_FragColor = vec4(lightColor * dotNL * (diffuse + F * (V * D)), 1.0);", "gl_FragColor = vec4(pow(lightColor * dotNL * (diffuse + F * (V * D)), vec3(1.0 / 2.2)), 1.0);")))
add("three.js, metalness and roughness, as LearnOpenGL divides the diffuse part", H_VERT, edit(
    H_FRAG, ("vec3 diffuse = color *", "vec3 diffuse = (1.0 - F) * color *")))
add("three.js, metalness and roughness, lights with pi in them", H_VERT, edit(
    H_FRAG, ("(1.0 - metalness) * RECIPROCAL_PI", "(1.0 - metalness)"), ("F * (V * D)", "F * (V * D / RECIPROCAL_PI)")))
# --- maps
for name, shader, edits in maps.CORRECT:
    texts = {ending: read(shader, ending) for ending in ("vert", "frag")}
    for ending, old, new in edits:
        assert texts[ending].count(old) == 1, f"{name}: {old}"
        texts[ending] = texts[ending].replace(old, new)
    add(name, texts["vert"], texts["frag"])


if __name__ == "__main__":
    target = pathlib.Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    for name, options, texts in SHADERS:
        for ending, text in texts.items():
            (target / f"{name.replace(' ', '-').replace(',', '')}.{ending}").write_text(text, newline="")
    print(len(SHADERS), "shaders in", target)
