// cameras_file.c: reads files of cameras (docs/cameras.md). Each row becomes a text for lam_camera_parse, so that files and
// --camera have the same rules.
#include "batch_shard.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"

// Makes "key=value,key=value" of each row. The first row of CSV names the keys; empty cells are omitted.
static json_t *read_csv(FILE *file)
{
    char *line = NULL, *names = NULL;
    size_t room = 0;
    json_t *rows = json_array();
    while (getline(&line, &room, file) > 0) {
        char words[2048] = "", *cells = line, *keys = names, *cell;
        line[strcspn(line, "\r\n")] = 0;
        if (!names) {
            names = strdup(line);
            continue;
        }
        while ((cell = strsep(&cells, ","))) { // strsep ends the key, which is restored
            char *key = strsep(&keys, ",");
            size_t used = strlen(words);
            if (*cell)
                snprintf(words + used, sizeof words - used, "%s%s=%s", used ? "," : "", key ? key : "", cell);
            if (keys)
                keys[-1] = ',';
        }
        if (*words)
            json_array_append_new(rows, json_string(words));
    }
    free(line);
    free(names);
    return rows;
}

// Makes a camera of a frame of transforms.json. The object at the top completes a frame.
static json_t *frame_camera(const json_t *root, const json_t *frame)
{
    static const char *const keys[][2] = {{"transform_matrix", "pose"},
                                          {"fl_x", "fx"},
                                          {"fl_y", "fy"},
                                          {"cx", "cx"},
                                          {"cy", "cy"},
                                          {"w", "width"},
                                          {"h", "height"},
                                          {"ortho_half_height", "ortho"},
                                          {"k1", "k1"},
                                          {"k2", "k2"},
                                          {"k3", "k3"},
                                          {"k4", "k4"},
                                          {"p1", "p1"},
                                          {"p2", "p2"},
                                          {"camera_angle_x", NULL}};
    json_t *camera = json_pack("{s:s}", "convention", "opengl"), *value = NULL;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        json_t *own = json_object_get(frame, keys[i][0]);
        value = own ? own : json_object_get(root, keys[i][0]);
        if (value && keys[i][1])
            json_object_set(camera, keys[i][1], value);
    }
    if (!value || json_object_get(camera, "fx") || json_object_get(camera, "ortho"))
        return camera;
    // It is the horizontal angle. Without a size, the pictures are square.
    const double width = json_number_value(json_object_get(camera, "width")),
                 height = json_number_value(json_object_get(camera, "height"));
    if (width > 65535 || height > 65535) // lam_camera_parse names the number
        return camera;
    const double w = width >= 1 ? width : 1000, h = height >= 1 ? height : w;
    double lens[4];
    lam_camera_intrinsics(&(lam_camera){.fovy_rad = json_number_value(value)}, (int)w, (int)w, LAM_CONVENTION_OPENGL,
                          lens);
    json_t *lenses = json_pack("{s:f,s:f,s:f,s:f,s:i,s:i}", "fx", lens[0], "fy", lens[1], "cx", w / 2, "cy", h / 2,
                               "width", (int)w, "height", (int)h);
    json_object_update(camera, lenses);
    json_decref(lenses);
    return camera;
}

json_t *cameras_file_read(const char *path, lam_error *error)
{
    const char *dot = strrchr(path, '.');
    const bool csv = dot && strcmp(dot, ".csv") == 0;
    json_error_t reason;
    FILE *file = fopen(path, "rb");
    if (!file)
        return complain(error, LAM_CANNOT_READ, "%s: cannot open: %s", path, strerror(errno)), NULL;
    json_t *root = csv ? read_csv(file) : json_loadf(file, JSON_REJECT_DUPLICATES, &reason), *row;
    fclose(file);
    if (!root)
        return complain(error, LAM_CANNOT_READ, "%s:%d: %.100s; expected JSON, or CSV in a file named .csv", path,
                        reason.line, reason.text),
               NULL;
    json_t *frames = json_object_get(root, "frames"), *list = frames ? frames : json_object_get(root, "cameras"),
           *texts = json_array();
    size_t i;
    json_array_foreach(list ? list : root, i, row)
    {
        json_t *camera = frames ? frame_camera(root, row) : json_incref(row);
        char *text = csv ? NULL : json_dumps(camera, JSON_COMPACT | JSON_REAL_PRECISION(17) | JSON_ENCODE_ANY);
        json_array_append_new(texts, csv ? json_incref(row) : json_string(text ? text : ""));
        free(text);
        json_decref(camera);
    }
    json_decref(root);
    if (json_array_size(texts))
        return texts;
    json_decref(texts);
    return complain(error, LAM_CANNOT_READ, "%s: found no cameras, expected a list, 'cameras' or 'frames'", path), NULL;
}
