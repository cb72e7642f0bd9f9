// fault_candidate.h: sets of faults that the search tries, and the outcome of each fault alone. Within the search only.
#ifndef FAULT_CANDIDATE_H
#define FAULT_CANDIDATE_H

#include "fault_measure.h"

// As fractions of the difference without faults: the largest remainder of a scene, or of all, that counts as explained.
static const double max_ratio_explained = 0.125;
// No limit of a mean difference.
static const double no_limit = 1e9;

// A set of faults, and the difference that it leaves.
struct candidate {
    struct found_fault members[MAX_FOUND_FAULTS];
    int count;
    fault_set set;
    double mean;  // over all scenes
    double score; // the remaining share of each scene's difference, on average: 1 is all, so small highlights count too
    bool fits;
    double parts[MAX_SCENES]; // of the score: the contribution of each scene
};

// The effect of a single fault.
struct outcome {
    struct found_fault fault;
    double mean, score;       // as of a candidate
    double parts[MAX_SCENES]; // likewise, of the scenes that differ
    int order[MAX_SCENES];    // the scenes: differing ones first, the ones that it changes most in front
    int changed_count;        // the number of differing scenes that it changes
    uint32_t explained;       // the scenes that differ and that it explains
    uint32_t exactly;         // the number of them that it explains up to rounding
    double changes[MAX_SCENES];
    int measured; // how many of the scenes that differ are measured
    bool fits;    // all of these are within the tolerance
    bool applies, spoils_known, spoils;
};

// A search that runs.
struct state {
    struct fault_search *s;
    struct fault_measure m;
    struct outcome *outcomes; // of each row of the table
    // Each scene without faults, in the measured pixels. Of so few, more than the tolerated ones of a scene that passes may
    // differ.
    struct difference without[MAX_SCENES];
};

// Whether a difference in a scene that passes without faults is one that the faults make.
bool candidate_is_spoilt(const struct state *t, int index, const struct difference *d);

// Whether the search has drawn as many pictures as it may.
bool search_is_spent(struct state *t);

// The part of a candidate's score that comes from one scene. A scene that gets worse counts as one without faults: where
// several faults act, one of them alone may well spoil it.
double candidate_score_of(const struct state *t, int index, const struct difference *d);

// Measures a candidate in all scenes. Stops as soon as its mean exceeds its limit.
bool candidate_try(struct state *t, struct candidate *c, double max_mean, lam_error *error);

// Measures a parent with one more fault, alone known as `o`. `useful`: its score is within the limit, and less than its
// parent's.
bool candidate_try_child(struct state *t, const struct candidate *parent, const struct outcome *o, struct candidate *c,
                         double max_score, bool *useful, lam_error *error);

// Makes the set of its members anew.
void candidate_rebuild(struct candidate *c);

// Completes a member to be added to a set. False: an error. `possible`: whether it can be added.
bool candidate_prepare(struct state *t, const fault_set *base, const struct fault *row, struct found_fault *out,
                       bool *possible, lam_error *error);

// Whether a fault changes a scene that passes without it. A shader that has the fault would not pass there.
bool outcome_find_spoils(struct state *t, struct outcome *o, lam_error *error);

// The outcome of a row of the table.
struct outcome *outcome_of(const struct state *t, const struct fault *row);

// Together, faults that explain scenes of their own, the ones that explain most first. `all`: those must explain every
// picture; otherwise, as many as explain further scenes and contradict none.
bool sets_try_supported(struct state *t, bool all, struct candidate *c, lam_error *error);

// The beam search for sets of two, three and four faults.
bool sets_try(struct state *t, struct candidate *best, lam_error *error);

#endif
