// check_grades.c: writes results in formats that learning platforms import: Moodle's grading worksheet, Gradescope's
// results.json and Submitty's validation_results.json.
#include "check.h"

#include <ctype.h>
#include <errno.h>
#include <string.h>

#include "json.h"

static double share_of(const struct check_result *result)
{
    struct check_points points = check_points_of(&result->report);
    return !result->error.code && points.possible > 0 ? points.earned / points.possible : 0;
}

// Parses the names that Moodle gives to downloaded submissions, such as "Full Name_1234567_assignsubmission_file",
// where 1234567 is the participant's number.
static bool read_participant(const char *name, char full[128], char number[24])
{
    const char *end = strstr(name, "_assignsubmission");
    const char *start = end;
    while (start && start > name && isdigit((unsigned char)start[-1]))
        start--;
    if (!start || start == end || start < name + 2 || start[-1] != '_' || end - start >= 24)
        return false;
    snprintf(full, 128, "%.*s", (int)(start - 1 - name), name);
    snprintf(number, 24, "%.*s", (int)(end - start), start);
    return true;
}

int check_moodle_head(FILE *file)
{
    fputs("Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Feedback comments\n", file);
    return fflush(file) == 0 ? 0 : errno;
}

// Returns the reason for a missing verdict, without the names of folders on the teacher's computer.
static const char *reason_of(const struct check_result *result)
{
    const char *text = result->error.text, *path = result->submission->fragment;
    if (!path || strncmp(text, path, strlen(path)) != 0)
        return text;
    const char *slash = strrchr(path, '/');
    return text + (slash ? slash + 1 - path : 0);
}

// Writes one row. For a submission without a verdict, the grade is empty, so that Moodle keeps the current grade.
int check_moodle_row(FILE *file, const struct check_result *result)
{
    char full[128], number[24];
    const lam_check_report *r = &result->report;
    if (read_participant(result->submission->name.text, full, number)) {
        fprintf(file, "Participant %s,", number);
        print_foreign(file, FOREIGN_CSV, FOREIGN(full));
    } else {
        putc(',', file);
        print_foreign(file, FOREIGN_CSV, result->submission->name);
    }
    if (result->error.code)
        fputs(",,100.00,-,", file);
    else
        fprintf(file, ",%.2f,100.00,-,", 100 * share_of(result));
    print_foreign(file, FOREIGN_CSV, FOREIGN(result->error.code ? reason_of(result) : check_says(r)));
    putc('\n', file);
    return fflush(file) == 0 ? 0 : errno;
}

// Returns why a scene fails, or "".
static const char *scene_says(const lam_check_report *r, const lam_check_scene *scene)
{
    for (int i = 0; i < r->finding_count && !scene->passes && scene->looks_like; i++)
        if (strcmp(r->findings[i].mistake, scene->looks_like) == 0)
            return r->findings[i].explanation;
    return scene->passes ? "" : "the picture differs from the reference";
}

int check_gradescope(FILE *file, const struct check_result *result)
{
    const lam_check_report *r = &result->report;
    struct json json = {.file = file};
    json_open(&json, NULL, '{');
    json_text(&json, "output",
              result->error.code                                   ? result->error.text
              : r->finding_count || r->verdict == LAM_CHECK_PASSES ? check_says(r)
                                                                   : check_verdict_text(r->verdict));
    if (result->error.code || !r->scene_count)
        json_number(&json, "score", 0);
    json_open(&json, "tests", '[');
    for (int i = 0; !result->error.code && i < r->scene_count; i++) {
        const lam_check_scene *scene = &r->scenes[i];
        double earned = check_scene_points(scene);
        if (earned < 0)
            continue;
        json_put(&json,
                 OBJECT(NULL, TEXT("name", scene->name), NUMBER("score", earned), NUMBER("max_score", scene->weight),
                        TEXT("status", scene->passes ? "passed" : "failed"), TEXT("output", scene_says(r, scene))));
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', file);
    return fflush(file) == 0 ? 0 : errno;
}

int check_submitty(FILE *file, const struct check_result *result)
{
    const lam_check_report *r = &result->report;
    double share = share_of(result);
    bool passes = !result->error.code && r->verdict == LAM_CHECK_PASSES;
    struct json json = {.file = file};
    json_put(&json, OBJECT(NULL, TEXT("status", "success"), // whether the check ran, not whether the shader passes
                           OBJECT("data", NUMBER("score", share),
                                  TEXT("message", result->error.code ? result->error.text
                                                  : passes           ? check_verdict_text(r->verdict)
                                                                     : check_says(r)),
                                  TEXT("status", passes      ? "success"
                                                 : share > 0 ? "warning"
                                                             : "failure"))));
    putc('\n', file);
    return fflush(file) == 0 ? 0 : errno;
}
