// interpretations.h: the interpretations of a shader that has its own strengths and colours. An interpretation is a
// calculation that the source may contain.
#ifndef INTERPRETATIONS_H
#define INTERPRETATIONS_H

#include "check_run.h"
#include "fault.h"

enum { MAX_EXPONENTS = 6, MAX_FORMS = 3, MAX_INTERPRETATIONS = 400, MAX_FAULTS = 2 };

struct interpretation {
    lam_reflection reflection;
    bool has_highlight, decoded; // decoded: pow(x, 1/2.2) at the end of the shader is undone before the comparison
    fault_set set;
    const struct fault *forms[MAX_FORMS];
    int form_count;
    const struct fault *faults[MAX_FAULTS];
    int fault_count;
    double factors[3][3]; // indexed by colour channel and by term: ambient, diffuse, specular
    double mean;          // mean difference
    bool fits;
};

// Lists all interpretations under which the source is a correct shader. Returns their number.
int interpretations_list(const struct run *run, struct interpretation out[MAX_INTERPRETATIONS]);

// Returns whether a fault of the table is visible in a shader with its own strengths and colours. Faults of colours and
// strengths are not visible, because the fitted factors compensate for these faults.
bool interpretations_allow_fault(const struct fault *row);

// Returns whether a word occurs in one of the two sources.
bool interpretations_use(const struct run *run, const char *word);

// Returns whether the sources contain only words that occur in an ambient, a diffuse or a specular term. If so, and if
// no interpretation explains the pictures, the shader is wrong. Steps, cones, distances, rims and similar features may
// be correct, but the check does not understand them.
bool interpretations_are_plain(const struct run *run);

#endif
