// mistakes.c: lists the known mistakes for `lambent shader --mistake list`.
#include "commands.h"

#include <stdio.h>
#include <string.h>

#include <lambent/check.h>
#include <lambent/shader.h>

#include "json.h"

// Lists the known mistakes with their visible effects.
int run_mistakes(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands;
    bool as_json = options->report.json;
    struct json json = {.file = stdout};
    if (as_json)
        json_open(&json, NULL, '[');
    lam_shader_mistake mistake;
    for (int i = 0; lam_shader_mistake_row(i, &mistake); i++) {
        const char *wrong = "";
        for (int k = 0; lam_check_mistake(k); k++)
            if (strcmp(lam_check_mistake(k), mistake.id) == 0)
                wrong = lam_check_mistake_explanation(k);
        if (as_json) {
            json_put(&json, OBJECT(NULL, TEXT("mistake", mistake.id), TEXT("wrong", wrong),
                                   TEXT("looks", mistake.looks), TEXT("needs", mistake.needs)));
        } else {
            printf("%s\n  Wrong: %s.\n  Seen: %s\n", mistake.id, wrong, mistake.looks);
            if (mistake.needs)
                printf("  Needs: %s.\n", mistake.needs);
        }
    }
    if (as_json) {
        json_close(&json, ']');
        putchar('\n');
    }
    return 0;
}
