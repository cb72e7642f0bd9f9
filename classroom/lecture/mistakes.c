// mistakes.c: the known mistakes as edits of shaders in the lecture style (lecture.glsl). Most of these mistakes occur
// in lectures and tutorials (docs/mistakes.md). `lambent check` explains each mistake under the same id
// (classroom/check/diagnose/faults/fault_table.c).
#include <lambent/shader.h>

#include "fail.h"
#include "lecture.h"
#include "text_builder.h"

// Most rows omit some members.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EDITS_MAX = 2 };

// `before` occurs exactly once in the two source files of a shader to which the mistake applies. "@lights@" is the
// number of lights.
struct edit {
    const char *before, *after;
};

// Adjacent rows with the same id are forms of one mistake, and the first applicable form is used. Only the first of
// these rows contains the sentences. Forms for the C function of the application stage come last.
struct mistake {
    const char *id, *looks, *needs;
    struct edit edits[EDITS_MAX];
    const char *contains; // a text that the shader must contain, or NULL
    enum { ANY_LIGHTS, ONE_LIGHT, MORE_LIGHTS } lights;
};

#define PER_FRAGMENT "lighting in the fragment shader"
#define A_HIGHLIGHT  "a reflection model with a highlight"
#define BLINN        "the Blinn-Phong reflection model"
#define PHONG        "the Phong reflection model"
#define FALLOFF      "a light with attenuation"
#define PLACE        "a light with a position (point or spot)"
#define MATT         "a reflection model with max(n.l, 0)"
#define SEVERAL      "more than one light"
#define NORMAL       "normal_matrix * normal"
#define SUM          "attenuation * (diffuse + specular)"
#define C_NORMAL     "transform(draw->normal_matrix, vector(normal), 0.0)"
#define C_POINT      "transform(draw->model_view, vector(position), 1.0)"
#define C_EYE        "normalize(scale(-1.0, P)); // from the point to the eye"
#define C_HALF       "normalize(add(L, V))"
#define C_MIRROR     "subtract(scale(2.0 * dot(N, L), N), L)"
#define C_SUM        "scale(attenuation, add(diffuse, specular))"
#define C_SPOT_SUM   "scale(spot * attenuation, add(diffuse, specular))"

static const struct mistake mistakes[] = {
    // --- normals
    {"normal-not-unit",
     "The highlight is dim in the middle of large triangles, so the mesh becomes visible.",
     PER_FRAGMENT,
     {{"normalize(eye_normal); // interpolation made it shorter", "eye_normal;"}}},
    {"normal-by-model-view",
     "The mistake is invisible until an object is stretched; then the object looks as if the light were elsewhere.",
     NULL,
     {{NORMAL, "mat3(model_view) * normal"}}},
    {"normal-by-model-view", NULL, NULL, {{C_NORMAL, "transform(draw->model_view, vector(normal), 0.0)"}}},
    {"normal-object-space",
     "The light turns with the object: the same side of the model is lit from every viewpoint.",
     NULL,
     {{NORMAL, "normal"}}},
    {"normal-object-space", NULL, NULL, {{C_NORMAL, "vector(normal)"}}},
    {"normal-clip-space",
     "The lighting and the highlights are in the wrong position, and slide over the object when the camera moves.",
     NULL,
     {{NORMAL, "mat3(model_view_projection) * normal"}}},
    {"normal-as-point",
     "Nearly every normal points the same way, away from the eye: the object looks flat and dark.",
     NULL,
     {{NORMAL, "(model_view * vec4(normal, 1.0)).xyz"}}},
    {"normal-as-point", NULL, NULL, {{C_NORMAL, "transform(draw->model_view, vector(normal), 1.0)"}}},
    {"normal-inward",
     "The side that should be dark is lit, and the lit side is dark.",
     NULL,
     {{"normalize(" NORMAL ")", "-normalize(" NORMAL ")"}}},
    {"normal-inward", NULL, NULL, {{"normalize(" C_NORMAL ")", "scale(-1.0, normalize(" C_NORMAL "))"}}},
    {"no-flip",
     "The inside of open objects stays dark, or is lit like the outside.",
     "an object that is lit on both sides, in the fragment shader",
     {{"    if (!gl_FrontFacing)\n        N = -N;                     // the back is lit too\n", ""}}},
    {"no-flip", NULL, NULL, {{", scale(-1.0, N)", ", N"}}},
    // --- spaces
    {"clip-space-vertex",
     "Highlights and nearby lights are in the wrong position, and move when the field of view changes.",
     NULL,
     {{"eye_position = (model_view * ", "eye_position = (model_view_projection * "}}},
    {"point-in-object-space",
     "Nearby lights and highlights do not follow when the camera or the object moves.",
     "smooth shading, or GLSL above 120",
     {{"eye_position = (model_view * vec4(position, 1.0)).xyz", "eye_position = position"}}},
    {"point-in-object-space", NULL, NULL, {{"vec3 P = " C_POINT, "vec3 P = vector(position)"}}},
    {"eye-backwards",
     "The highlight is at the rim, or is missing.",
     BLINN,
     {{"normalize(-P);         // from the point to the eye", "normalize(P);"}},
     "normalize(L + V)"},
    {"eye-backwards", NULL, NULL, {{C_EYE, "normalize(P);"}}, "add(L, V)"},
    {"viewer-infinite",
     "Each highlight is slightly shifted, most visibly at the border of the picture.",
     A_HIGHLIGHT " and a local viewer",
     {{"normalize(-P);         // from the point to the eye", "vec3(0.0, 0.0, 1.0);"}}},
    {"viewer-infinite", NULL, NULL, {{C_EYE, "{0.0, 0.0, 1.0};"}}},
    // --- the light's direction
    {"light-backwards",
     "The object is lit from the other side.",
     PLACE,
     {{"lights[i].position.xyz - P", "P - lights[i].position.xyz"}}},
    {"light-backwards", NULL, NULL, {{"subtract(lights[i].position, P)", "subtract(P, lights[i].position)"}}},
    {"direction-reversed",
     "The object is lit from the other side.",
     "a directional light",
     {{"-lights[i].direction.xyz", "lights[i].direction.xyz"}}},
    {"direction-reversed", NULL, NULL, {{"scale(-1.0, lights[i].direction)", "lights[i].direction"}}},
    {"direction-as-point",
     "The distant light looks like a bulb near the object, because its light spreads.",
     "a directional light",
     {{"-lights[i].direction.xyz", "-lights[i].direction.xyz - P"}}},
    {"direction-as-point",
     NULL,
     NULL,
     {{"scale(-1.0, lights[i].direction)", "subtract(scale(-1.0, lights[i].direction), P)"}},
     "vec3 P = "},
    {"light-not-unit",
     "Distant lights are much too bright, and near lights are too dark.",
     PLACE,
     {{"normalize(way);    // from the point to the light", "way;"}},
     "lights[i].position"},
    // --- the highlight
    {"half-of-raw-light",
     "The highlight is larger and shifted towards the light, because a distant light outweighs the eye.",
     BLINN " and " PLACE,
     {{"normalize(L + V)", "normalize(way + V)"}},
     "lights[i].position.xyz"},
    {"half-of-raw-light", NULL, NULL, {{C_HALF, "normalize(add(way, V))"}}, "lights[i].position"},
    {"half-not-unit", "The highlight is blown out, and many times too large.", BLINN, {{"normalize(L + V)", "L + V"}}},
    {"half-not-unit", NULL, NULL, {{C_HALF, "add(L, V)"}}},
    {"half-is-mean",
     "The highlight is dim or missing, most visibly if the directions to the light and to the eye differ greatly.",
     BLINN,
     {{"normalize(L + V)", "(L + V) / 2.0"}}},
    {"half-is-mean", NULL, NULL, {{C_HALF, "scale(0.5, add(L, V))"}}},
    {"no-gate",
     "The highlight shines through the object: it also appears on surfaces that face away from the light.",
     A_HIGHLIGHT,
     {{" S = dot(N, L) > 0.0 ? pow", " S = pow"}, {"shininess) : 0.0;", "shininess);"}}},
    {"no-gate", NULL, NULL, {{" S = faces * pow", " S = pow"}}},
    {"phong-lobe",
     "The highlight is about half as wide as it should be.",
     BLINN,
     {{"max(dot(N, H), 0.0)", "max(dot(reflect(-L, N), V), 0.0)"}},
     "normalize(L + V)"},
    {"phong-lobe", NULL, NULL, {{"vec3 H = " C_HALF, "vec3 R = " C_MIRROR}, {"dot(N, H)", "dot(R, V)"}}},
    {"blinn-phong-lobe",
     "The highlight is about twice as wide as it should be.",
     PHONG,
     {{"max(dot(R, V), 0.0)", "max(dot(N, normalize(L + V)), 0.0)"}},
     "reflect(-L, N)"},
    {"blinn-phong-lobe", NULL, NULL, {{"vec3 R = " C_MIRROR, "vec3 H = " C_HALF}, {"dot(R, V)", "dot(N, H)"}}},
    {"reflect-sign", "The highlight is missing, or is on the far side.", PHONG, {{"reflect(-L, N)", "reflect(L, N)"}}},
    {"reflect-sign", NULL, NULL, {{C_MIRROR, "subtract(L, scale(2.0 * dot(N, L), N))"}}},
    {"shininess-times-4",
     "The highlight is half as wide as it should be.",
     A_HIGHLIGHT,
     {{"shininess) : 0.0;", "shininess * 4.0) : 0.0;"}}},
    {"shininess-times-4", NULL, NULL, {{"shininess);", "shininess * 4.0);"}}},
    {"shininess-quarter",
     "The highlight is twice as wide as it should be, and looks dull.",
     A_HIGHLIGHT,
     {{"shininess) : 0.0;", "shininess / 4.0) : 0.0;"}}},
    {"shininess-quarter", NULL, NULL, {{"shininess);", "shininess / 4.0);"}}},
    {"specular-times-n.l",
     "The highlight is weak if the light grazes the surface.",
     A_HIGHLIGHT,
     {{" * S;", " * S * max(dot(N, L), 0.0);"}}},
    {"specular-times-n.l", NULL, NULL, {{"specular = scale(S, ", "specular = scale(S * max(dot(N, L), 0.0), "}}},
    {"specular-tinted",
     "The highlight has the colour of the paint: plastic looks like metal.",
     A_HIGHLIGHT,
     {{"vec3 specular = ks", "vec3 specular = ks * kd"}}},
    {"specular-tinted", NULL, NULL, {{"specular_product[i].rgb", "specular_product[i].rgb * diffuse_product[i].rgb"}}},
    {"specular-tinted", NULL, NULL, {{"times(ks, lights[i].specular)", "times(ks, times(kd, lights[i].specular))"}}},
    {"specular-in-diffuse-colour",
     "The highlight has the colour and the strength of the paint.",
     A_HIGHLIGHT,
     {{"vec3 specular = ks", "vec3 specular = kd"}}},
    {"specular-in-diffuse-colour", NULL, NULL, {{"specular_product[i].rgb", "diffuse_product[i].rgb"}}},
    {"specular-in-diffuse-colour", NULL, NULL, {{"times(ks, lights[i].specular)", "times(kd, lights[i].specular)"}}},
    {"kd-ks-swapped",
     "The object has the colour of the highlight, and the highlight has the colour of the object.",
     A_HIGHLIGHT,
     {{"kd * lights[i].diffuse.rgb", "ks * lights[i].diffuse.rgb"},
      {"ks * lights[i].specular.rgb", "kd * lights[i].specular.rgb"}}},
    {"kd-ks-swapped",
     NULL,
     NULL,
     {{"diffuse_product[i].rgb * ", "specular_product[i].rgb * "},
      {"specular_product[i].rgb * S", "diffuse_product[i].rgb * S"}}},
    {"kd-ks-swapped",
     NULL,
     NULL,
     {{"times(kd, lights[i].diffuse)", "times(ks, lights[i].diffuse)"},
      {"times(ks, lights[i].specular)", "times(kd, lights[i].specular)"}}},
    // --- Lambert
    {"no-clamp",
     "The unlit side is black, because the negative diffuse term cancels ambient and other light.",
     MATT,
     {{"max(dot(N, L), 0.0); // Lambert", "dot(N, L); // Lambert"}}},
    {"no-clamp", NULL, NULL, {{"scale(max(dot(N, L), 0.0), times(kd", "scale(dot(N, L), times(kd"}}},
    {"abs-of-n.l",
     "The side that faces away from the light is as bright as the lit side.",
     MATT,
     {{"max(dot(N, L), 0.0); // Lambert", "abs(dot(N, L)); // Lambert"}}},
    {"abs-of-n.l", NULL, NULL, {{"scale(max(dot(N, L), 0.0), times(kd", "scale(fabs(dot(N, L)), times(kd"}}},
    // --- attenuation
    {"no-attenuation", "Near and distant surfaces are equally bright.", FALLOFF, {{SUM, "(diffuse + specular)"}}},
    {"no-attenuation", NULL, NULL, {{"attenuation * diffuse;", "diffuse;"}}},
    {"no-attenuation", NULL, NULL, {{C_SUM, "add(diffuse, specular)"}}},
    {"no-attenuation", NULL, NULL, {{"spot * attenuation, ", "spot, "}}},
    {"no-attenuation", NULL, NULL, {{"scale(attenuation, diffuse)", "diffuse"}}},
    {"specular-not-attenuated",
     "Highlights stay bright, however distant the light is.",
     FALLOFF " and a highlight",
     {{SUM, "(attenuation * diffuse + specular)"}}},
    {"specular-not-attenuated", NULL, NULL, {{C_SUM, "add(scale(attenuation, diffuse), specular)"}}},
    {"specular-not-attenuated", NULL, NULL, {{C_SPOT_SUM, "scale(spot, add(scale(attenuation, diffuse), specular))"}}},
    {"diffuse-not-attenuated",
     "The object stays bright, however distant the light is; only highlights fade.",
     FALLOFF " and a highlight",
     {{SUM, "(diffuse + attenuation * specular)"}}},
    {"diffuse-not-attenuated", NULL, NULL, {{C_SUM, "add(diffuse, scale(attenuation, specular))"}}},
    {"diffuse-not-attenuated", NULL, NULL, {{C_SPOT_SUM, "scale(spot, add(diffuse, scale(attenuation, specular)))"}}},
    {"ambient-attenuated",
     "Unlit sides become darker as the light moves away.",
     "one light, with attenuation, and a highlight",
     {{" + ambient;", ";"}, {SUM, "attenuation * (ambient + diffuse + specular)"}},
     NULL,
     ONE_LIGHT},
    {"ambient-attenuated",
     NULL,
     NULL,
     {{"add(draw->emission, ambient)", "draw->emission"},
      {C_SUM, "scale(attenuation, add(ambient, add(diffuse, specular)))"}},
     NULL,
     ONE_LIGHT},
    {"ambient-attenuated",
     NULL,
     NULL,
     {{"add(draw->emission, ambient)", "draw->emission"},
      {C_SPOT_SUM, "scale(attenuation, add(ambient, scale(spot, add(diffuse, specular))))"}},
     NULL,
     ONE_LIGHT},
    {"attenuation-swapped",
     "The light fades too slowly or too fast, because b and c are swapped.",
     FALLOFF,
     {{"a.y * d + a.z * d * d", "a.z * d + a.y * d * d"}}},
    {"attenuation-inverted",
     "The more distant the light, the brighter the surface, up to pure white.",
     FALLOFF,
     {{"1.0 / (a.x + a.y * d + a.z * d * d)", "a.x + a.y * d + a.z * d * d"}}},
    {"distance-of-unit-vector",
     "The light does not fade, because the distance is computed from L, whose length is 1.",
     FALLOFF,
     {{"length(way);", "length(L);"}}},
    // --- spotlights
    {"no-cone", "The spot light shines in all directions.", "a spotlight", {{"color += spot * ", "color += "}}},
    {"no-cone", NULL, NULL, {{"spot * attenuation, ", "attenuation, "}}},
    {"no-cone", NULL, NULL, {{"scale(spot, add(diffuse, specular))", "add(diffuse, specular)"}}},
    {"no-cone", NULL, NULL, {{"scale(spot, diffuse)", "diffuse"}}},
    {"no-cutoff",
     "The spot light has no visible edge.",
     "a spot light with a cutoff",
     {{"c >= cutoff ? pow(max(c, 1.0e-6), exponent) : 0.0", "pow(max(c, 1.0e-6), exponent)"}}},
    {"no-spot-exponent",
     "The spot light is as bright at its edge as in its middle.",
     "a spot light with a cutoff",
     {{"pow(max(c, 1.0e-6), exponent)", "1.0"}}},
    {"cone-inside-out",
     "The spot light lights everything except its cone.",
     "a spot light with a cutoff",
     {{"c >= cutoff", "c < cutoff"}}},
    // --- sums
    {"no-ambient", "Unlit sides are black.", NULL, {{" + ambient;", ";"}}},
    {"no-ambient", NULL, NULL, {{"add(draw->emission, ambient)", "draw->emission"}}},
    {"ambient-for-each-light",
     "Unlit sides become brighter with every additional light.",
     SEVERAL,
     {{"color += ", "color += ambient + "}, {" + ambient;", ";"}},
     NULL,
     MORE_LIGHTS},
    {"ambient-for-each-light",
     NULL,
     NULL,
     {{"color = add(color, ", "color = add(add(color, ambient), "}, {"add(draw->emission, ambient)", "draw->emission"}},
     NULL,
     MORE_LIGHTS},
    {"first-light-only",
     "Only the first light has an effect.",
     SEVERAL,
     {{"i < @lights@; i++) {\n        vec3 way", "i < 1; i++) {\n        vec3 way"}}},
    {"last-light-only",
     "Only the last light has an effect.",
     SEVERAL,
     {{"color += ", "color = material.emission.rgb + ambient + "}},
     "material.emission.rgb + ambient;",
     MORE_LIGHTS},
    {"last-light-only",
     NULL,
     NULL,
     {{"color += ", "color = emission.rgb + ambient + "}},
     "vec3 color = emission.rgb + ambient;",
     MORE_LIGHTS},
    {"last-light-only",
     NULL,
     NULL,
     {{"color = add(color, ", "color = add(add(draw->emission, ambient), "}},
     "= add(draw->emission, ambient)",
     MORE_LIGHTS},
    {"alpha-one", "Glass is opaque.", PER_FRAGMENT " of a translucent material", {{"material.diffuse.a)", "1.0)"}}},
    {"alpha-one", NULL, NULL, {{"), diffuse.a)", "), 1.0)"}}},
};
enum { MISTAKES = sizeof mistakes / sizeof *mistakes };

int mistake_find(const char *id)
{
    for (int i = 0; id && i < MISTAKES; i++)
        if (strcmp(mistakes[i].id, id) == 0)
            return i + 1;
    return 0;
}

// Returns the row after the rows with the same id.
static int next_id(int row)
{
    const char *id = mistakes[row].id;
    while (row < MISTAKES && strcmp(mistakes[row].id, id) == 0)
        row++;
    return row;
}

bool lam_shader_mistake_row(int row, lam_shader_mistake *mistake)
{
    int at = 0;
    for (int i = 0; i < row && at < MISTAKES; i++)
        at = next_id(at);
    if (row < 0 || at >= MISTAKES)
        return false;
    *mistake = (lam_shader_mistake){.id = mistakes[at].id, .looks = mistakes[at].looks, .needs = mistakes[at].needs};
    return true;
}

// --- edits

// Copies `text`, with "@lights@" replaced by the number of lights. The copy has at most 127 bytes.
static void expand(char out[128], const char *text, int lights)
{
    const char *at = strstr(text, "@lights@");
    if (at)
        snprintf(out, 128, "%.*s%d%s", (int)(at - text), text, lights, at + 8);
    else
        snprintf(out, 128, "%s", text);
}

static int count_of(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)); at += strlen(part))
        count++;
    return count;
}

// Replaces the only occurrence of `before`. Returns NULL if memory runs out.
static char *replaced(const char *text, const char *before, const char *after)
{
    const char *at = strstr(text, before);
    size_t head = (size_t)(at - text), size = strlen(text) - strlen(before) + strlen(after) + 1;
    char *out = malloc(size);
    if (out)
        snprintf(out, size, "%.*s%s%s", (int)head, text, after, at + strlen(before));
    return out;
}

enum { TEXTS_MAX = 2 };
enum outcome { APPLIED, NOT_APPLIED, NO_MEMORY };

static int count_in(char *const *texts, int count, const char *part, int *where)
{
    int found = 0;
    for (int i = 0; i < count; i++) {
        int here = count_of(texts[i], part);
        *where = here ? i : *where;
        found += here;
    }
    return found;
}

static void free_texts(char **texts, int count)
{
    for (int i = 0; i < count; i++)
        free(texts[i]);
}

// Applies one form to copies of the texts.
static enum outcome apply_row(const struct mistake *m, int lights, char *const *texts, int count, char **out)
{
    enum outcome outcome = APPLIED;
    int where = 0;
    for (int i = 0; i < count; i++) {
        out[i] = replaced(texts[i], "", "");
        outcome = out[i] ? outcome : NO_MEMORY;
    }
    if (outcome == APPLIED && m->lights != ANY_LIGHTS && (lights > 1) != (m->lights == MORE_LIGHTS))
        outcome = NOT_APPLIED;
    if (outcome == APPLIED && m->contains && !count_in(texts, count, m->contains, &where))
        outcome = NOT_APPLIED;
    for (int i = 0; outcome == APPLIED && i < EDITS_MAX && m->edits[i].before; i++) {
        char before[128], after[128];
        expand(before, m->edits[i].before, lights);
        expand(after, m->edits[i].after, lights);
        if (count_in(out, count, before, &where) != 1 || strcmp(before, after) == 0) {
            outcome = NOT_APPLIED;
            break;
        }
        char *edited = replaced(out[where], before, after);
        if (!edited) {
            outcome = NO_MEMORY;
            break;
        }
        free(out[where]);
        out[where] = edited;
    }
    if (outcome != APPLIED)
        free_texts(out, count);
    return outcome;
}

bool mistake_apply(const struct glsl_choices *c, char **texts, int count, lam_error *error)
{
    int first = c->mistake - 1;
    for (int i = first; i < next_id(first); i++) {
        char *edited[TEXTS_MAX];
        enum outcome outcome = apply_row(&mistakes[i], c->light_count, texts, count, edited);
        if (outcome == NO_MEMORY)
            return fail(error, LAM_LIMIT, "out of memory");
        if (outcome == APPLIED) {
            free_texts(texts, count);
            memcpy(texts, edited, (size_t)count * sizeof *texts);
            return true;
        }
    }
    return fail(error, LAM_UNSUPPORTED,
                "mistake '%s': the shader lacks the code that this mistake changes; expected %s", mistakes[first].id,
                mistakes[first].needs ? mistakes[first].needs : "lighting in a shader");
}
