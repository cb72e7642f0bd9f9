// contracts.c: prints a built-in contract, as a template for new contracts, or the JSON Schema of contracts. The schema
// is contract.schema.json.in with the roles inserted.
#include "commands.h"
#include "console.h"
#include "failure.h"
#include "json.h"

#include <lambent/check.h>
#include <lambent/shader.h>

#include <stdio.h>
#include <string.h>

#include "contract_schema.inc"

static void print_roles(bool attribute, bool uniform, bool constant)
{
    lam_check_role role;
    for (int i = 0, count = 0; lam_check_role_row(i, &role); i++)
        if ((attribute && role.attribute) || (uniform && role.uniform) || (constant && role.constant))
            printf("%s        {\"const\": \"%s\", \"description\": \"%s\"}", count++ ? ",\n" : "", role.name,
                   role.meaning);
    putchar('\n');
}

static void print_schema(void)
{
    for (const char *line = text_contract_schema_json_in; *line;) {
        size_t length = strcspn(line, "\n");
        const char *place = line + strspn(line, " ");
        if (strncmp(place, "@attribute_roles@", 17) == 0)
            print_roles(true, false, false);
        else if (strncmp(place, "@uniform_roles@", 15) == 0)
            print_roles(false, true, false);
        else if (strncmp(place, "@constant_roles@", 16) == 0)
            print_roles(false, false, true);
        else
            printf("%.*s\n", (int)length, line);
        line += length + (line[length] != 0);
    }
}

int run_contracts(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count;
    const char *name = strncmp(operands[0], "contract-", 9) == 0 ? operands[0] + 9 : "";
    const char *contract = lam_check_contract_text(name);
    lam_error error = {0};
    if (strcmp(name, "schema") == 0)
        print_schema();
    else if (contract)
        fputs(contract, stdout);
    else
        complain(&error, LAM_BAD_ARGUMENT,
                 "generate: found '%.100s', expected contract-schema or the name of a built-in contract, which lambent "
                 "check --list prints, after contract-",
                 operands[0]);
    return error.code ? report_failure(&error, options) : 0;
}

// --- lists the known mistakes for `lambent shader --mistake list`.

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
