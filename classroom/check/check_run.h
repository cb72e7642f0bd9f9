// check_run.h: the state of one check, from its parameters to its report. check.c prepares the check and draws the
// pictures; check_compare.c compares them.
#ifndef CHECK_RUN_H
#define CHECK_RUN_H

#include "diagnostics.h"
#include "draw_request.h"
#include "fault_shader.h"
#include "shader_interface.h"

struct run {
    const lam_check_params *params;
    lam_check_report *report;
    struct arena *arena;
    struct diagnostics diagnostics;
    lam_check_painter painter;                  // the painter in use
    lam_check_contract *shipped[MAX_CONTRACTS]; // the shipped contracts, read if no contract is given
    int shipped_count;
    lam_check_contract *inferred; // inferred from the shaders if no contract contains their names
    struct program_texts sources;
    const struct complete_texts *texts; // part of `sources`: as the contract's engine compiles them
    struct shader_interface interface;
    int size;
    double tolerance;
    lam_light_frame frame; // the space of the first light
    lam_reflection reflection;
    char *vertex;    // the vertex shader, which is generated if the caller provides none
    lam_bytes bytes; // the drawing process's message; `drawn` contains pointers to parts of the message
    struct draw_result drawn;
    struct scene_comparison *scenes;
    int scene_count;
    unsigned expectation;        // bits of enum expectation
    float *numbers;              // scratch memory for the samples of a picture
    struct fault_shader *shader; // draws references that the CPU device cannot compute; NULL before its first use
};

// Reads the declarations of shaders, in the process of `draw` if the caller provides one. `user` points to the
// lam_check_params.
prefix_reader check_read_texts;

// Draws the references of `scenes` for the first expectation that the pictures meet. If the pictures meet no
// expectation, the closest expectation is used.
bool check_draw_references(struct run *run, lam_error *error);

// The steps of a comparison. check_make_scenes makes the scenes of `drawn`. check_missing_share returns the share of
// the compared pixels that are unwritten or, with `not_numbers`, NaN or infinite. check_measure measures the difference
// between each scene and its reference, and sets the verdict.
bool check_make_scenes(struct run *run, unsigned scenes, lam_error *error);
double check_missing_share(const struct scene_comparison *scene, bool not_numbers);
void check_measure(struct run *run, bool writes);

// Compares shaders of a contract that allows any strengths. FIT_UNKNOWN means that there is no verdict; `reason` then
// explains why, as a clause of a message.
enum fit_outcome { FIT_UNKNOWN, FIT_RIGHT, FIT_EXPLAINED, FIT_DIFFERS };
bool check_fit(struct run *run, bool writes, enum fit_outcome *outcome, char *reason, size_t capacity,
               lam_error *error);

// Describes which scenes differ if no known mistake explains the difference.
void check_describe(struct run *run);

// Compares the pictures of `drawn` with the reference scenes `scenes` (bits), and fills the report: scenes, verdict,
// findings. `writes` is true if the fragment shader writes a colour.
bool check_compare(struct run *run, unsigned scenes, bool writes, lam_error *error);

#endif
