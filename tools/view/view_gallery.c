// view_gallery.c: makes the gallery of a folder.
#include "view.h"
#include "view_page.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "batch_shard.h"
#include "console.h"
#include "foreign.h"
#include "gallery.inc"

const char *const view_gallery_style = text_gallery_css;
const char *const view_gallery_script = text_gallery_js;

char *view_gallery_words(const struct view *view, const char *model, size_t *size)
{
    static const char *const own[] = {"--size=256x256"};
    _Static_assert(VIEW_THUMBNAIL == 256, "the word above");
    size_t name = strlen(model) + 1, given = view->page.words_size, last = strlen(own[0]) + 1;
    char *words = malloc(name + given + last);
    if (!words)
        return NULL;
    memcpy(words, model, name);
    if (given) // memcpy must not receive NULL, even for 0 bytes
        memcpy(words + name, view->page.words, given);
    memcpy(words + name + given, own[0], last);
    *size = name + given + last;
    return words;
}

// Reads the size and the modification time of a model file. Returns false if the file cannot be opened, for example
// because it is a link that leads out of the folder.
static bool is_open(const struct view *view, const char *path, struct stat *about)
{
    int file = view_files_open(&view->files, path);
    bool ok = file >= 0 && fstat(file, about) == 0;
    if (file >= 0)
        close(file);
    return ok;
}

static void put_model(FILE *out, const struct view *view, const char *path, const struct stat *about)
{
    const char *name = strrchr(path, '/') + 1;
    char *folder = strndup(path + 1, (size_t)(name - path - 1));
    fprintf(out, "<li data-size=\"%lld\" data-time=\"%lld\"><a data-name=\"", (long long)about->st_size,
            (long long)about->st_mtime);
    html_text(out, FOREIGN(path + 1));
    fputs("\" href=\"page#", out);
    html_address(out, path);
    fputs(view->page.fragment, out);
    fputs("\"><img width=\"256\" height=\"256\" alt=\"\" data-thumb=\"thumb", out);
    html_address(out, path);
    fputs("\"><span><small>", out);
    html_text(out, FOREIGN(folder));
    fputs("</small>", out);
    html_text(out, FOREIGN(name));
    fputs("</span></a></li>\n", out);
    free(folder);
}

static void put_models(FILE *out, const struct view *view, const struct batch_plan *plan)
{
    size_t prefix = strlen(view->files.prefix);
    fputs("<ul>\n", out);
    for (size_t i = 0; i < plan->count; i++) {
        const char *path = plan->models[i].path + prefix;
        path += *path == '/' && path[1] == '/'; // if the folder's name ends with '/'
        struct stat about;
        if (is_open(view, path, &about)) // false for a link that leads out of the folder
            put_model(out, view, path, &about);
    }
    fputs("</ul>\n", out);
}

// Splits a sentence into lines that fit the width of a thumbnail.
static void put_lines(FILE *out, const char *sentence)
{
    enum { LETTERS = 20, LINES = 9, LINE_PX = 26 };
    for (int line = 0; *sentence && line < LINES; line++) {
        size_t length = strlen(sentence), cut = length < LETTERS ? length : LETTERS;
        while (cut < length && cut > LETTERS / 2 && sentence[cut] != ' ')
            cut--;
        cut = cut < length && sentence[cut] != ' ' ? LETTERS : cut;
        while (cut < length && ((unsigned char)sentence[cut] & 0xc0) == 0x80) // inside a UTF-8 character
            cut++;
        char *part = strndup(sentence, cut);
        fprintf(out, "<tspan x=\"12\" dy=\"%d\">", LINE_PX);
        html_text(out, FOREIGN(part));
        fputs("</tspan>", out);
        free(part);
        sentence += cut;
        sentence += *sentence == ' ';
    }
}

char *view_gallery_failed(const struct view *view, const char *sentence, size_t *size)
{
    size_t prefix = strlen(view->files.prefix);
    if (prefix && strncmp(sentence, view->files.prefix, prefix) == 0 && sentence[prefix] == '/')
        sentence += prefix + 1;
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (!out)
        return NULL;
    fputs("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 256 256\" width=\"256\" height=\"256\">"
          "<title>",
          out);
    html_text(out, FOREIGN(sentence));
    fputs("</title><rect x=\"4\" y=\"4\" width=\"248\" height=\"248\" rx=\"8\" fill=\"#fdecea\" stroke=\"#b3261e\" "
          "stroke-width=\"2\"/>"
          "<text y=\"8\" font-family=\"sans-serif\" font-size=\"19\" fill=\"#8c1d18\">",
          out);
    put_lines(out, sentence);
    fputs("</text></svg>\n", out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

static const char gallery_bar[] =
    "</h1>\n<output id=\"count\"></output>\n"
    "<input id=\"search\" type=\"search\" placeholder=\"Search names (/)\" aria-label=\"Search names\">\n"
    "<label>Sort by <select id=\"order\"><option value=\"name\">name</option><option value=\"size\">size</option>"
    "<option value=\"date\">date, newest first</option><option value=\"failed\">errors "
    "first</option></select></label>\n"
    "</header>\n<main>\n<noscript>The gallery needs JavaScript.</noscript>\n";

bool view_gallery_make(const struct view *view, char **text, size_t *size, lam_error *error)
{
    struct batch_plan plan;
    const struct options standard = option_defaults();
    if (!batch_plan_start(&plan, &standard, error))
        return false;
    bool ok = batch_add_folder(&plan, *view->files.prefix ? view->files.prefix : "/", error);
    FILE *out = ok ? open_memstream(text, size) : NULL;
    if (ok && !out)
        ok = complain(error, LAM_MACHINE, "out of memory");
    if (ok) {
        fputs("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
              "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'self'; "
              "connect-src 'self'; img-src blob: data:; style-src 'self'; base-uri 'none'; form-action 'none'\">\n"
              "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
              "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n"
              "<link rel=\"stylesheet\" href=\"gallery.css\">\n<script type=\"module\" "
              "src=\"gallery.js\"></script>\n<title>",
              out);
        html_text(out, FOREIGN(view->folder));
        fputs(" · Lambent</title>\n</head>\n<body>\n<header>\n<h1>", out);
        html_text(out, FOREIGN(view->folder));
        fputs(gallery_bar, out);
        put_models(out, view, &plan);
        fputs("</main>\n</body>\n</html>\n", out);
        if (fclose(out) != 0)
            ok = complain(error, LAM_MACHINE, "out of memory");
    }
    batch_plan_free(&plan);
    return ok;
}
