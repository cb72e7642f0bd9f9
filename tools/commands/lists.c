// lists.c: the commands `shapes` and `formats`.
#include "command.h"

#include <stdio.h>

int run_shapes(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands, (void)options;
    for (int i = 0; i < lam_shape_count(); i++)
        printf("%-12s %s\n", lam_shape_name(i), lam_shape_summary(i));
    return 0;
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
