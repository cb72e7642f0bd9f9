// lists.c: the commands `shapes`, `formats` and `looks`.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "limit_options.h"

int run_shapes(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands, (void)options;
    for (int i = 0; i < lam_shape_count(); i++)
        printf("%-12s %s\n", lam_shape_name(i), lam_shape_summary(i));
    return 0;
}

// Draws a teapot in each built-in look, as `lambent compare` does.
static int draw_looks(const struct options *given)
{
    char across[OPTION_WORDS_SIZE] = "look=", model[] = "teapot", option[] = "--across";
    char *words[] = {option, across}, *operands[] = {model};
    struct options own = *given;
    lam_error error = {0};
    own.sheet.across = (struct texts){0};
    for (int i = 0; look_name(i); i++)
        snprintf(across + strlen(across), sizeof across - strlen(across), "%s%s", i ? "," : "", look_name(i));
    if (options_parse(2, words, find_groups("compare"), &own, &error) < 0) {
        say_error(error.text);
        return exit_code_of(error.code)->code;
    }
    if (!own.picture.output)
        own.picture.output = "looks.png";
    int code = run_compare(1, operands, &own);
    free(own.sheet.across.items);
    return code;
}

int run_looks(int operand_count, char **operands, const struct options *options)
{
    char summary[200];
    if (!operand_count && (options->picture.output || option_given(options, "sheet")))
        return draw_looks(options);
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
    char names[OPTION_WORDS_SIZE];
    complain(&error, LAM_BAD_ARGUMENT, "looks: found '%.100s', expected %s", operands[0],
             option_words_list(option_find("look"), names));
    say_error(error.text);
    return exit_code_of(error.code)->code;
}

int run_formats(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands, (void)options;
    printf("Models:\n");
    bool installed;
    for (int i = 0; lam_model_format_name(i); i++) {
        const char *package = lam_model_format_package(i, &installed);
        const char *how = !package ? "" : installed ? "  with " : "  not installed: apt install ";
        printf("  %-6s .%s%s%s\n", lam_model_format_name(i), lam_model_format_extensions(i), how,
               package ? package : "");
    }
    printf("Pictures that are written:\n");
    const char *name;
    for (int i = 0; (name = lam_image_format_name(i)); i++) {
        const char *alias = lam_image_format_alias(i);
        if (lam_image_format_written(i))
            printf("  %-6s .%s%s%s  %s\n", name, name, alias ? " ." : "", alias ? alias : "",
                   lam_image_format_written(i));
    }
    printf("Pictures that are read (environments, textures):\n ");
    for (int i = 0; (name = lam_image_format_name(i)); i++)
        if (lam_image_format_is_read(i))
            printf("%s %s", i ? "," : "", name);
    printf("\n");
    return 0;
}
