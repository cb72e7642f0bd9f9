// check_run.h: the state of one check, from its parameters to its report. check.c prepares the check and draws the
// pictures; check_compare.c compares them.
#ifndef CHECK_RUN_H
#define CHECK_RUN_H

#include "diagnostics.h"
#include "draw_request.h"
#include "fault_shader.h"
#include "reading.h"
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
    bool writes_colour;   // false if the fragment shader's outputs are unused: its pictures are undefined
    unsigned expectation; // bits of enum expectation
    float *numbers;       // scratch memory for the samples of a picture
    // Draws the scenes again with other texts, and keeps the verdict. The pictures of the scenes stay in the report.
    bool (*draw_again)(struct run *run, unsigned scenes, lam_error *error);
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
void check_measure(struct run *run);

// Finds a reading of the inputs (reading.h). A contract fixes the roles. `engine` is the contract whose prefix the sources
// lack, or NULL. `text` (may be NULL) receives the text of the contract that describes the reading.
bool check_read(struct run *run, const struct contract *contract, const struct contract *engine, struct reading **out,
                enum reading_outcome *outcome, char **text, lam_error *error);

// Gives the verdict that follows from a reading. Returns false if there is no verdict.
bool check_conclude(struct run *run, struct reading *reading, enum reading_outcome outcome, unsigned scenes,
                    lam_error *error);

// Gives a shader that differs the benefit of the doubt: its names only suggested the contract. Returns false if there is
// no verdict.
bool check_doubt(struct run *run, const struct contract *contract, unsigned scenes, lam_error *error);

// Describes which scenes differ if no known mistake explains the difference.
void check_describe(struct run *run);

// Compares the pictures of `drawn` with the reference scenes `scenes` (bits), and fills the report: scenes, verdict,
// findings.
bool check_compare(struct run *run, unsigned scenes, lam_error *error);

#endif
