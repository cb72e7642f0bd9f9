// page_write.c: writes the one-file page with a model. The page's policy lists the hashes of its scripts. The model's
// files and the command line are not scripts, so the policy needs no change. web/page/base/inside.js reads the files
// and the command line.
#include "base64.h"
#include "console.h"
#include "file_io.h"
#include "foreign.h"
#include "output.h"
#include "page.h"
#include "scene_settings.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { PAGE_MAX = 64 << 20 }; // the maximum size of the page without a model

bool page_wanted(const struct job *job) { return !job->picture_bytes && page_is_named(job->output); }

bool page_refuse_several(lam_error *error)
{
    return complain(error, LAM_BAD_ARGUMENT,
                    "a page shows one picture; several sides or sizes cannot be combined with -o FILE.html");
}

static bool check(const struct job *job, char **page, lam_error *error)
{
    const struct options *o = job->options;
    if (strcmp(job->model, "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "%s: a page needs a model with a name; standard input has none",
                        job->output);
    if (o->picture.show && strcmp(o->picture.show, "all") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "option '--show all' draws several pictures, but a page shows one");
    *page = page_file_find(error);
    return *page && output_check(job->output, job->model, output_given(o->picture.output), error);
}

static void warn_formats(const struct job *job, const struct page_model *model)
{
    const char *lacks;
    for (int i = 0; (lacks = page_model_lacks(model, lam_scene_file_info(job->scene), i)); i++)
        lam_scene_add_warning(job->scene, lacks);
}

static bool put_file(FILE *out, const struct page_file *file, size_t *left, lam_error *error)
{
    size_t size = 0, length = 0;
    lam_error why = {0};
    char *bytes = page_file_read(file->path, *left, &size, &why);
    if (!bytes && size > *left)
        return complain(error, LAM_LIMIT, "%.400s: the model's files are larger than the %d MB that a page may contain",
                        file->path, PAGE_FILES_MAX / 1000000);
    if (!bytes)
        return complain(error, why.code, "%s", why.text);
    *left -= size;
    char *text = base64_encode((const uint8_t *)bytes, size, &length);
    free(bytes);
    if (!text)
        return complain(error, LAM_MACHINE, "out of memory");
    fputs("<script type=\"text/plain\" class=\"inside-file\" data-path=\"", out);
    html_text(out, FOREIGN(file->inside));
    fputs("\">", out);
    fwrite(text, 1, length, out);
    fputs("</script>\n", out);
    free(text);
    return true;
}

// Writes the page, with the model inserted before the last </body>.
static bool put_page(FILE *out, const struct job *job, const struct options *given, const char *page,
                     const struct page_model *model, lam_error *error)
{
    const char *end = NULL;
    for (const char *at = page; (at = strstr(at, "</body>")); at++)
        end = at;
    if (!end)
        return complain(
            error, LAM_UNSUPPORTED,
            "the page given by LAMBENT_PAGE or by the build is not lambent.html: the end of its body is missing");
    size_t left = PAGE_FILES_MAX;
    bool ok = true;
    fwrite(page, 1, (size_t)(end - page), out);
    for (int i = 0; ok && i < model->count; i++)
        ok = put_file(out, &model->files[i], &left, error);
    fputs("<script type=\"application/json\" id=\"inside-words\">", out);
    ok = ok && page_model_words(out, job, given, model, error);
    fputs("</script>\n", out);
    fputs(end, out);
    return ok;
}

static bool write_page(struct job *job, const struct options *given, const char *path, lam_error *error)
{
    struct page_model model;
    size_t size = 0, length = 0;
    char *page = page_file_read(path, PAGE_MAX, &size, error), *text = NULL;
    bool ok = page && page_model_list(job, &model, error);
    if (!ok) {
        free(page);
        return false;
    }
    warn_formats(job, &model);
    FILE *out = open_memstream(&text, &length);
    ok = out ? put_page(out, job, given, page, &model, error) : complain(error, LAM_MACHINE, "out of memory");
    if (out && (ferror(out) | fclose(out)) && ok)
        ok = complain(error, LAM_MACHINE, "out of memory");
    ok = ok && output_save_bytes(&(lam_bytes){text, length}, job->output, given->picture.durable, &job->bytes, error);
    page_model_free(&model);
    free(page);
    free(text);
    return ok;
}

bool page_run(struct job *job, struct progress *progress, lam_error *error)
{
    const struct options *given =
        job->options; // loading adds the settings of a scene file to job->options, but not to `given`
    char *page = NULL;
    bool ok = check(job, &page, error);
    job->format = "html";
    job->pixels = LAM_RGBA8;
    if (ok && given->report.dry_run) {
        ok = job->planned = job_load(job, progress, error) && job_arrange(job, progress, error);
    } else if (ok) {
        ok = job_draw(job, job->pixels, progress, error);
        double start = clock_ms();
        ok = ok && write_page(job, given, page, error);
        job->times.encode += clock_ms() - start;
        job->written = ok;
        ok = ok && (!given->picture.save_scene || scene_settings_save(job, error));
    }
    free(page);
    return ok;
}

// --- finds the page and reads whole files.

#ifndef LAMBENT_DATADIR // Meson's datadir
#define LAMBENT_DATADIR "share"
#endif

bool page_is_named(const char *output)
{
    size_t length = output ? strlen(output) : 0;
    return length > 5 && strcasecmp(output + length - 5, ".html") == 0;
}

// Reports that the page is missing. For a program in a build folder, the error names the command that makes the page.
static void fail_missing(const char *folder, lam_error *error)
{
    char path[PATH_MAX + 100], *sources = NULL;
    snprintf(path, sizeof path, "%s../web/build.py", folder);
    if (access(path, R_OK) == 0) {
        path[strlen(path) - strlen("/web/build.py")] = 0;
        sources = realpath(path, NULL);
    }
    if (sources)
        complain(error, LAM_UNSUPPORTED,
                 "the page, lambent.html, is not built yet; this command builds it in about two minutes: make -C "
                 "'%.300s' web",
                 sources);
    else
        complain(
            error, LAM_UNSUPPORTED,
            "the page, lambent.html, is not installed; install the package lambent-page, or run `make web install` in "
            "the folder of Lambent's sources (or set LAMBENT_PAGE to its path)");
    free(sources);
}

char *page_file_find(lam_error *error)
{
    const char *named = getenv("LAMBENT_PAGE");
    char own[PATH_MAX], path[PATH_MAX + 100];
    char *found = NULL;
    if (named && *named) {
        found = strdup(named);
        if (!found)
            complain(error, LAM_MACHINE, "out of memory");
        return found;
    }
    // Relative to the program's folder: the installed page, and the page of a build folder.
    static const char *const places[] = {"../" LAMBENT_DATADIR "/lambent/lambent.html", "../build-web/lambent.html"};
    bool known = own_folder(own);
    for (size_t i = 0; known && i < sizeof places / sizeof *places; i++) {
        snprintf(path, sizeof path, "%s%s", own, places[i]);
        if (access(path, R_OK) != 0)
            continue;
        found = strdup(path);
        if (!found)
            complain(error, LAM_MACHINE, "out of memory");
        return found;
    }
    fail_missing(own, error);
    return NULL;
}

char *page_file_read(const char *path, size_t most, size_t *size, lam_error *error)
{
    uint64_t length = 0;
    *size = 0;
    int file = open_regular(path, &length);
    char *bytes = NULL;
    if (file < 0) {
        complain(error, LAM_CANNOT_READ, "%s: cannot read: %s", path,
                 errno ? strerror(errno) : "is not a regular file");
    } else if (length > most) {
        *size = (size_t)length;
        complain(error, LAM_LIMIT, "%s: has %.1f MB, more than the %.1f MB that fit", path, (double)length / 1e6,
                 (double)most / 1e6);
    } else if (!(bytes = malloc((size_t)length + 1))) {
        complain(error, LAM_MACHINE, "out of memory");
    } else if (!read_all(file, bytes, (size_t)length)) {
        complain(error, LAM_CANNOT_READ, "%s: cannot read: %s", path,
                 errno ? strerror(errno) : "the file has become shorter");
        free(bytes);
        bytes = NULL;
    } else {
        *size = (size_t)length;
        bytes[*size] = 0;
    }
    if (file >= 0)
        close(file);
    return bytes;
}
