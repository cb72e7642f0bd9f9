// contract_schema.h: prints the JSON Schema of shader contracts for the command `generate`.
#ifndef CONTRACT_SCHEMA_H
#define CONTRACT_SCHEMA_H

// Prints the schema to standard output.
void generate_contract_schema(void);

#endif
