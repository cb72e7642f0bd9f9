// mistakes.c: the known mistakes as edits of shaders in the lecture style (lecture.glsl). Most occur in lectures and tutorials
// (docs/mistakes.md). `lambent check` explains each under the same id (../check/diagnose/fault_table.c).
#include <lambent/shader.h>

#include "fail.h"
#include "lecture.h"
#include "text_builder.h"

// Most rows need no text.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EDITS_MAX = 2 };

// `before` occurs exactly once in the two texts of a shader that the mistake applies to. "@lights@" is the number of lights.
struct edit {
    const char *before, *after;
};

// Rows of one id are forms of one mistake and stand together: the first that applies is taken. The first has the sentences.
struct mistake {
    const char *id, *looks, *needs;
    struct edit edits[EDITS_MAX];
    const char *contains; // a text of the shader, which stays; NULL: none
    enum { ANY_LIGHTS, ONE_LIGHT, MORE_LIGHTS } lights;
};

#define PER_FRAGMENT "lighting in the fragment shader"
#define A_HIGHLIGHT  "a reflection model with a highlight"
#define BLINN        "the reflection model blinn-phong"
#define PHONG        "the reflection model phong"
#define FALLOFF      "a light with attenuation"
#define PLACE        "a light at a place: point or spot"
#define SEVERAL      "more than one light"
#define NORMAL       "normal_matrix * normal"
#define SUM          "attenuation * (diffuse + specular)"

static const struct mistake mistakes[] = {
    // --- normals
    {"normal-not-unit",
     "The highlight is dim in the middle of large triangles, and the mesh shows in it.",
     PER_FRAGMENT,
     {{"normalize(eye_normal); // interpolation made it shorter", "eye_normal;"}}},
    {"normal-by-model-view",
     "Nothing is wrong until an object is stretched: then its shading leans, as if the light stood elsewhere.",
     NULL,
     {{NORMAL, "mat3(model_view) * normal"}}},
    {"normal-object-space",
     "The light turns with the object: the same side of the model stays lit from wherever one looks.",
     NULL,
     {{NORMAL, "normal"}}},
    {"normal-clip-space",
     "Light and highlight are shifted, and slide over the object when the camera moves.",
     NULL,
     {{NORMAL, "mat3(model_view_projection) * normal"}}},
    {"normal-as-point",
     "Nearly every normal points the same way, away from the eye: the object looks flat and dark.",
     NULL,
     {{NORMAL, "(model_view * vec4(normal, 1.0)).xyz"}}},
    {"normal-inward",
     "The side that should be dark is lit, and the lit side is dark.",
     NULL,
     {{"normalize(" NORMAL ")", "-normalize(" NORMAL ")"}}},
    {"no-flip",
     "The inside of open objects stays dark, or has the light of the outside.",
     "an object that is lit on both sides, in the fragment shader",
     {{"    if (!gl_FrontFacing)\n        N = -N;                     // the back is lit as well\n", ""}}},
    // --- spaces
    {"clip-space-vertex",
     "Highlights and nearby lights are in the wrong place, and move with the camera's lens.",
     NULL,
     {{"eye_position = (model_view * ", "eye_position = (model_view_projection * "}}},
    {"point-in-object-space",
     "Nearby lights and highlights do not follow when the camera or the object moves.",
     "smooth shading, or GLSL above 120",
     {{"eye_position = (model_view * vec4(position, 1.0)).xyz", "eye_position = position"}}},
    {"eye-backwards",
     "The highlight sits at the rim, or is gone.",
     BLINN,
     {{"normalize(-P);         // from the point to the eye", "normalize(P);"}},
     "normalize(L + V)"},
    {"viewer-infinite",
     "Each highlight is a little off, most at the border of the picture.",
     A_HIGHLIGHT " and a viewer at a place",
     {{"normalize(-P);         // from the point to the eye", "vec3(0.0, 0.0, 1.0);"}}},
    // --- the light's direction
    {"light-backwards",
     "The object is lit from the other side.",
     PLACE,
     {{"lights[i].position.xyz - P", "P - lights[i].position.xyz"}}},
    {"direction-reversed",
     "The object is lit from the other side.",
     "a directional light",
     {{"-lights[i].direction.xyz", "lights[i].direction.xyz"}}},
    {"direction-as-point",
     "The distant light looks like a bulb beside the object: its light spreads.",
     "a directional light",
     {{"-lights[i].direction.xyz", "-lights[i].direction.xyz - P"}}},
    {"light-not-unit",
     "Far lights are much too bright, and near ones too dark.",
     PLACE,
     {{"normalize(way);    // from the point to the light", "way;"}},
     "lights[i].position.xyz"},
    // --- the highlight
    {"half-of-raw-light",
     "The highlight moves towards the light and grows: a far light outweighs the eye.",
     BLINN " and " PLACE,
     {{"normalize(L + V)", "normalize(way + V)"}},
     "lights[i].position.xyz"},
    {"half-not-unit",
     "The highlight is a burnt white spot, many times too large.",
     BLINN,
     {{"normalize(L + V)", "L + V"}}},
    {"half-is-mean",
     "The highlight is dim or gone, most of all where light and eye are far apart.",
     BLINN,
     {{"normalize(L + V)", "(L + V) / 2.0"}}},
    {"no-gate",
     "The highlight shines through: it is seen where the surface faces away from the light.",
     A_HIGHLIGHT,
     {{"float S = dot(N, L) > 0.0 ? pow", "float S = pow"}, {"shininess) : 0.0;", "shininess);"}}},
    {"phong-lobe",
     "The highlight is about half as wide as it should be.",
     BLINN,
     {{"max(dot(N, H), 0.0)", "max(dot(reflect(-L, N), V), 0.0)"}}},
    {"blinn-phong-lobe",
     "The highlight is about twice as wide as it should be.",
     PHONG,
     {{"max(dot(R, V), 0.0)", "max(dot(N, normalize(L + V)), 0.0)"}}},
    {"reflect-sign", "The highlight is gone, or sits on the far side.", PHONG, {{"reflect(-L, N)", "reflect(L, N)"}}},
    {"shininess-times-4",
     "The highlight is half as wide as it should be.",
     A_HIGHLIGHT,
     {{"shininess) : 0.0;", "shininess * 4.0) : 0.0;"}}},
    {"shininess-quarter",
     "The highlight is twice as wide as it should be, and looks dull.",
     A_HIGHLIGHT,
     {{"shininess) : 0.0;", "shininess / 4.0) : 0.0;"}}},
    {"specular-times-n.l",
     "The highlight is weak where light grazes the surface.",
     A_HIGHLIGHT,
     {{" * S;", " * S * max(dot(N, L), 0.0);"}}},
    {"specular-tinted",
     "The highlight has the colour of the paint: plastic looks like metal.",
     A_HIGHLIGHT,
     {{"vec3 specular = ks", "vec3 specular = ks * kd"}}},
    {"specular-tinted", NULL, NULL, {{"specular_product[i].rgb", "specular_product[i].rgb * diffuse_product[i].rgb"}}},
    {"specular-in-diffuse-colour",
     "The highlight has the colour and the strength of the paint.",
     A_HIGHLIGHT,
     {{"vec3 specular = ks", "vec3 specular = kd"}}},
    {"specular-in-diffuse-colour", NULL, NULL, {{"specular_product[i].rgb", "diffuse_product[i].rgb"}}},
    {"kd-ks-swapped",
     "The body has the highlight's colour, and the highlight the body's.",
     A_HIGHLIGHT,
     {{"kd * lights[i].diffuse.rgb", "ks * lights[i].diffuse.rgb"},
      {"ks * lights[i].specular.rgb", "kd * lights[i].specular.rgb"}}},
    {"kd-ks-swapped",
     NULL,
     NULL,
     {{"diffuse_product[i].rgb * max", "specular_product[i].rgb * max"},
      {"specular_product[i].rgb * S", "diffuse_product[i].rgb * S"}}},
    // --- Lambert
    {"no-clamp",
     "The unlit side is black: there the diffuse term takes ambient and other light away.",
     NULL,
     {{"max(dot(N, L), 0.0); // Lambert", "dot(N, L); // Lambert"}}},
    {"abs-of-n.l",
     "The side away from the light is lit as brightly as the other.",
     NULL,
     {{"max(dot(N, L), 0.0); // Lambert", "abs(dot(N, L)); // Lambert"}}},
    // --- attenuation
    {"no-attenuation", "Near and far surfaces are lit alike.", FALLOFF, {{SUM, "(diffuse + specular)"}}},
    {"no-attenuation", NULL, NULL, {{"attenuation * diffuse;", "diffuse;"}}},
    {"specular-not-attenuated",
     "Highlights stay bright, however far the light is.",
     FALLOFF " and a highlight",
     {{SUM, "(attenuation * diffuse + specular)"}}},
    {"diffuse-not-attenuated",
     "The body stays bright, however far the light is; only highlights fade.",
     FALLOFF " and a highlight",
     {{SUM, "(diffuse + attenuation * specular)"}}},
    {"ambient-attenuated",
     "Shadowed sides darken with the light's distance.",
     "one light, with attenuation, and a highlight",
     {{" + ambient;", ";"}, {SUM, "attenuation * (ambient + diffuse + specular)"}},
     NULL,
     ONE_LIGHT},
    {"attenuation-swapped",
     "Light fades too slowly or too fast: b and c have changed places.",
     FALLOFF,
     {{"a.y * d + a.z * d * d", "a.z * d + a.y * d * d"}}},
    {"attenuation-inverted",
     "The farther the light, the brighter the surface, up to pure white.",
     FALLOFF,
     {{"1.0 / (a.x + a.y * d + a.z * d * d)", "a.x + a.y * d + a.z * d * d"}}},
    {"distance-of-unit-vector",
     "Light does not fade: the distance is taken of L, whose length is 1.",
     FALLOFF,
     {{"length(way);      // the light's distance", "length(L);"}}},
    // --- spotlights
    {"no-cone", "The spotlight shines to all sides.", "a spotlight", {{"color += spot * ", "color += "}}},
    {"no-cutoff",
     "The spotlight has no edge.",
     "a spotlight with a cutoff",
     {{"c >= cutoff ? pow(max(c, 1.0e-6), exponent) : 0.0", "pow(max(c, 1.0e-6), exponent)"}}},
    {"no-spot-exponent",
     "The spotlight is as bright at its edge as in its middle.",
     "a spotlight with a cutoff",
     {{"pow(max(c, 1.0e-6), exponent)", "1.0"}}},
    {"cone-inside-out",
     "The spotlight lights everything except its cone.",
     "a spotlight with a cutoff",
     {{"c >= cutoff", "c < cutoff"}}},
    // --- sums
    {"no-ambient", "Unlit sides are black.", NULL, {{" + ambient;", ";"}}},
    {"ambient-for-each-light",
     "Shadows fade with every light that is added.",
     SEVERAL,
     {{"color += ", "color += ambient + "}, {" + ambient;", ";"}},
     NULL,
     MORE_LIGHTS},
    {"first-light-only",
     "All lights but the first have no effect.",
     SEVERAL,
     {{"i < @lights@; i++) {\n        vec3 way", "i < 1; i++) {\n        vec3 way"}}},
    {"last-light-only",
     "All lights but the last have no effect.",
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

// The row after those of the same id.
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

// `text` with the number of lights in place of "@lights@"; at most 127 bytes.
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

// Replaces the only occurrence of `before`. NULL: out of memory.
static char *replaced(const char *text, const char *before, const char *after)
{
    const char *at = strstr(text, before);
    size_t head = (size_t)(at - text), size = strlen(text) - strlen(before) + strlen(after) + 1;
    char *out = malloc(size);
    if (out)
        snprintf(out, size, "%.*s%s%s", (int)head, text, after, at + strlen(before));
    return out;
}

static void free_texts(struct glsl_text *text)
{
    free(text->vertex);
    free(text->fragment);
}

enum outcome { APPLIED, NOT_APPLIED, NO_MEMORY };

// Applies one form to copies of the texts.
static enum outcome apply_row(const struct mistake *m, int lights, const struct glsl_text *text, struct glsl_text *out)
{
    *out = (struct glsl_text){.vertex = replaced(text->vertex, "", ""), .fragment = replaced(text->fragment, "", "")};
    enum outcome outcome = out->vertex && out->fragment ? APPLIED : NO_MEMORY;
    if (outcome == APPLIED && m->lights != ANY_LIGHTS && (lights > 1) != (m->lights == MORE_LIGHTS))
        outcome = NOT_APPLIED;
    if (outcome == APPLIED && m->contains && !strstr(text->vertex, m->contains) && !strstr(text->fragment, m->contains))
        outcome = NOT_APPLIED;
    for (int i = 0; outcome == APPLIED && i < EDITS_MAX && m->edits[i].before; i++) {
        char before[128], after[128];
        expand(before, m->edits[i].before, lights);
        expand(after, m->edits[i].after, lights);
        int in_vertex = count_of(out->vertex, before), in_fragment = count_of(out->fragment, before);
        if (in_vertex + in_fragment != 1 || strcmp(before, after) == 0) {
            outcome = NOT_APPLIED;
            break;
        }
        char **stage = in_vertex ? &out->vertex : &out->fragment, *edited = replaced(*stage, before, after);
        if (!edited) {
            outcome = NO_MEMORY;
            break;
        }
        free(*stage);
        *stage = edited;
    }
    if (outcome != APPLIED)
        free_texts(out);
    return outcome;
}

bool mistake_apply(const struct glsl_choices *c, struct glsl_text *text, lam_error *error)
{
    int first = c->mistake - 1;
    for (int i = first; i < next_id(first); i++) {
        struct glsl_text edited;
        enum outcome outcome = apply_row(&mistakes[i], c->light_count, text, &edited);
        if (outcome == NO_MEMORY)
            return fail(error, LAM_LIMIT, "out of memory");
        if (outcome == APPLIED) {
            free_texts(text);
            *text = edited;
            return true;
        }
    }
    return fail(error, LAM_UNSUPPORTED, "mistake '%s': the shader does not have what it spoils; expected %s",
                mistakes[first].id, mistakes[first].needs ? mistakes[first].needs : "lighting in a shader");
}
