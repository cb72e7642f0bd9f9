// check.c: checks the lighting of a fragment shader and names its mistakes; the shader runs in this process, so it must
// be trusted. cc check.c $(pkg-config --cflags --libs lambent-check) -o check
#include <lambent/check.h>
#include <lambent/image.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    static char text[1 << 16];
    lam_error error = {LAM_BAD_ARGUMENT, "usage: check SHADER.frag PICTURE.pfm"};
    FILE *file = argc == 3 ? fopen(argv[1], "rb") : NULL;
    if (file) {
        text[fread(text, 1, sizeof text - 1, file)] = 0;
        fclose(file);
    }
    lam_check_params params = {.fragment = text, .fragment_name = argv[1]};
    lam_check_report report = {0};
    // The picture: the first scene, drawn by the shader.
    bool ok = file && lam_check_run(&params, &report, &error) &&
              (!report.scene_count || lam_image_save(&report.scenes[0].theirs, argv[2], NULL, &error));
    if (ok)
        printf("%s: %s\n", argv[1], lam_check_verdict_name(report.verdict));
    for (int i = 0; i < report.finding_count; i++)
        printf("%s: %s\n    write  %s\n", report.findings[i].mistake, report.findings[i].explanation,
               report.findings[i].correction);
    lam_check_report_free(&report);
    if (!ok)
        fprintf(stderr, "%s\n", error.text);
    return ok ? 0 : (int)error.code;
}
