// contracts.c: the known mistakes as edits of shaders in the lecture style (lecture.glsl). Most of these mistakes occur
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

// If a mistake applies to a shader, `before` occurs exactly once in the shader's two source files. "@lights@" is the
// number of lights.
struct edit {
    const char *before, *after;
};

// Adjacent rows with the same id are forms of one mistake, and the first applicable form is used. Only the first of
// these rows sets `looks` and `needs`. Forms for the C function of the application stage come last.
struct mistake {
    const char *id, *looks, *needs;
    struct edit edits[EDITS_MAX];
    const char *contains; // a string that the shader must contain, or NULL
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

#define EDIT(before, after)   .edits[0] = {before, after}
#define EDIT_2(before, after) .edits[1] = {before, after}
// A mistake's first form, and its other forms. The last arguments are the edits, as designated initializers.
#define MISTAKE(id, looks, needs, ...) {id, looks, needs, __VA_ARGS__}
#define FORM(id, ...)                  {id, NULL, NULL, __VA_ARGS__}

static const struct mistake mistakes[] = {
    // --- normals
    MISTAKE("normal-not-unit", "The highlight is dim in the middle of large triangles, so the mesh becomes visible.",
            PER_FRAGMENT, EDIT("normalize(eye_normal); // interpolation made it shorter", "eye_normal;")),
    MISTAKE(
        "normal-by-model-view",
        "The mistake is invisible until an object is stretched; then the object looks as if the light were elsewhere.",
        NULL, EDIT(NORMAL, "mat3(model_view) * normal")),
    FORM("normal-by-model-view", EDIT(C_NORMAL, "transform(draw->model_view, vector(normal), 0.0)")),
    MISTAKE("normal-object-space",
            "The light turns with the object: the same side of the model is lit from every viewpoint.", NULL,
            EDIT(NORMAL, "normal")),
    FORM("normal-object-space", EDIT(C_NORMAL, "vector(normal)")),
    MISTAKE(
        "normal-clip-space",
        "The lighting and the highlights are in the wrong position, and slide over the object when the camera moves.",
        NULL, EDIT(NORMAL, "mat3(model_view_projection) * normal")),
    MISTAKE("normal-as-point",
            "Nearly every normal points the same way, away from the eye: the object looks flat and dark.", NULL,
            EDIT(NORMAL, "(model_view * vec4(normal, 1.0)).xyz")),
    FORM("normal-as-point", EDIT(C_NORMAL, "transform(draw->model_view, vector(normal), 1.0)")),
    MISTAKE("normal-inward", "The side that should be dark is lit, and the lit side is dark.", NULL,
            EDIT("normalize(" NORMAL ")", "-normalize(" NORMAL ")")),
    FORM("normal-inward", EDIT("normalize(" C_NORMAL ")", "scale(-1.0, normalize(" C_NORMAL "))")),
    MISTAKE("no-flip", "The inside of open objects stays dark, or is lit like the outside.",
            "an object that is lit on both sides, in the fragment shader",
            EDIT("    if (!gl_FrontFacing)\n        N = -N;                     // the back is lit too\n", "")),
    FORM("no-flip", EDIT(", scale(-1.0, N)", ", N")),
    // --- spaces
    MISTAKE("clip-space-vertex",
            "Highlights and nearby lights are in the wrong position, and move when the field of view changes.", NULL,
            EDIT("eye_position = (model_view * ", "eye_position = (model_view_projection * ")),
    MISTAKE("point-in-object-space",
            "When the camera or the object moves, nearby lights and highlights do not move with it.",
            "smooth shading, or GLSL above 120",
            EDIT("eye_position = (model_view * vec4(position, 1.0)).xyz", "eye_position = position")),
    FORM("point-in-object-space", EDIT("vec3 P = " C_POINT, "vec3 P = vector(position)")),
    MISTAKE("eye-backwards", "The highlight is at the rim, or is missing.", BLINN,
            EDIT("normalize(-P);         // from the point to the eye", "normalize(P);"),
            .contains = "normalize(L + V)"),
    FORM("eye-backwards", EDIT(C_EYE, "normalize(P);"), .contains = "add(L, V)"),
    MISTAKE("viewer-infinite", "Each highlight is slightly shifted, most visibly at the border of the picture.",
            A_HIGHLIGHT " and a local viewer",
            EDIT("normalize(-P);         // from the point to the eye", "vec3(0.0, 0.0, 1.0);")),
    FORM("viewer-infinite", EDIT(C_EYE, "{0.0, 0.0, 1.0};")),
    // --- the light's direction
    MISTAKE("light-backwards", "The object is lit from the other side.", PLACE,
            EDIT("lights[i].position.xyz - P", "P - lights[i].position.xyz")),
    FORM("light-backwards", EDIT("subtract(lights[i].position, P)", "subtract(P, lights[i].position)")),
    MISTAKE("direction-reversed", "The object is lit from the other side.", "a directional light",
            EDIT("-lights[i].direction.xyz", "lights[i].direction.xyz")),
    FORM("direction-reversed", EDIT("scale(-1.0, lights[i].direction)", "lights[i].direction")),
    MISTAKE("direction-as-point", "The distant light looks like a bulb near the object, because its light spreads.",
            "a directional light", EDIT("-lights[i].direction.xyz", "-lights[i].direction.xyz - P")),
    FORM("direction-as-point",
         EDIT("scale(-1.0, lights[i].direction)", "subtract(scale(-1.0, lights[i].direction), P)"),
         .contains = "vec3 P = "),
    MISTAKE("light-not-unit", "Distant lights are much too bright, and near lights are too dark.", PLACE,
            EDIT("normalize(way);    // from the point to the light", "way;"), .contains = "lights[i].position"),
    // --- the highlight
    MISTAKE("half-of-raw-light",
            "The highlight is larger and shifted towards the light, because the vector to a distant light is longer "
            "than the vector to the eye.",
            BLINN " and " PLACE, EDIT("normalize(L + V)", "normalize(way + V)"), .contains = "lights[i].position.xyz"),
    FORM("half-of-raw-light", EDIT(C_HALF, "normalize(add(way, V))"), .contains = "lights[i].position"),
    MISTAKE("half-not-unit", "The highlight is blown out, and many times too large.", BLINN,
            EDIT("normalize(L + V)", "L + V")),
    FORM("half-not-unit", EDIT(C_HALF, "add(L, V)")),
    MISTAKE(
        "half-is-mean",
        "The highlight is dim or missing, most visibly if the directions to the light and to the eye differ greatly.",
        BLINN, EDIT("normalize(L + V)", "(L + V) / 2.0")),
    FORM("half-is-mean", EDIT(C_HALF, "scale(0.5, add(L, V))")),
    MISTAKE("no-gate",
            "The highlight shines through the object: it also appears on surfaces that face away from the light.",
            A_HIGHLIGHT, EDIT(" S = dot(N, L) > 0.0 ? pow", " S = pow"), EDIT_2("shininess) : 0.0;", "shininess);")),
    FORM("no-gate", EDIT(" S = faces * pow", " S = pow")),
    MISTAKE("phong-lobe", "The highlight is about half as wide as it should be.", BLINN,
            EDIT("max(dot(N, H), 0.0)", "max(dot(reflect(-L, N), V), 0.0)"), .contains = "normalize(L + V)"),
    FORM("phong-lobe", EDIT("vec3 H = " C_HALF, "vec3 R = " C_MIRROR), EDIT_2("dot(N, H)", "dot(R, V)")),
    MISTAKE("blinn-phong-lobe", "The highlight is about twice as wide as it should be.", PHONG,
            EDIT("max(dot(R, V), 0.0)", "max(dot(N, normalize(L + V)), 0.0)"), .contains = "reflect(-L, N)"),
    FORM("blinn-phong-lobe", EDIT("vec3 R = " C_MIRROR, "vec3 H = " C_HALF), EDIT_2("dot(R, V)", "dot(N, H)")),
    MISTAKE("reflect-sign", "The highlight is missing, or is on the far side.", PHONG,
            EDIT("reflect(-L, N)", "reflect(L, N)")),
    FORM("reflect-sign", EDIT(C_MIRROR, "subtract(L, scale(2.0 * dot(N, L), N))")),
    MISTAKE("shininess-times-4", "The highlight is half as wide as it should be.", A_HIGHLIGHT,
            EDIT("shininess) : 0.0;", "shininess * 4.0) : 0.0;")),
    FORM("shininess-times-4", EDIT("shininess);", "shininess * 4.0);")),
    MISTAKE("shininess-quarter", "The highlight is twice as wide as it should be, and looks dull.", A_HIGHLIGHT,
            EDIT("shininess) : 0.0;", "shininess / 4.0) : 0.0;")),
    FORM("shininess-quarter", EDIT("shininess);", "shininess / 4.0);")),
    MISTAKE("specular-times-n.l", "The highlight is weak if the light grazes the surface.", A_HIGHLIGHT,
            EDIT(" * S;", " * S * max(dot(N, L), 0.0);")),
    FORM("specular-times-n.l", EDIT("specular = scale(S, ", "specular = scale(S * max(dot(N, L), 0.0), ")),
    MISTAKE("specular-tinted", "The highlight has the colour of the paint: plastic looks like metal.", A_HIGHLIGHT,
            EDIT("vec3 specular = ks", "vec3 specular = ks * kd")),
    FORM("specular-tinted", EDIT("specular_product[i].rgb", "specular_product[i].rgb * diffuse_product[i].rgb")),
    FORM("specular-tinted", EDIT("times(ks, lights[i].specular)", "times(ks, times(kd, lights[i].specular))")),
    MISTAKE("specular-in-diffuse-colour", "The highlight has the colour and the strength of the paint.", A_HIGHLIGHT,
            EDIT("vec3 specular = ks", "vec3 specular = kd")),
    FORM("specular-in-diffuse-colour", EDIT("specular_product[i].rgb", "diffuse_product[i].rgb")),
    FORM("specular-in-diffuse-colour", EDIT("times(ks, lights[i].specular)", "times(kd, lights[i].specular)")),
    MISTAKE("kd-ks-swapped",
            "The object has the colour of the highlight, and the highlight has the colour of the object.", A_HIGHLIGHT,
            EDIT("kd * lights[i].diffuse.rgb", "ks * lights[i].diffuse.rgb"),
            EDIT_2("ks * lights[i].specular.rgb", "kd * lights[i].specular.rgb")),
    FORM("kd-ks-swapped", EDIT("diffuse_product[i].rgb * ", "specular_product[i].rgb * "),
         EDIT_2("specular_product[i].rgb * S", "diffuse_product[i].rgb * S")),
    FORM("kd-ks-swapped", EDIT("times(kd, lights[i].diffuse)", "times(ks, lights[i].diffuse)"),
         EDIT_2("times(ks, lights[i].specular)", "times(kd, lights[i].specular)")),
    // --- Lambert
    MISTAKE("no-clamp", "The unlit side is black, because the negative diffuse term cancels ambient and other light.",
            MATT, EDIT("max(dot(N, L), 0.0); // Lambert", "dot(N, L); // Lambert")),
    FORM("no-clamp", EDIT("scale(max(dot(N, L), 0.0), times(kd", "scale(dot(N, L), times(kd")),
    MISTAKE("abs-of-n.l", "The side that faces away from the light is as bright as the lit side.", MATT,
            EDIT("max(dot(N, L), 0.0); // Lambert", "abs(dot(N, L)); // Lambert")),
    FORM("abs-of-n.l", EDIT("scale(max(dot(N, L), 0.0), times(kd", "scale(fabs(dot(N, L)), times(kd")),
    // --- attenuation
    MISTAKE("no-attenuation", "Near and distant surfaces are equally bright.", FALLOFF,
            EDIT(SUM, "(diffuse + specular)")),
    FORM("no-attenuation", EDIT("attenuation * diffuse;", "diffuse;")),
    FORM("no-attenuation", EDIT(C_SUM, "add(diffuse, specular)")),
    FORM("no-attenuation", EDIT("spot * attenuation, ", "spot, ")),
    FORM("no-attenuation", EDIT("scale(attenuation, diffuse)", "diffuse")),
    MISTAKE("specular-not-attenuated", "Highlights stay bright, however distant the light is.",
            FALLOFF " and a highlight", EDIT(SUM, "(attenuation * diffuse + specular)")),
    FORM("specular-not-attenuated", EDIT(C_SUM, "add(scale(attenuation, diffuse), specular)")),
    FORM("specular-not-attenuated", EDIT(C_SPOT_SUM, "scale(spot, add(scale(attenuation, diffuse), specular))")),
    MISTAKE("diffuse-not-attenuated", "The object stays bright, however distant the light is; only highlights fade.",
            FALLOFF " and a highlight", EDIT(SUM, "(diffuse + attenuation * specular)")),
    FORM("diffuse-not-attenuated", EDIT(C_SUM, "add(diffuse, scale(attenuation, specular))")),
    FORM("diffuse-not-attenuated", EDIT(C_SPOT_SUM, "scale(spot, add(diffuse, scale(attenuation, specular)))")),
    MISTAKE("ambient-attenuated", "Unlit sides become darker as the light moves away.",
            "one light, with attenuation, and a highlight", EDIT(" + ambient;", ";"),
            EDIT_2(SUM, "attenuation * (ambient + diffuse + specular)"), .lights = ONE_LIGHT),
    FORM("ambient-attenuated", EDIT("add(draw->emission, ambient)", "draw->emission"),
         EDIT_2(C_SUM, "scale(attenuation, add(ambient, add(diffuse, specular)))"), .lights = ONE_LIGHT),
    FORM("ambient-attenuated", EDIT("add(draw->emission, ambient)", "draw->emission"),
         EDIT_2(C_SPOT_SUM, "scale(attenuation, add(ambient, scale(spot, add(diffuse, specular))))"),
         .lights = ONE_LIGHT),
    MISTAKE("attenuation-swapped", "The light fades too slowly or too fast, because b and c are swapped.", FALLOFF,
            EDIT("a.y * d + a.z * d * d", "a.z * d + a.y * d * d")),
    MISTAKE("attenuation-inverted", "The more distant the light, the brighter the surface, up to pure white.", FALLOFF,
            EDIT("1.0 / (a.x + a.y * d + a.z * d * d)", "a.x + a.y * d + a.z * d * d")),
    MISTAKE("distance-of-unit-vector",
            "The light does not fade, because the distance is computed from L, whose length is 1.", FALLOFF,
            EDIT("length(way);", "length(L);")),
    // --- spotlights
    MISTAKE("no-cone", "The spot light shines in all directions.", "a spot light",
            EDIT("color += spot * ", "color += ")),
    FORM("no-cone", EDIT("spot * attenuation, ", "attenuation, ")),
    FORM("no-cone", EDIT("scale(spot, add(diffuse, specular))", "add(diffuse, specular)")),
    FORM("no-cone", EDIT("scale(spot, diffuse)", "diffuse")),
    MISTAKE("no-cutoff", "The spot light has no visible edge.", "a spot light with a cutoff",
            EDIT("c >= cutoff ? pow(max(c, 1.0e-6), exponent) : 0.0", "pow(max(c, 1.0e-6), exponent)")),
    MISTAKE("no-spot-exponent", "The spot light is as bright at its edge as in its middle.",
            "a spot light with a cutoff", EDIT("pow(max(c, 1.0e-6), exponent)", "1.0")),
    MISTAKE("cone-inside-out", "The spot light lights everything except its cone.", "a spot light with a cutoff",
            EDIT("c >= cutoff", "c < cutoff")),
    // --- sums
    MISTAKE("no-ambient", "Unlit sides are black.", NULL, EDIT(" + ambient;", ";")),
    FORM("no-ambient", EDIT("add(draw->emission, ambient)", "draw->emission")),
    MISTAKE("ambient-for-each-light", "Unlit sides become brighter with every additional light.", SEVERAL,
            EDIT("color += ", "color += ambient + "), EDIT_2(" + ambient;", ";"), .lights = MORE_LIGHTS),
    FORM("ambient-for-each-light", EDIT("color = add(color, ", "color = add(add(color, ambient), "),
         EDIT_2("add(draw->emission, ambient)", "draw->emission"), .lights = MORE_LIGHTS),
    MISTAKE("first-light-only", "Only the first light has an effect.", SEVERAL,
            EDIT("i < @lights@; i++) {\n        vec3 way", "i < 1; i++) {\n        vec3 way")),
    MISTAKE("last-light-only", "Only the last light has an effect.", SEVERAL,
            EDIT("color += ", "color = material.emission.rgb + ambient + "),
            .contains = "material.emission.rgb + ambient;", .lights = MORE_LIGHTS),
    FORM("last-light-only", EDIT("color += ", "color = emission.rgb + ambient + "),
         .contains = "vec3 color = emission.rgb + ambient;", .lights = MORE_LIGHTS),
    FORM("last-light-only", EDIT("color = add(color, ", "color = add(add(draw->emission, ambient), "),
         .contains = "= add(draw->emission, ambient)", .lights = MORE_LIGHTS),
    MISTAKE("alpha-one", "Glass is opaque.", PER_FRAGMENT " of a translucent material",
            EDIT("material.diffuse.a)", "1.0)")),
    FORM("alpha-one", EDIT("), diffuse.a)", "), 1.0)")),
};
enum { MISTAKES = sizeof mistakes / sizeof *mistakes, SECOND = 1 << 8 }; // SECOND: the factor of the second mistake

int mistake_find(const char *id)
{
    size_t length = id ? strcspn(id, "+") : 0;
    int second = length && id[length] ? mistake_find(id + length + 1) : 0;
    for (int i = 0; length && (second || !id[length]) && second < SECOND && i < MISTAKES; i++)
        if (strlen(mistakes[i].id) == length && memcmp(mistakes[i].id, id, length) == 0)
            return i + 1 + SECOND * second;
    return 0;
}

// Returns the first row after `row` that has a different id.
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

// Applies one form to copies of the sources.
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

static bool apply_one(int first, int lights, char **texts, int count, lam_error *error)
{
    for (int i = first; i < next_id(first); i++) {
        char *edited[TEXTS_MAX];
        enum outcome outcome = apply_row(&mistakes[i], lights, texts, count, edited);
        if (outcome == NO_MEMORY)
            return fail(error, LAM_MACHINE, "out of memory");
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

bool mistake_apply(const struct glsl_choices *c, char **texts, int count, lam_error *error)
{
    return apply_one(c->mistake % SECOND - 1, c->light_count, texts, count, error) &&
           (c->mistake < SECOND || apply_one(c->mistake / SECOND - 1, c->light_count, texts, count, error));
}
