// render_one.c: calls lam_render with its defaults and saves the picture.
#include <lambent/lambent.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    lam_error error = {LAM_BAD_ARGUMENT, "usage: render_one MODEL PICTURE"};
    lam_image image = {0};
    lam_render_report report = {0};
    bool ok = argc == 3 && lam_render(argv[1], NULL, &image, &report, &error) &&
              lam_image_save(&image, argv[2], NULL, &error);
    if (!ok)
        fprintf(stderr, "%s\n", error.text);
    else if (!report.triangles || !report.frame.pixels_covered || report.camera.fovy_rad <= 0)
        ok = (fprintf(stderr, "the report is empty\n"), false);
    lam_image_free(&image);
    return ok ? 0 : (int)error.code;
}
