// reading.h: finds out what each input of a shader means, by evaluating the shader.
//
// A sample is a point of a triangle with a light, an eye and normals. For a right shader, the colours at one point are
// a sum of an ambient, a diffuse and a specular term, with factors that do not depend on the normals and on the
// direction of the eye: colours, strengths, attenuation, cones and fog. A reading gives a role to each matrix and
// vector. It is accepted if the shader's colours are such sums at every sample.
#ifndef READING_H
#define READING_H

#include "glsl.h"
#include "linear.h"

enum reading_role {
    READ_OTHER, // a colour, a strength or a number, which may have any value
    READ_MODEL,
    READ_VIEW,
    READ_PROJECTION,
    READ_MODEL_VIEW,
    READ_VIEW_PROJECTION,
    READ_ALL, // model, view and projection
    READ_NORMAL_EYE,
    READ_NORMAL_WORLD,
    READ_VIEW_INVERSE,
    READ_MATRICES,
    READ_LIGHT = READ_MATRICES, // the position of a light
    READ_TO_LIGHT,              // the direction to a light
    READ_AXIS,                  // the direction of a spot light
    READ_EYE,
    READ_POSITION, // attributes
    READ_NORMAL,
    READ_ROLES
};
extern const char *const reading_role_names[READ_ROLES]; // as in --role

enum {
    READ_LEAVES = 48,
    READ_CHOICES = 18,
    READ_LIGHTS = 8,
    READ_POINTS = 5,
    READ_TURNS = 64,
    READ_COLUMNS = 52,
    READ_NUMBERS = 64,
    READ_NEAREST = 24,
    READ_CHEAP = 4,
    READ_MANY = 100
};
enum reading_space { READ_WORLD_SPACE, READ_EYE_SPACE, READ_OBJECT_SPACE };

struct reading_choice {
    uint8_t role, space; // enum reading_space
    bool against;        // contradicts a clear name
};

// An input, or a vector of constants in the source.
struct reading_leaf {
    char name[96]; // lights[].position
    struct glsl_type type;
    int at[2], step, count; // addresses in the vertex and the fragment shader (−1: not declared); elements of an array
    bool attribute, geometric;
    int owner;                    // the leaves of one struct or array of lights have the same number; −1 for others
    int node, side;               // of a vector of constants in the source; −1 for inputs
    double given[4], original[4]; // a vector's value, and its value without a role
    struct reading_choice choices[READ_CHOICES];
    int choice_count, chosen;
    int light; // the first light of this leaf
};

// Forms that are all correct, and, with `shaded` or `early`, forms that are mistakes.
enum reading_forms { FORMS_RIGHT, FORMS_EARLY, FORMS_SHADED };
struct reading_form {
    bool phong, gate, late_normal, vertex, infinite_viewer;
    bool shaded;     // the sum of the highlights is multiplied by the diffuse terms
    bool general;    // no sum of terms: only the cosines are right
    uint8_t early;   // bits: l, v, and h or r are normalized at the vertices and interpolated
    double exponent; // 0: no highlight
    double gamma;    // decodes the colour; 0: the colour is linear
};

struct reading_sample {
    double matrices[READ_MATRICES][16];
    double positions[3][3], normals[3][3], weights[3]; // of the triangle's vertices, in the model's space
    double points[3][3], units[3][3], longs[3][3];     // in world space; unit normals, and normals before normalization
    double eye[3], eye_axis[3], lights[READ_LIGHTS][3], axes[READ_LIGHTS][3];
    double color[3];
};

// A vector that a test may use instead of a part of the source: the right point, normal, direction to the eye, or
// direction to the first light, in one of the spaces, with its fourth component.
enum reading_right { RIGHT_POINT, RIGHT_NORMAL, RIGHT_EYE, RIGHT_LIGHT, RIGHT_VECTORS };

// A mistake: the part of the source that is wrong, and the text that mends it.
struct repair {
    const char *mistake;        // the id of a known mistake (fault.h)
    char line[300], write[300]; // the statement as it stands, and as it should stand; "" if the text is not known
    int side, at;               // the stage, and the line
    int first, end;             // the words that `text` replaces
    double after;               // the mean residual that remains after this change and the changes before it
    char text[200];             // "" if the replacement is not GLSL
};
enum { MAX_REPAIRS = 3, MAX_REPAIR_STEPS = 6 };

struct reading {
    struct glsl_program *sides; // vertex and fragment
    struct reading_leaf leaves[READ_LEAVES];
    int leaf_count, light_count;
    bool rows, has_model; // matrices are stored by rows; some matrix separates the model's space from the world
    bool has_ints;        // a uniform is an int
    bool still;           // numbers of the vertex shader are 0, because with other values they move the vertices
    struct reading_sample *samples; // READ_POINTS times READ_TURNS
    struct reading_form form;
    int output; // address of the written colour in the fragment shader
    int64_t steps;
    uint64_t tried;
    bool spent;       // the time is used up
    char reason[300]; // why there is no reading
    struct arena *arena;
    const char *const *stated;     // "name=role", ends with NULL
    int variant;                   // of the values of numbers without a role
    double *numbers[READ_NUMBERS]; // the addresses of these numbers
    int number_count;
    double *switches[READ_NUMBERS]; // the addresses of uniforms of type bool
    int switch_count;
    bool one_way; // the shader is right with one value of the switches, but not with the other
    struct reading_dot {
        double value;
        bool ran, depends, diffuse;    // in any reading; on the normal; is n.l
    } *dots[2];                        // for each node of a stage
    struct reading_sample *pair;       // two samples with different normals
    double worst;                      // the largest residual of the last test
    double right[3][RIGHT_VECTORS][4]; // by space; set before each run of a stage
    // The likeliest readings that contradict no clear name, in the order in which they are tested: the first, and then
    // readings with few wrong cosines. `mean` is the mean residual of the best form.
    struct reading_state {
        uint8_t chosen[READ_LEAVES],
            roles[READ_LEAVES]; // `roles`: of the first choice, for the matrices of gl_Position
        bool rows, cheap;       // cheap: one of the first
        int wrong;
        double mean;
    } nearest[READ_NEAREST], doubt; // doubt: under this reading the shader is right, but it contradicts a clear name
    bool doubted;                   // `doubt` is set
    int nearest_count, cheap_count;
    double mean; // the mean residual of the best form of the last reading_test_forms
    double strength[READ_POINTS][READ_LIGHTS],
        distance[READ_POINTS][READ_LIGHTS];  // of the diffuse terms of the last test
    struct repair repairs[MAX_REPAIR_STEPS]; // must be made together
    int repair_count, also_count;
    const char *also[MAX_REPAIRS]; // other mistakes that explain the colours
    bool needs_highlight;          // only forms with a highlight are right: the search for mistakes must not remove it
};

// READING_AGAINST: right only under a reading that contradicts a clear name. READING_MISTAKEN: right after repairs.
enum reading_outcome { READING_NONE, READING_RIGHT, READING_AGAINST, READING_MISTAKEN };

// Finds the cheapest reading under which the shader is right.
enum reading_outcome reading_find(struct reading *r, const struct declarations *vertex,
                                  const struct declarations *fragment);

// Tests the current reading with one form, or with every correct form or every form of one mistake.
bool reading_test(struct reading *r, const struct reading_form *form);
bool reading_test_forms(struct reading *r, enum reading_forms forms);

// Adds 4 for each call of dot() that depends on the normal but is not the cosine of right vectors, 3 if one of its vectors is
// right, 2 if it is proportional to such a cosine, 1 if its vectors are normalized at the vertices, and 3 for each call that
// only other readings run. READ_MANY: the normal does not matter. With `known`, takes the dependence from the last call
// without `known`.
int reading_count_wrong(struct reading *r, bool known);

// Evaluates the shader at a sample. Returns false if the point is discarded or the evaluation failed.
bool reading_evaluate(struct reading *r, struct reading_sample *s);

// Sets the right vectors at vertex k of a sample, or at the point if k is 3.
void reading_set_right(struct reading *r, const struct reading_sample *s, int k);

// Restores one of the nearest readings, and returns what reading_count_wrong counts in it.
int reading_restore(struct reading *r, const struct reading_state *state);

// Finds changes of the source after which the shader is right under one of the nearest readings, which it restores, and
// stores them in the reading. Returns the number of changes, or 0 if none are found.
int repair_find(struct reading *r);

// Returns whether all cosines are right in a shader that computes steps, rims, ramps or shifted cosines.
bool repair_accepts(struct reading *r);

// Returns a stage's source with its repairs, allocated with malloc, or NULL if memory runs out.
char *repair_text(const struct declarations *text, const struct repair *repairs, int count, int side);

// Writes the conclusions, one line for each input.
void reading_explain(const struct reading *r, char *out, size_t capacity);

#endif
