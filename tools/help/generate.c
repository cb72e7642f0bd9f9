// generate.c: the command `generate`: prints texts generated from the tables of options, commands and fields.
#include "generate.h"

#include <stdio.h>
#include <string.h>

#include <lambent/check.h>

#include "console.h"
#include "contract_schema.h"
#include "exit_codes.h"
#include "suggest.h"

static const struct {
    const char *name;
    void (*print)(void);
} kinds[] = {{"man", generate_man},
             {"markdown", generate_markdown},
             {"bash", generate_bash},
             {"zsh", generate_zsh},
             {"fish", generate_fish},
             {"scene-schema", generate_scene_schema},
             {"contract-schema", generate_contract_schema}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

const char *generate_kind(int index) { return index >= 0 && index < KINDS ? kinds[index].name : NULL; }

int run_generate(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)options;
    struct suggestion nearest = suggest_start(operands[0]);
    for (int i = 0; i < KINDS; i++) {
        if (strcmp(kinds[i].name, operands[0]) == 0) {
            kinds[i].print();
            return 0;
        }
        suggest_try(&nearest, kinds[i].name);
    }
    // Prints the file of a built-in contract, as a template for new contracts.
    const char *contract = strncmp(operands[0], "contract-", 9) == 0 ? lam_check_contract_text(operands[0] + 9) : NULL;
    if (contract) {
        fputs(contract, stdout);
        return 0;
    }
    lam_error error;
    complain(&error, LAM_BAD_ARGUMENT,
             "generate: found '%.100s', expected man, markdown, bash, zsh, fish, scene-schema, contract-schema or "
             "contract-NAME%s%s%s",
             operands[0], nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "",
             nearest.best ? "'?" : "");
    say_error(error.text);
    return exit_code_of(error.code)->code;
}
