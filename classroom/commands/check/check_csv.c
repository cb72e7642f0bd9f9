// check_csv.c: writes a file of comma-separated values (RFC 4180), with one row for each shader.
#include "check.h"

#include <errno.h>
#include <string.h>

int check_csv_head(FILE *file)
{
    fputs("submission,verdict,points,of,percent,ambient,diffuse,specular", file);
    for (int i = 0; lam_check_scene_name(i); i++)
        fprintf(file, ",scene %s", lam_check_scene_name(i));
    fputs(",mistakes,explained percent,says,fragment,vertex,sheet\n", file);
    return fflush(file) == 0 ? 0 : errno;
}

static void put_numbers(FILE *file, const lam_check_report *r)
{
    struct check_points points = check_points_of(r);
    fprintf(file, ",%g,%g,%.1f", points.earned, points.possible,
            points.possible > 0 ? 100.0 * points.earned / points.possible : 0.0);
    for (int t = 0; t < 3; t++)
        if (points.terms[t] < 0)
            putc(',', file);
        else
            fprintf(file, ",%g", points.terms[t]);
    for (int i = 0; lam_check_scene_name(i); i++) {
        double earned = -1;
        for (int k = 0; k < r->scene_count; k++)
            if (strcmp(r->scenes[k].name, lam_check_scene_name(i)) == 0)
                earned = check_scene_points(&r->scenes[k]);
        if (earned < 0)
            putc(',', file);
        else
            fprintf(file, ",%g", earned);
    }
}

const char *check_says(const lam_check_report *r)
{
    if (r->finding_count)
        return r->findings[0].explanation;
    if (r->verdict == LAM_CHECK_PASSES)
        return "";
    return r->diagnostic_count ? r->diagnostics[0].text : check_verdict_text(r->verdict);
}

int check_csv_row(FILE *file, const struct check_result *result)
{
    const lam_check_report *r = &result->report;
    const struct check_submission *s = result->submission;
    print_foreign(file, FOREIGN_CSV, s->name);
    if (result->error.code) {
        fputs(",no verdict,,,,,,", file);
        for (int i = 0; lam_check_scene_name(i); i++)
            putc(',', file);
        fputs(",,,", file);
        print_foreign(file, FOREIGN_CSV, FOREIGN(result->error.text));
    } else {
        fprintf(file, ",%s", lam_check_verdict_name(r->verdict));
        put_numbers(file, r);
        putc(',', file);
        for (int i = 0; i < r->finding_count; i++)
            fprintf(file, "%s%s", i ? " " : "", r->findings[i].mistake);
        if (r->finding_count)
            fprintf(file, ",%.0f,", r->findings[r->finding_count - 1].share * 100);
        else
            fputs(",,", file);
        print_foreign(file, FOREIGN_CSV, FOREIGN(check_says(r)));
    }
    putc(',', file);
    print_foreign(file, FOREIGN_CSV, FOREIGN(s->fragment ? s->fragment : ""));
    putc(',', file);
    print_foreign(file, FOREIGN_CSV, FOREIGN(s->vertex ? s->vertex : ""));
    putc(',', file);
    print_foreign(file, FOREIGN_CSV, FOREIGN(result->sheet ? result->sheet : ""));
    putc('\n', file);
    return fflush(file) == 0 ? 0 : errno; // so that this grade is saved even if a later check fails
}
