// fault.c: the table of known mistakes, their explanations and corrections.
//
// Most occur in lectures and tutorials (docs/mistakes.md shows them). Of two with the same picture the more common one
// comes first.
#include "fault.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define B(name) ((fault_set)1 << BIT_##name)

const struct fault faults[] = {
    // --- normals
    {"normal-not-unit", B(LONG_NORMAL), WHERE_FRAGMENT, 0,
     "the interpolated normal is not normalized again in the fragment shader; between vertices it is shorter than "
     "1",
     "vec3 n = normalize(N); // in the fragment shader, before any dot product"},
    {"normal-unit-late", B(LONG_NORMAL_VERTEX), WHERE_FRAGMENT, 0,
     "the normal is normalized only in the fragment shader; the matrix changes the lengths of normals, and longer "
     "ones weigh more between vertices",
     "N = normalize({normal_matrix} * {normal}); // in the vertex shader too"},
    {"normal-never-unit", B(LONG_NORMAL) | B(LONG_NORMAL_VERTEX), 0, 0,
     "the normal is never normalized, although the matrix changes its length",
     "N = normalize({normal_matrix} * {normal});"},
    {"normal-by-model-view", B(NORMAL_BY_MODEL), 0, 0,
     "the normal is transformed by the model-view matrix itself; with a non-uniform scale it then leans the wrong "
     "way",
     "N = normalize({normal_matrix} * {normal}); // the inverse transpose of {model_view}'s 3x3"},
    {"normal-object-space", B(NORMAL_OBJECT), 0, 0, "the normal stays in object space while the light is in eye space",
     "N = normalize({normal_matrix} * {normal});"},
    {"normal-clip-space", B(NORMAL_BY_MODEL) | B(NORMAL_CLIP), 0, 0,
     "the normal is multiplied by the projection; normals belong in eye space",
     "N = normalize({normal_matrix} * {normal}); // no projection"},
    {"normal-with-w", B(NORMAL_WITH_W) | B(LONG_NORMAL), 0, 0,
     "the normal is normalized with four components; the translation enters w and shortens it",
     "N = normalize(({normal_matrix4} * vec4({normal}, 0.0)).xyz); // .xyz first, then normalize"},
    {"normal-with-w-vertex", B(NORMAL_WITH_W), WHERE_FRAGMENT, 0,
     "the normal is normalized with four components in the vertex shader; the translation enters w, so each "
     "vertex's normal has another length, and longer ones weigh more between vertices",
     "N = normalize(({normal_matrix4} * vec4({normal}, 0.0)).xyz); // .xyz first, then normalize"},
    {"normal-inward", B(INWARD), 0, 0, "the normal points to the wrong side",
     "N = normalize({normal_matrix} * {normal}); // without the minus"},
    // --- spaces
    {"clip-space", B(NORMAL_BY_MODEL) | B(NORMAL_CLIP) | B(LIGHT_CLIP) | B(POINT_CLIP) | B(EYE_CLIP), 0, 0,
     "the lighting is computed after the projection; angles and distances mean nothing there",
     "vec3 P = ({model_view} * {position}).xyz; // light in eye space; {projection} only in gl_Position"},
    {"clip-space-four", B(NORMAL_BY_MODEL) | B(NORMAL_CLIP) | B(LIGHT_CLIP) | B(POINT_CLIP) | B(EYE_CLIP) | B(FOUR), 0,
     0,
     "the lighting is computed after the projection, with four-component vectors; angles and distances mean "
     "nothing there",
     "vec3 P = ({model_view} * {position}).xyz; // light in eye space, three components; {projection} only in "
     "gl_Position"},
    {"clip-space-vectors", B(LIGHT_CLIP) | B(POINT_CLIP) | B(EYE_CLIP), 0, 0,
     "l, v and the distance are computed after the projection",
     "vec3 P = ({model_view} * {position}).xyz; // light in eye space; {projection} only in gl_Position"},
    {"clip-space-vectors-four", B(LIGHT_CLIP) | B(POINT_CLIP) | B(EYE_CLIP) | B(FOUR), 0, 0,
     "l, v and the distance are computed after the projection, with four components",
     "vec3 P = ({model_view} * {position}).xyz; // light in eye space; {projection} only in gl_Position"},
    {"clip-space-vertex", B(POINT_CLIP) | B(EYE_CLIP), 0, 0,
     "the light is in eye space and the vertex in clip space; the two cannot be subtracted",
     "vec3 P = ({model_view} * {position}).xyz; // no projection"},
    {"clip-space-vertex-four", B(POINT_CLIP) | B(EYE_CLIP) | B(FOUR), 0, 0,
     "the light is in eye space and the vertex in clip space, with four components; the two cannot be subtracted",
     "vec3 P = ({model_view} * {position}).xyz; // no projection"},
    {"clip-space-light", B(LIGHT_CLIP) | B(POINT_CLIP), 0, 0, "l and the distance are computed after the projection",
     "vec3 L = {light_eye} - ({model_view} * {position}).xyz;"},
    {"light-not-moved", B(LIGHT_AS_GIVEN), WHERE_OBJECT_LIGHT, 0,
     "the light's position is in object space and is used as if it were in eye space; if the light should move "
     "with the camera, check with --light-frame camera",
     "vec3 L = ({model_view} * ({light} - {position})).xyz;"},
    {"light-in-object-space", B(LIGHT_AS_GIVEN) | B(LIGHT_FROM_OBJECT), WHERE_OBJECT_LIGHT, 0,
     "l is computed in object space, the normal in eye space", "vec3 L = ({model_view} * ({light} - {position})).xyz;"},
    {"light-moved-twice", B(LIGHT_TWICE), WHERE_EYE_LIGHT, 0,
     "the light is already in eye space and is transformed by the model-view matrix again",
     "vec3 L = {light_eye} - ({model_view} * {position}).xyz; // the light as given"},
    {"point-in-object-space", B(LIGHT_FROM_OBJECT) | B(EYE_FROM_OBJECT), 0, 0,
     "l and v are computed from the vertex before its model-view transformation",
     "vec3 P = ({model_view} * {position}).xyz;"},
    {"light-from-object-space", B(LIGHT_FROM_OBJECT), WHERE_EYE_LIGHT, 0,
     "l is the light in eye space minus the vertex before its model-view transformation",
     "vec3 L = {light_eye} - ({model_view} * {position}).xyz;"},
    {"eye-from-object-space", B(EYE_FROM_OBJECT), 0, 0,
     "v is computed from the vertex before its model-view transformation",
     "vec3 V = -({model_view} * {position}).xyz;"},
    {"all-in-object-space", B(NORMAL_OBJECT) | B(LIGHT_AS_GIVEN) | B(LIGHT_FROM_OBJECT) | B(EYE_FROM_OBJECT), 0, 0,
     "all lighting is computed in object space, with the eye at its origin",
     "vec3 P = ({model_view} * {position}).xyz; // N, L and V in eye space too"},
    {"direction-as-point", B(DIRECTION_AS_POINT), 0, NEED_DIRECTIONAL,
     "a directional light (w = 0) is treated as a point: the vertex is subtracted from a direction",
     "vec3 L = {light}.w == 0.0 ? {light_direction} : {light_eye} - P;"},
    {"direction-minus-point", B(DIRECTION_AS_POINT) | B(FOUR), 0, NEED_DIRECTIONAL,
     "a point is subtracted from a directional light (w = 0), and the resulting w of -1 counts in the length",
     "vec3 L = {light}.w == 0.0 ? {light_direction} : {light_eye} - P;"},
    {"direction-minus-origin", B(DIRECTION_MINUS_ORIGIN), 0, NEED_DIRECTIONAL,
     "0, 0, 0, 1 is subtracted from a directional light (w = 0) before it is normalized; the resulting w of -1 "
     "counts in the length, and l is too short",
     "vec3 L = {light_direction}; // .xyz alone, without a subtraction"},
    {"direction-reversed", B(DIRECTION_REVERSED), 0, NEED_DIRECTIONAL,
     "the directional light comes from the wrong side", "vec3 L = {light_direction}; // it points to the light"},
    {"light-backwards", B(LIGHT_BACKWARDS), 0, 0, "l points from the light to the surface",
     "vec3 L = {light_eye} - P; // light minus point"},
    {"eye-backwards", B(EYE_BACKWARDS), WHERE_BLINN, 0, "v points from the eye to the surface",
     "vec3 V = -P; // the eye is at the origin"},
    {"viewer-infinite", B(VIEWER_INFINITE), 0, 0,
     "v is the same at every point, as if the eye were infinitely far away", "vec3 V = normalize(-P);"},
    // --- lengths
    {"light-not-unit", B(LONG_LIGHT), 0, 0, "l is not normalized", "vec3 l = normalize(L);"},
    {"half-of-raw-light", B(RAW_HALF), WHERE_BLINN, 0, "the half vector is computed from l before it is normalized",
     "vec3 H = normalize(normalize(L) + normalize(V));"},
    {"half-of-raw-eye", B(LONG_EYE), 0, 0, "v is not normalized", "vec3 v = normalize(V);"},
    {"half-of-raw-both", B(LONG_EYE) | B(RAW_HALF), WHERE_BLINN, 0,
     "the half vector is computed from l and v before they are normalized",
     "vec3 H = normalize(normalize(L) + normalize(V));"},
    {"half-not-unit", B(HALF_LONG), WHERE_BLINN, 0, "the half vector is not normalized", "vec3 H = normalize(l + v);"},
    {"half-is-mean", B(HALF_MEAN), WHERE_BLINN, 0, "the half vector is (l + v)/2, which is shorter than 1",
     "vec3 H = normalize(l + v);"},
    {"unit-too-early", B(EARLY_LIGHT) | B(EARLY_EYE), WHERE_FRAGMENT, 0,
     "l and v are normalized in the vertex shader and then interpolated; on large triangles their directions are "
     "wrong",
     "L = {light_eye} - P; V = -P; // not normalized here, but in the fragment shader"},
    {"light-unit-too-early", B(EARLY_LIGHT), WHERE_FRAGMENT, 0,
     "l is normalized in the vertex shader and then interpolated; on large triangles its direction is wrong",
     "L = {light_eye} - P; // not normalized here, but in the fragment shader"},
    {"eye-unit-too-early", B(EARLY_EYE), WHERE_FRAGMENT, 0,
     "v is normalized in the vertex shader and then interpolated; on large triangles its direction is wrong",
     "V = -P; // not normalized here, but in the fragment shader"},
    // --- attenuation
    {"distance-interpolated", B(MEAN_DISTANCE), WHERE_FRAGMENT, NEED_ATTENUATION,
     "the distance is computed at the vertices and interpolated; it is not the distance of the point itself",
     "float d = length(L); // in the fragment shader, with L interpolated"},
    {"no-attenuation", B(BARE_DIFFUSE) | B(BARE_SPECULAR), 0, NEED_ATTENUATION, "the attenuation is missing",
     "color = ambient + (diffuse + specular) / ({a} + {b} * d + {c} * d * d);"},
    {"specular-not-attenuated", B(BARE_SPECULAR), 0, NEED_ATTENUATION, "the specular term is not attenuated",
     "specular *= 1.0 / ({a} + {b} * d + {c} * d * d);"},
    {"diffuse-not-attenuated", B(BARE_DIFFUSE), 0, NEED_ATTENUATION, "the diffuse term is not attenuated",
     "diffuse *= 1.0 / ({a} + {b} * d + {c} * d * d);"},
    {"ambient-attenuated", B(AMBIENT_ATTENUATED), 0, NEED_ATTENUATION | NEED_AMBIENT,
     "the ambient term is attenuated, although ambient light comes from everywhere",
     "color = ambient + attenuation * (diffuse + specular);"},
    {"attenuation-swapped", B(ATTENUATION_SWAPPED), 0, NEED_ATTENUATION,
     "the linear and the quadratic coefficient are swapped",
     "float attenuation = 1.0 / ({a} + {b} * d + {c} * d * d);"},
    {"attenuation-inverted", B(ATTENUATION_INVERTED), 0, NEED_ATTENUATION,
     "the light is multiplied by a + b d + c d^2 instead of divided",
     "float attenuation = 1.0 / ({a} + {b} * d + {c} * d * d);"},
    // --- terms
    {"no-gate", B(NO_GATE), 0, 0, "the highlight is kept where the surface faces away from the light (n.l <= 0)",
     "float s = dot(N, L) > 0.0 ? {S} : 0.0;"},
    {"no-clamp", B(NO_CLAMP), 0, 0, "n.l is not clamped at 0: the diffuse term subtracts light",
     "float d = max(dot(N, L), 0.0);"},
    {"lit-from-behind", B(ABSOLUTE), 0, 0, "abs() is used in place of max(): surfaces that face away are lit too",
     "float d = max(dot(N, L), 0.0);"},
    {"phong-lobe", B(OTHER_LOBE), WHERE_BLINN, 0,
     "the highlight is Phong's (r.v), but Blinn-Phong's (n.h) is expected; if the exercise asks for Phong's, "
     "check with --highlight phong",
     "float s = {S};"},
    {"blinn-phong-lobe", B(OTHER_LOBE), WHERE_PHONG, 0,
     "the highlight is Blinn-Phong's (n.h), but Phong's (r.v) is expected; if the exercise asks for "
     "Blinn-Phong's, check with --highlight blinn-phong",
     "float s = {S};"},
    {"shininess-times-4", B(SHININESS_4), 0, 0, "the exponent is four times too large",
     "float s = {S}; // the exponent as given"},
    {"shininess-quarter", B(SHININESS_QUARTER), 0, 0, "the exponent is four times too small",
     "float s = {S}; // the exponent as given"},
    {"blinn-phong-times-4", B(OTHER_LOBE) | B(SHININESS_4), WHERE_PHONG, 0,
     "the highlight is Blinn-Phong's with four times the exponent, which resembles Phong's but is not the same",
     "float s = {S};"},
    {"phong-quarter", B(OTHER_LOBE) | B(SHININESS_QUARTER), WHERE_BLINN, 0,
     "the highlight is Phong's with a quarter of the exponent, which resembles Blinn-Phong's but is not the same",
     "float s = {S};"},
    {"reflect-sign", B(REFLECT_SIGN), WHERE_PHONG, 0,
     "r.v has the wrong sign: reflect() takes the direction in which light travels, and v points to the eye",
     "vec3 R = reflect(-L, N), V = -P;"},
    {"specular-times-n.l", B(SPECULAR_TIMES_D), 0, 0, "the specular term is multiplied by n.l",
     "specular = {ks} * s; // not times dot(N, L)"},
    {"kd-ks-swapped", B(KD_KS_SWAPPED), 0, 0, "the diffuse and the specular colour are swapped",
     "color = ambient + {kd} * d + {ks} * s;"},
    {"ka-kd-swapped", B(KA_KD_SWAPPED), 0, NEED_AMBIENT, "the ambient and the diffuse colour are swapped",
     "color = {ka} + {kd} * d + {ks} * s;"},
    {"specular-tinted", B(SPECULAR_TINTED), 0, 0, "the highlight is also multiplied by the diffuse colour",
     "specular = {ks} * s; // not times {kd}"},
    {"specular-in-diffuse-colour", B(SPECULAR_AS_DIFFUSE), 0, 0, "the highlight has the diffuse colour",
     "specular = {ks} * s;"},
    {"no-ambient", B(NO_AMBIENT), 0, NEED_AMBIENT, "the ambient term is missing", "color = {ka} + diffuse + specular;"},
    {"no-diffuse", B(NO_DIFFUSE), 0, 0, "the diffuse term is missing", "color += {kd} * max(dot(N, L), 0.0);"},
    {"no-specular", B(NO_SPECULAR), 0, 0, "the specular term is missing", "color += {ks} * {S};"},
    {"ambient-for-each-light", B(AMBIENT_EACH_LIGHT), 0, NEED_LIGHTS, "the ambient term is added once for each light",
     "color = ambient; // once, before the loop over the lights"},
    {"first-light-only", B(FIRST_LIGHT_ONLY), 0, NEED_LIGHTS, "only the first light counts",
     "for (int i = 0; i < {count}; i++) // and add, do not assign"},
    {"last-light-only", B(LAST_LIGHT_ONLY), 0, NEED_LIGHTS,
     "only the last light counts: each one overwrites the one before",
     "color += ...; // in the loop: add, do not assign"},
    // --- spots, sides, output
    {"no-cone", B(NO_CONE), 0, NEED_SPOT, "the spot's cone is missing",
     "float spot = c >= cutoff ? pow(max(c, 0.0), exponent) : 0.0;"},
    {"no-cutoff", B(NO_CUTOFF), 0, NEED_SPOT, "the spot has no edge: the cutoff is missing",
     "float spot = c >= cutoff ? pow(max(c, 0.0), exponent) : 0.0;"},
    {"no-spot-exponent", B(NO_EXPONENT), 0, NEED_SPOT,
     "the spot is as bright at its edge as in the middle: the exponent is missing",
     "float spot = c >= cutoff ? pow(max(c, 0.0), exponent) : 0.0;"},
    {"no-flip", B(NO_FLIP), 0, NEED_TWO_SIDES, "back faces are lit with the normal of the front",
     "vec3 n = gl_FrontFacing ? normalize(N) : -normalize(N);"},
    {"smooth-for-flat", B(SMOOTH_FOR_FLAT), 0, NEED_FLAT, "flat shading is expected, but the values are interpolated",
     "vec3 n = normalize({flat} ? Nf : Ns); // with Nf declared flat; L and E likewise"},
    {"alpha-one", B(ALPHA_ONE), 0, NEED_ALPHA, "alpha is set to 1 instead of the diffuse alpha", "color.a = {kd}.a;"},
    {"alpha-summed", B(ALPHA_SUM), 0, NEED_ALPHA, "alpha is summed over the terms instead of being the diffuse alpha",
     "color.a = {kd}.a;"},
    {"vertex-colour-clamped", B(VERTEX_CLAMPED), WHERE_VERTEX, 0,
     "the colours of the vertices are clamped to 0...1 before interpolation, as gl_FrontColor does",
     "varying vec4 color; // your own varying in place of gl_FrontColor"},
    {"encoded", B(ENCODED), 0, 0, "the colour is gamma-encoded in the shader, but linear values are expected",
     "gl_FragColor = color; // no pow(color, 1/2.2)"},
    {"upside-down", B(UPSIDE_DOWN), 0, 0, "the picture is upside down",
     "gl_Position = {projection} * {model_view} * {position};"},
};
const int fault_count = sizeof faults / sizeof faults[0];

bool fault_applies(const struct fault *fault, const struct shader_interface *interface, lam_light_frame frame,
                   lam_reflection reflection, unsigned needs)
{
    unsigned here = (interface->vertex_lit ? WHERE_VERTEX : WHERE_FRAGMENT) |
                    (frame == LAM_FRAME_OBJECT ? WHERE_OBJECT_LIGHT : WHERE_EYE_LIGHT) |
                    (reflection == LAM_REFLECTION_PHONG ? WHERE_PHONG : WHERE_BLINN);
    return (fault->where & ~here) == 0 && (fault->needs & ~needs) == 0;
}

const char *lam_check_mistake(int index) { return index >= 0 && index < fault_count ? faults[index].id : NULL; }

const char *lam_check_mistake_explanation(int index)
{
    return index >= 0 && index < fault_count ? faults[index].explanation : NULL;
}

// --- expanding texts

static const struct {
    const char *place;
    enum uniform_semantic semantic;
    const char *fallback;
} places[] = {
    {"normal_matrix4", SEMANTIC_NORMAL_MATRIX, "normalMatrix"},
    {"normal", SEMANTIC_NORMAL, "gl_Normal"},
    {"position", SEMANTIC_POSITION, "gl_Vertex"},
    {"model_view", SEMANTIC_MODEL_VIEW, "gl_ModelViewMatrix"},
    {"projection", SEMANTIC_PROJECTION, "gl_ProjectionMatrix"},
    {"light", SEMANTIC_LIGHT_POSITION, "light"},
    {"ka", SEMANTIC_AMBIENT, "uKa * uColor"},
    {"kd", SEMANTIC_DIFFUSE, "uKd * uColor"},
    {"ks", SEMANTIC_SPECULAR, "uKs * uSpecularColor"},
    {"shininess", SEMANTIC_SHININESS, "64.0"},
    {"a", SEMANTIC_ATTENUATION_CONSTANT, "a"},
    {"b", SEMANTIC_ATTENUATION_LINEAR, "b"},
    {"c", SEMANTIC_ATTENUATION_QUADRATIC, "c"},
    {"count", SEMANTIC_LIGHT_COUNT, "LIGHTS"},
    {"flat", SEMANTIC_FLAT, "flat"},
};

struct line {
    const struct shader_interface *interface;
    lam_light_frame frame;
    lam_reflection reflection;
    char *out;
    size_t at, capacity;
};

__attribute__((format(printf, 2, 3))) static void put(struct line *line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(line->out + line->at, line->capacity - line->at, format, arguments);
    va_end(arguments);
    line->at = n < 0 || line->at + (size_t)n >= line->capacity ? line->capacity - 1 : line->at + (size_t)n;
}

static const char *own_name(const struct line *line, enum uniform_semantic semantic)
{
    return contract_name_used(line->interface->contract, semantic, &line->interface->vertex,
                              &line->interface->fragment);
}

static bool is_wide(const struct line *line, enum uniform_semantic semantic) // vec4 or mat4
{
    const char *name = own_name(line, semantic);
    const struct declarations *sides[] = {&line->interface->vertex, &line->interface->fragment};
    for (int s = 0; name && s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++)
            if (strcmp(sides[s]->items[i].name, name) == 0)
                return strchr(sides[s]->items[i].type, '4') != NULL;
    for (const struct contract_name *n = line->interface->contract->names; name && n->name; n++)
        if (strcmp(n->name, name) == 0)
            return strchr(n->type, '4') != NULL;
    return false;
}

// The light in eye space as a vec3: its position, or the unit direction to it.
static void put_light(struct line *line, bool direction)
{
    const char *name = own_name(line, SEMANTIC_LIGHT_POSITION), *unit = own_name(line, SEMANTIC_LIGHT_DIRECTION);
    const char *model_view = own_name(line, SEMANTIC_MODEL_VIEW);
    const char *open = direction ? "normalize(" : "", *close = direction ? ")" : "";
    if (direction && unit && !(line->interface->supports & NEED_POINT))
        put(line, "normalize(%s)", unit);
    else if (line->interface->contract->names[0].semantic == SEMANTIC_KA) // Oregon: three floats
        put(line, "vec3(uLightX, uLightY, uLightZ)");
    else if (line->frame == LAM_FRAME_OBJECT)
        put(line, "%s(%s * %s).xyz%s", open, model_view ? model_view : "gl_ModelViewMatrix", name ? name : "light",
            close);
    else
        put(line, "%s%s%s%s", open, name ? name : "light", is_wide(line, SEMANTIC_LIGHT_POSITION) ? ".xyz" : "", close);
}

static void put_normal_matrix(struct line *line)
{
    const char *name = own_name(line, SEMANTIC_NORMAL_MATRIX), *view = own_name(line, SEMANTIC_MODEL_VIEW);
    if (line->interface->contract->built_ins[0])
        put(line, "gl_NormalMatrix");
    else if (name && declarations_uses(&line->interface->vertex, name))
        put(line, is_wide(line, SEMANTIC_NORMAL_MATRIX) ? "mat3(%s)" : "%s", name);
    else
        put(line, "transpose(inverse(mat3(%s)))", view ? view : "model_view");
}

static void put_place(struct line *line, const char *place)
{
    const char *shininess = own_name(line, SEMANTIC_SHININESS);
    if (strcmp(place, "S") == 0)
        put(line, "pow(max(dot(%s), 0.0), %s)", line->reflection == LAM_REFLECTION_PHONG ? "R, V" : "N, H",
            shininess ? shininess : "64.0");
    else if (strcmp(place, "light_eye") == 0 || strcmp(place, "light_direction") == 0)
        put_light(line, strcmp(place, "light_direction") == 0);
    else if (strcmp(place, "normal_matrix") == 0)
        put_normal_matrix(line);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (strcmp(places[i].place, place) == 0) {
            const char *name = own_name(line, places[i].semantic);
            bool wide = name && is_wide(line, places[i].semantic);
            bool extend = name && places[i].semantic == SEMANTIC_POSITION && !wide;
            bool cut = places[i].semantic == SEMANTIC_NORMAL && wide;
            put(line, "%s%s%s", extend ? "vec4(" : "", name ? name : places[i].fallback,
                extend ? ", 1.0)"
                : cut  ? ".xyz"
                       : "");
        }
}

void fault_text(const char *template, const struct shader_interface *interface, lam_light_frame frame,
                lam_reflection reflection, char *out, size_t capacity)
{
    struct line line = {
        .interface = interface, .frame = frame, .reflection = reflection, .out = out, .capacity = capacity};
    out[0] = 0;
    for (const char *c = template; *c; c++) {
        const char *end = *c == '{' ? strchr(c, '}') : NULL;
        if (end) {
            char place[32];
            snprintf(place, sizeof place, "%.*s", (int)(end - c - 1), c + 1);
            put_place(&line, place);
            c = end;
        } else {
            put(&line, "%c", *c);
        }
    }
}
