// lists.c: the commands `shapes`, `formats` and `looks`.
#include "command.h"

#include <stdio.h>

#include "console.h"
#include "exit_codes.h"
#include "look_option.h"

int run_shapes(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands, (void)options;
    for (int i = 0; i < lam_shape_count(); i++)
        printf("%-12s %s\n", lam_shape_name(i), lam_shape_summary(i));
    return 0;
}

int run_looks(int operand_count, char **operands, const struct options *options)
{
    (void)options;
    char summary[200];
    for (int i = 0; look_name(i) && !operand_count; i++) {
        look_summary(look_text(i), summary, sizeof summary);
        printf("%-12s %s\n", look_name(i), summary);
    }
    const char *text = operand_count ? look_find(operands[0]) : NULL;
    if (text)
        fputs(text, stdout);
    if (text || !operand_count)
        return 0;
    lam_error error;
    complain(&error, LAM_BAD_ARGUMENT, "looks: found '%.100s', expected studio, classic, catalog or technical",
             operands[0]);
    say_error(error.text);
    return exit_code_of(error.code)->code;
}

int run_formats(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands, (void)options;
    printf("Models:\n");
    for (int i = 0; lam_model_format_name(i); i++)
        printf("  %-6s .%s\n", lam_model_format_name(i), lam_model_format_extensions(i));
    printf("Pictures that are written:\n"
           "  png    .png  8 bits, sRGB, with alpha\n"
           "  ppm    .ppm  8 bits, sRGB, over the background\n"
           "  pfm    .pfm  floats, linear, premultiplied by alpha\n"
           "  exr    .exr  floats, linear, premultiplied by alpha, with alpha\n"
           "  jpg    .jpg .jpeg  8 bits, sRGB, over the background, lossy (--quality)\n"
           "  webp   .webp  8 bits, sRGB, with alpha, lossless unless --quality is below 100\n"
           "Pictures that are read (environments, textures):\n"
           "  png, jpg, webp, bmp, tga, ppm, pfm, exr, hdr\n");
    return 0;
}
