// diff.c: the command `diff`: compares two pictures, two models, or the models of two folders.
#include "command.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "console.h"
#include "diff.h"
#include "file_io.h"
#include "output.h"
#include "report.h"

// Returns whether a path names a model. A file with the extension .json counts as a model, because no picture format
// uses this extension.
static bool is_model(const char *path)
{
    const char *dot = strrchr(path, '.');
    return is_model_name(path) || (dot && strcmp(dot, ".json") == 0) || lam_shape_find(path) >= 0;
}

// Rejects options that have no effect on the comparison of two pictures.
static bool check_pictures(const struct options *o, lam_error *error)
{
    static const char *const names[] = {"output", "json", "quiet", NULL};
    for (int i = 0; option_table[i].name; i++) {
        const struct option *option = &option_table[i];
        bool takes = option->group == GROUP_DIFF || option->group == GROUP_ABOUT || option->single == TAKES_MEMORY ||
                     option->single == TAKES_PICTURE_LIMITS;
        for (int k = 0; !takes && names[k]; k++)
            takes = strcmp(option->name, names[k]) == 0;
        if (o->given[i] && !takes)
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '--%s' does not apply to pictures; it draws the models that diff compares",
                            option->name);
    }
    return true;
}

int run_diff(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count;
    lam_error error = {0};
    bool folders = path_is_folder(operands[0]) && path_is_folder(operands[1]);
    if (folders || (is_model(operands[0]) && is_model(operands[1])))
        return diff_models(operands, folders, options);
    if (path_is_folder(operands[0]) || path_is_folder(operands[1])) {
        const char *folder = operands[!path_is_folder(operands[0])], *other = operands[path_is_folder(operands[0])];
        if (access(other, F_OK) != 0 && lam_shape_find(other) < 0)
            complain(&error, LAM_CANNOT_READ, "%.200s: cannot open: %s; the other side, %.200s, is a folder", other,
                     strerror(errno), folder);
        else
            complain(&error, LAM_BAD_ARGUMENT,
                     "%.200s is a folder and %.200s is not; expected two folders, two models or "
                     "two pictures",
                     folder, other);
        return report_failure(&error, options);
    }
    return check_pictures(options, &error) ? diff_pictures(operands, options) : report_failure(&error, options);
}
