// readings.h: the readings of a shader with its own strengths and colours: the calculations that its text permits.
#ifndef READINGS_H
#define READINGS_H

#include "check_run.h"
#include "fault.h"

enum { MAX_EXPONENTS = 6, MAX_FORMS = 3, MAX_READINGS = 400, MAX_FAULTS = 2 };

struct reading {
    lam_reflection reflection;
    bool has_highlight, decoded; // pow(x, 1/2.2) is undone before
    fault_set set;
    const struct fault *forms[MAX_FORMS];
    int form_count;
    const struct fault *faults[MAX_FAULTS];
    int fault_count;
    double factors[3][3]; // of red, green and blue; of the ambient, diffuse and specular term
    double mean;          // difference
    bool fits;
};

// All readings of a correct shader that the text permits. Returns their count.
int readings_list(const struct run *run, struct reading out[MAX_READINGS]);

// Whether a fault of the table shows in such a shader: faults of colours and strengths are within the factors.
bool readings_allow_fault(const struct fault *row);

// Whether a word occurs in one of the texts.
bool readings_use(const struct run *run, const char *word);

// Whether the texts are made of nothing but the words of an ambient, a diffuse and a specular term: then pictures that no reading
// explains are wrong. Steps, cones, distances, rims and the like may be right, and are not understood.
bool readings_are_plain(const struct run *run);

#endif
