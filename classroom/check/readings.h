// readings.h: the interpretations ("readings") of a shader that has its own strengths and colours: the calculations
// that its text allows.
#ifndef READINGS_H
#define READINGS_H

#include "check_run.h"
#include "fault.h"

enum { MAX_EXPONENTS = 6, MAX_FORMS = 3, MAX_READINGS = 400, MAX_FAULTS = 2 };

struct reading {
    lam_reflection reflection;
    bool has_highlight, decoded; // pow(x, 1/2.2) is undone first
    fault_set set;
    const struct fault *forms[MAX_FORMS];
    int form_count;
    const struct fault *faults[MAX_FAULTS];
    int fault_count;
    double factors[3][3]; // indexed by colour channel and by term: ambient, diffuse, specular
    double mean;          // mean difference
    bool fits;
};

// Lists all interpretations of a correct shader that the text allows. Returns their number.
int readings_list(const struct run *run, struct reading out[MAX_READINGS]);

// Returns whether a fault of the table is visible in such a shader: faults of colours and strengths are part of the
// factors.
bool readings_allow_fault(const struct fault *row);

// Returns whether a word occurs in one of the texts.
bool readings_use(const struct run *run, const char *word);

// Returns whether the texts consist only of the words of an ambient, a diffuse and a specular term: pictures that no
// interpretation explains are then wrong. Steps, cones, distances, rims and similar features may be correct, but are
// not understood.
bool readings_are_plain(const struct run *run);

#endif
