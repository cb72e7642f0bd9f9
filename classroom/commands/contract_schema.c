// contract_schema.c: prints the JSON Schema of shader contracts. The schema is contract.schema.json.in with the roles
// inserted.
#include "contract_schema.h"

#include <stdio.h>
#include <string.h>

#include <lambent/check.h>

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

void generate_contract_schema(void)
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
