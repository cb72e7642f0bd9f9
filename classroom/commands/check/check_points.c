// check_points.c: computes the points of a report and formats its verdict.
#include "check.h"

const char *check_verdict_text(lam_check_verdict verdict)
{
    switch (verdict) {
    case LAM_CHECK_PASSES:
        return "passes: its pictures match the reference";
    case LAM_CHECK_DIFFERS:
        return "differs from the reference";
    case LAM_CHECK_REFUSED:
        return "does not compile or link";
    case LAM_CHECK_ENDLESS:
        return "does not end: it exceeded its time limit";
    case LAM_CHECK_CRASHES:
        return "crashes the graphics driver";
    case LAM_CHECK_NOT_NUMBER:
        return "writes NaN or infinity";
    case LAM_CHECK_MEMORY:
        return "needs more memory than it may use (--memory-limit)";
    }
    return "";
}

// The limits of a scene that passes (scene_comparison.c), for the default tolerance.
static const double max_share_over = 0.005, max_mean = 0.5 / 255;

const char *check_scene_word(const lam_check_scene *scene)
{
    // a black picture earns no points, even if it matches the reference
    if (!scene->passes && scene->share_over <= max_share_over && scene->mean <= max_mean && !scene->not_numbers)
        return "black, no points";
    return scene->passes ? "same" : "differs";
}

double check_scene_points(const lam_check_scene *scene)
{
    return scene->terms ? (scene->passes ? scene->weight : 0) : -1;
}

struct check_points check_points_of(const lam_check_report *r)
{
    static const unsigned terms[] = {LAM_CHECK_TERM_AMBIENT, LAM_CHECK_TERM_DIFFUSE, LAM_CHECK_TERM_SPECULAR};
    struct check_points points = {.possible = r->scene_count ? 0 : r->scenes_wanted, .terms = {-1, -1, -1}};
    int alone[3] = {0}, passed[3] = {0};
    for (int i = 0; i < r->scene_count; i++) {
        double earned = check_scene_points(&r->scenes[i]);
        points.possible += earned >= 0 ? r->scenes[i].weight : 0;
        points.earned += earned > 0 ? earned : 0;
        for (int t = 0; t < 3; t++)
            if (r->scenes[i].terms == terms[t]) {
                alone[t]++;
                passed[t] += r->scenes[i].passes;
            }
    }
    for (int t = 0; t < 3; t++)
        if (alone[t])
            points.terms[t] = (double)passed[t] / alone[t];
    return points;
}
