// contracts.c: prints a built-in contract, as a template for new contracts, or the JSON Schema of contracts. The schema
// is contract.schema.json.in with the roles inserted.
#include "commands.h"

#include <stdio.h>
#include <string.h>

#include <lambent/check.h>

#include "console.h"
#include "failure.h"
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
