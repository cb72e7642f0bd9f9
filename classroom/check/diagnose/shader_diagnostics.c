// shader_diagnostics.c: makes diagnostics from the compiler's log, and diagnostics about names that are not in the
// contract.
#include "diagnostics.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { MAX_LOG_LINES = 8 };

// Parses "0:12(5): error: …" (Mesa), "0(12) : error …" (NVIDIA) or "ERROR: 0:12: …" (others). Returns the line number
// (0 if there is none) and the start of the message.
static int line_of(const char *text, const char **words)
{
    int string = 0, line = 0, used = 0;
    *words = text;
    const char *at = strncmp(text, "ERROR: ", 7) == 0 ? text + 7 : text;
    if ((sscanf(at, "%d:%d(%*d)%n", &string, &line, &used) >= 2 && used) ||
        (sscanf(at, "%d:%d%n", &string, &line, &used) >= 2 && used) ||
        (sscanf(at, "%d(%d)%n", &string, &line, &used) >= 2 && used)) {
        at += used;
        while (*at == ' ' || *at == ':')
            at++;
        *words = at;
        return line;
    }
    return 0;
}

// Recognises errors of Mesa about the operands of an expression. These errors follow from an earlier error in the same
// line.
static bool is_about_operands(const char *words)
{
    return strstr(words, "operands to arithmetic operators") || strstr(words, "type mismatch");
}

// Recognises lines that do not explain the failure: warnings, the overloads that Mesa lists, and errors that follow
// from an earlier error.
static bool is_noise(const char *words)
{
    return strncmp(words, "warning", 7) == 0 || strncmp(words, "error:    ", 10) == 0 || strstr(words, "(error") ||
           strstr(words, ", error") || strstr(words, "of type error");
}

// Adds the messages of one log. Adds hints to each message. If `d` is NULL, the log is the linker's.
static void add_log(struct diagnostics *diagnostics, const char *text, const struct declarations *d, const char *file)
{
    char log[sizeof((struct draw_result *)0)->log];
    snprintf(log, sizeof log, "%s", text);
    int line_count = 0, last = 0;
    char *rest = log;
    for (char *line; (line = strsep(&rest, "\n")) && line_count < MAX_LOG_LINES;) {
        for (char *c = line; *c; c++)
            if (iscntrl((unsigned char)*c))
                *c = ' ';
        const char *words;
        int at = line_of(line, &words);
        if (strspn(line, " ") == strlen(line) || is_noise(words) || (at > 0 && at == last && is_about_operands(words)))
            continue;
        last = at;
        char *candidates = strstr(line, "; candidates are:");
        if (candidates)
            *candidates = 0;
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_COMPILER, file, at, "%.400s", words);
        line_count++;
        if (d)
            compiler_hints_for_message(diagnostics, d, file, at, words);
    }
    if (!line_count)
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_COMPILER, file, 0, "refused without a message");
}

void diagnostics_add_refusal(struct diagnostics *diagnostics, const struct draw_result *drawn,
                             const struct shader_interface *interface, const lam_check_params *params)
{
    if (drawn->state == DRAWN_REFUSED_LINK) {
        add_log(diagnostics, drawn->log, NULL, NULL);
        compiler_hints_for_link(diagnostics, interface, params);
        return;
    }
    // A generated vertex shader fails only because of the fragment shader's declarations.
    if (drawn->refused_vertex && (params->vertex || !drawn->refused_fragment)) {
        add_log(diagnostics, drawn->log, &interface->vertex, params->vertex_name);
        compiler_hints_for_text(diagnostics, &interface->vertex, params->vertex_name, true);
    }
    if (drawn->refused_fragment) {
        add_log(diagnostics, drawn->fragment_log, &interface->fragment, params->fragment_name);
        compiler_hints_for_text(diagnostics, &interface->fragment, params->fragment_name, false);
    }
}

static const char *file_of(const lam_check_params *params, bool vertex)
{
    return vertex ? params->vertex_name : params->fragment_name;
}

static void report_unknown(struct diagnostics *diagnostics, const struct shader_interface *r, const char *name,
                           const char *kind, const char *file, int line)
{
    const char *near = contract_nearest(r->contract, name);
    if (near)
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_UNKNOWN, file, line,
                        "%s '%.60s' is not in the contract %s; did you mean '%s'?", kind, name, r->contract->name,
                        near);
    else
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_UNKNOWN, file, line,
                        "%s '%.60s' is not in the contract %s, so the check does not set it; `lambent check --list` "
                        "prints the contract's names",
                        kind, name, r->contract->name);
}

// Reports a uniform whose type differs from the contract's type: a matrix instead of a vector, or the reverse.
static void report_type_mismatch(struct diagnostics *diagnostics, const struct shader_interface *r,
                                 const struct declaration *d, const char *file)
{
    const struct contract_name *known = contract_find(r->contract, d->name, false, NULL);
    bool texture = known && strcmp(d->type, "sampler2D") == 0 && role_of(known->semantic)->types & TYPE_SAMPLER;
    if (known && !texture &&
        ((strncmp(known->type, "mat", 3) == 0) != (strncmp(d->type, "mat", 3) == 0) ||
         (strncmp(known->type, "vec", 3) == 0) != (strncmp(d->type, "vec", 3) == 0)))
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, file, d->line, "uniform %s %s: write uniform %s %s",
                        d->type, d->name, known->type, d->name);
}

// Returns whether a declared name is active. For "lights[].a", the driver reports "lights[0].a", and for a block's
// member "Block.a".
static bool is_active(const struct draw_result *drawn, const char *declared)
{
    for (int i = 0; i < drawn->unknown_count; i++) {
        const char *a = drawn->unknown[i], *b = declared, *dot = strchr(a, '.');
        for (int k = 0; k < 2 && a; k++, a = dot ? dot + 1 : NULL) {
            const char *x = a;
            for (b = declared; *x && *x == *b; x++, b++)
                if (*x == '[')
                    x += strcspn(x, "]") - 1;
            if ((!*x || *x == '[') && (!*b || *b == '['))
                return true;
        }
    }
    return false;
}

void diagnostics_add_names(struct diagnostics *diagnostics, const struct draw_result *drawn,
                           const struct shader_interface *r, const lam_check_params *params)
{
    const struct declarations *sides[] = {&r->vertex, &r->fragment};
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++) {
            const struct declaration *d = &sides[s]->items[i];
            const char *file = file_of(params, s == 0);
            bool attribute = s == 0 && d->kind == DECLARED_INPUT && params->vertex;
            if (d->kind != DECLARED_UNIFORM && !attribute)
                continue;
            if (!contract_find(r->contract, d->name, attribute, NULL)) {
                // An unknown name that has no effect is harmless.
                if (drawn->state != DRAWN_PICTURES || is_active(drawn, d->name))
                    report_unknown(diagnostics, r, d->name, attribute ? "attribute" : "uniform", file, d->line);
            } else if (!attribute)
                report_type_mismatch(diagnostics, r, d, file);
        }
    for (int i = 0; i < drawn->unknown_count; i++) { // the input is active but not in the source, because macros
                                                     // generate it
        bool seen = false;
        for (int s = 0; s < 2; s++)
            for (int k = 0; k < sides[s]->count; k++) {
                const char *name = sides[s]->items[k].name;
                size_t length = strcspn(name, "[");
                seen |= strncmp(name, drawn->unknown[i], length) == 0;
            }
        if (!seen)
            report_unknown(diagnostics, r, drawn->unknown[i], "uniform", NULL, 0);
    }
    for (int i = 0; i < drawn->types_count; i++)
        diagnostics_add(diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "%s; the check does not set it",
                        drawn->types[i]);
}
