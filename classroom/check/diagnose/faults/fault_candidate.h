// fault_candidate.h: sets of faults that the search tries, and the result of each fault alone. Internal to the search.
#ifndef FAULT_CANDIDATE_H
#define FAULT_CANDIDATE_H

#include "fault_search.h"

// --- draws the scenes of a search with faults switched on, and measures the remaining difference.

struct fault_measure {
    struct fault_search *s;
    struct scene_comparison *scenes; // the scenes of the search, reduced to the drawn pixels
    int stride, size;                // the stride and size of the fault shader's pictures
    struct fault_shader *shader;     // opened on first use
    float *pixels, *samples, *memory;
    int order[MAX_SCENES]; // indices of the scenes to use: differing scenes first, by descending difference
    int scene_count, differ_count;
    uint64_t pictures; // the number of pictures measured so far
};

bool fault_measure_open(struct fault_measure *measure, struct fault_search *search, lam_error *error);
void fault_measure_close(struct fault_measure *measure);

// Draws a scene: every `stride`-th pixel of every `stride`-th row.
bool fault_measure_draw(struct fault_measure *measure, int scene, const fault_set *set, float *pixels,
                        lam_error *error);

// Measures the difference between the shader's picture of a scene and the picture with these faults.
bool fault_measure_scene(struct fault_measure *measure, int scene, const fault_set *set, struct difference *difference,
                         lam_error *error);

// Returns the set, extended by one fitted fault.
fault_set fault_measure_with(const fault_set *set, const struct found_fault *fault);

// Finds the best number for a fault that is added to `base`: the factor of the exponent, or the constant exponent. Uses
// the scene whose highlight depends most on this number. *exponent is 0 if no value fits.
bool fault_measure_fit(struct fault_measure *measure, const fault_set *base, const struct fault *row, float *exponent,
                       lam_error *error);

// A scene, or the set of all scenes, is explained if the faults leave at most this fraction of the difference.
static const double max_ratio_explained = 0.125;
// No mean difference exceeds this limit.
static const double no_limit = 1e9;

// A set of faults, and the remaining difference.
struct candidate {
    struct found_fault members[MAX_FOUND_FAULTS];
    int count;
    fault_set set;
    double mean; // over all scenes
    // the fraction of a scene's difference that remains (1 means all), as a mean over the scenes; small highlights
    // count too
    double score;
    bool fits;
    double parts[MAX_SCENES]; // the contribution of each scene to the score
};

// The effect of a single fault.
struct outcome {
    struct found_fault fault;
    double mean, score;       // as in struct candidate
    double parts[MAX_SCENES]; // the contribution of each differing scene to the score
    int order[MAX_SCENES];    // scene indices: first the differing scenes, in descending order of the fault's effect
    int changed_count;        // number of differing scenes that the fault changes
    uint32_t explained;       // the differing scenes that the fault explains
    double changes[MAX_SCENES];
    int measured; // number of measured differing scenes
    bool fits;    // all measured scenes are within the tolerance
    bool applies, spoils_known, spoils;
};

// The state of a search.
struct state {
    struct fault_search *s;
    struct fault_measure m;
    struct outcome *outcomes; // one for each row of the table
    // The difference in each scene if no fault is switched on, in the measured pixels. Only a few pixels are measured.
    // Even in a scene that passes, more of these pixels may therefore differ than the tolerance allows.
    struct difference without[MAX_SCENES];
};

// Returns whether the search has reached its limit of pictures.
bool search_is_spent(struct state *t);

// Returns the contribution of one scene to a candidate's score. A scene that gets worse is treated as unchanged: a
// single fault may spoil a scene that the complete set of faults explains.
double candidate_score_of(const struct state *t, int index, const struct difference *d);

// Measures a candidate in all scenes. Stops when the mean exceeds its limit.
bool candidate_try(struct state *t, struct candidate *c, double max_mean, lam_error *error);

// Measures a set that consists of a parent and one more fault. `o` is the result of this fault alone. Sets `useful` if
// the set's score is within the limit and below the parent's score.
bool candidate_try_child(struct state *t, const struct candidate *parent, const struct outcome *o, struct candidate *c,
                         double max_score, bool *useful, lam_error *error);

// Recomputes the candidate's set from the candidate's members.
void candidate_rebuild(struct candidate *c);

// Makes the member that adds the fault `row` to the set `base`. Sets `possible` to false if this fault cannot be added.
// Returns false on error.
bool candidate_prepare(struct state *t, const fault_set *base, const struct fault *row, struct found_fault *out,
                       bool *possible, lam_error *error);

// Determines whether a fault changes a scene that passes without the fault. A shader with the fault would not pass in
// that scene.
bool outcome_find_spoils(struct state *t, struct outcome *o, lam_error *error);

// Returns the result of a row of the table.
struct outcome *outcome_of(const struct state *t, const struct fault *row);

// Runs the beam search for sets of two and more faults.
bool sets_try(struct state *t, struct candidate *best, lam_error *error);

#endif
