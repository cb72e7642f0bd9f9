// tables.c: the tables of the equations (scripts/albedo_tables.py makes them).
extern const float albedo_table[], bias_table[], sheen_table[];

const float albedo_table[] = {
#include "albedo.table"
};
const float bias_table[] = {
#include "bias.table"
};
const float sheen_table[] = {
#include "sheen.table"
};
