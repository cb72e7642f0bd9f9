// target_shader.c: fuzz target for the reader of GLSL in `lambent check`. An input is a fragment shader; after a zero
// byte, a vertex shader; after another one, the messages of a compiler, which refuses both.
#include "target.h"

#include <lambent/check.h>

#include <stdio.h>
#include <string.h>

static const char *messages;

static void *open_place(void *user, lam_check_language language, int size, char renderer[128], lam_error *error)
{
    (void)language, (void)size, (void)error;
    snprintf(renderer, 128, "nothing");
    return user;
}

static void close_place(void *place) { (void)place; }

static bool wake(void *place, lam_error *error)
{
    (void)place, (void)error;
    return true;
}

static bool compile(void *place, const char *vertex, const char *fragment, lam_check_program *program, lam_error *error)
{
    (void)place, (void)error;
    *program = (lam_check_program){.refused_vertex = strlen(vertex) % 2, .refused_fragment = strlen(fragment) % 2};
    char *logs[] = {program->vertex_log, program->fragment_log, program->link_log};
    for (int i = 0; i < 3; i++)
        snprintf(logs[i], sizeof program->vertex_log, "%s", messages);
    return true;
}

static void forget(void *place, lam_check_program *program) { (void)place, (void)program; }

static bool draw(void *place, const lam_check_drawing *drawing, float *pixels, lam_error *error)
{
    (void)place, (void)drawing, (void)pixels;
    *error = (lam_error){LAM_UNSUPPORTED, "nothing is drawn"};
    return false;
}

// Invariant for every source: a contract, or an error message; a verdict without pictures, or an error message.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *texts[3] = {calloc(size + 3, 1)};
    if (!texts[0])
        abort();
    if (size)
        memcpy(texts[0], data, size);
    for (int i = 1; i < 3; i++)
        texts[i] = texts[i - 1] + strlen(texts[i - 1]) + 1;
    static int place;
    const lam_check_painter painter = {.user = &place,
                                       .open = open_place,
                                       .close = close_place,
                                       .rest = close_place,
                                       .wake = wake,
                                       .compile = compile,
                                       .forget = forget,
                                       .draw = draw,
                                       .es_only = size % 4 == 3};
    const lam_check_params params = {.fragment = texts[0],
                                     .fragment_name = "fuzz.frag",
                                     .vertex = *texts[1] ? texts[1] : NULL,
                                     .vertex_name = "fuzz.vert",
                                     .size = 32,
                                     .painter = &painter};
    messages = texts[2];
    lam_bytes bytes = {0};
    lam_error error = {0};
    bool ok = lam_check_contract_write(&params, NULL, &bytes, &error);
    note_sentence(ok ? "" : error.text);
    if (ok ? !bytes.size : error.code == LAM_OK || !error.text[0])
        abort();
    lam_bytes_free(&bytes);
    lam_check_report report = {0};
    error = (lam_error){0};
    ok = lam_check_run(&params, &report, &error);
    note_sentence(ok ? lam_check_verdict_name(report.verdict) : error.text);
    if (ok ? report.verdict != LAM_CHECK_REFUSED : error.code == LAM_OK || !error.text[0])
        abort();
    lam_check_report_free(&report);
    free(texts[0]);
    return 0;
}
