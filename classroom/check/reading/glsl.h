// glsl.h: GLSL as a tree of typed nodes, which can be evaluated at single points and changed.
//
// GLSL forbids recursion, so every variable and every node has a fixed address in one memory. After a run, the memory
// therefore contains the last value of each part of the source.
#ifndef GLSL_H
#define GLSL_H

#include "arena.h"
#include "declarations.h"

enum glsl_base { GLSL_VOID, GLSL_BOOL, GLSL_INT, GLSL_FLOAT, GLSL_SAMPLER, GLSL_STRUCT };

struct glsl_type {
    uint8_t base, columns, rows; // a scalar has one column and one row
    uint8_t structure;           // index of a struct
    uint16_t count;              // elements of an array; 0 if the type is not an array
};

enum glsl_kind {
    // Expressions. The children are the operands.
    GLSL_CONSTANT,
    GLSL_VARIABLE,
    GLSL_MEMBER,    // `number` is the offset in the struct
    GLSL_INDEX,     // of an array, a matrix or a vector
    GLSL_SWIZZLE,   // `number` contains the components, two bits each
    GLSL_UNARY,     // - ! + (op)
    GLSL_BINARY,    // op: the character, or OP_…
    GLSL_ASSIGN,    // op: '=', or the operator of a compound assignment
    GLSL_INCREMENT, // op: '+' or '-'; `number` is 1 if the old value is the result
    GLSL_CHOICE,    // a ? b : c
    GLSL_CONSTRUCT,
    GLSL_BUILTIN, // `number` is the index of the function
    GLSL_CALL,    // `number` is the index of the function
    GLSL_GIVEN,   // the vector or number at `given`, which a test supplies
    // Statements.
    GLSL_BLOCK,
    GLSL_IF,
    GLSL_LOOP, // initialization, condition, step, body; `op` is 'd' for do
    GLSL_RETURN,
    GLSL_BREAK,
    GLSL_CONTINUE,
    GLSL_DISCARD,
    GLSL_EMPTY,
};
enum { OP_LESS_EQUAL = 1, OP_GREATER_EQUAL, OP_EQUAL, OP_NOT_EQUAL, OP_AND, OP_OR, OP_XOR, OP_LEFT, OP_RIGHT };

struct glsl_node {
    uint8_t kind, op;
    struct glsl_type type;
    int first, next; // the first child, and the next child of the parent; −1 if there is none
    int at;          // address of the value; of a variable, the variable's address
    int number;
    int word, end; // the words of the source: from `word` to before `end`
    const double *given;
};

enum glsl_storage { GLSL_LOCAL, GLSL_UNIFORM, GLSL_INPUT, GLSL_OUTPUT };
struct glsl_symbol {
    char name[64]; // of a block without an instance, each member is a symbol
    struct glsl_type type;
    uint8_t storage;
    bool flat, constant;
    bool unit; // a test normalizes the interpolated input
    int at;
};

struct glsl_member {
    char name[64];
    struct glsl_type type;
    int offset;
};
struct glsl_structure {
    char name[64];
    int first, count, size; // members
};
enum { GLSL_PARAMETERS = 16, GLSL_STRUCTURES = 24, GLSL_MEMBERS = 160, GLSL_FUNCTIONS = 60, GLSL_SYMBOLS = 600 };
struct glsl_function {
    char name[64];
    struct glsl_type type;
    int count; // parameters
    struct glsl_type types[GLSL_PARAMETERS];
    int places[GLSL_PARAMETERS];
    uint8_t out[GLSL_PARAMETERS]; // 1: in, 2: out, 3: inout
    int body, result;             // body: -1 while only a prototype is known; result: address
};

struct glsl_program {
    const struct declarations *text;
    bool vertex;
    struct glsl_node *nodes;
    int node_count, node_capacity;
    struct glsl_symbol symbols[GLSL_SYMBOLS]; // after parsing: the global variables
    int symbol_count;
    struct glsl_structure structures[GLSL_STRUCTURES];
    struct glsl_member members[GLSL_MEMBERS];
    struct glsl_function functions[GLSL_FUNCTIONS];
    int structure_count, member_count, function_count;
    double *memory;
    int used;                                           // of `memory`
    int main_body, initializers[64], initializer_count; // initializers of global variables
    int64_t steps;                                      // the run stops when this number reaches 0
    bool discarded;
    char unsupported[120]; // the reason why the source cannot be read or evaluated; "" if there is none
    int at, depth;         // used while parsing
    bool inner;            // while parsing: inside of a function other than main()
};

// Parses a source. Returns false if a part of it is not supported (p->unsupported). The memory is from the arena.
bool glsl_parse(struct glsl_program *p, const struct declarations *text, bool vertex, struct arena *arena);

// Runs main(). Returns false if the run used all steps or an unsupported function.
bool glsl_run(struct glsl_program *p);

// Evaluates an expression. The result is in the program's memory.
double *glsl_value(struct glsl_program *p, int node);

static inline int glsl_width(struct glsl_type t) { return t.columns * t.rows; } // of one element
static inline int glsl_size(const struct glsl_program *p, struct glsl_type t)
{
    int one = t.base == GLSL_STRUCT ? p->structures[t.structure].size : t.base == GLSL_SAMPLER ? 4 : glsl_width(t);
    return one * (t.count ? t.count : 1);
}
const struct glsl_symbol *glsl_symbol(const struct glsl_program *p, const char *name);

// Returns the index of a built-in function, or −1; and the type of its result.
int glsl_builtin(const char *name);
struct glsl_type glsl_builtin_type(int function, const struct glsl_type *arguments, int count);
const char *glsl_builtin_name(int function);
bool glsl_is_dot(const struct glsl_program *p, int node); // whether a node is a call of dot()

#endif
