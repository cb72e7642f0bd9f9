// glb_tree.c: builds the JSON of a glTF file, and its buffer.
#include "glb.h"

#include <string.h>

enum { VALUE = 64 }; // approximate bytes of memory for a JSON value

static bool charge(struct glb *glb) { return !glb->e->call || call_charge(glb->e->call, VALUE); }

void glb_set(struct glb *glb, json_t *object, const char *key, json_t *value)
{
    glb->failed |= json_object_set_new(object, key, value) != 0 || !charge(glb);
}

int glb_add(struct glb *glb, json_t *list, json_t *value)
{
    glb->failed |= json_array_append_new(list, value) != 0 || !charge(glb);
    return (int)json_array_size(list) - 1;
}

void glb_set_name(struct glb *glb, json_t *object, const char *name)
{
    json_t *text = name ? json_string(name) : NULL;
    if (text)
        glb_set(glb, object, "name", text);
}

json_t *glb_floats(struct glb *glb, const float *numbers, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        glb_add(glb, list, json_real((double)numbers[i]));
    return list;
}

json_t *glb_extension(struct glb *glb, json_t *object, const char *name)
{
    bool used = false;
    for (size_t i = 0; i < json_array_size(glb->used); i++)
        used |= strcmp(json_string_value(json_array_get(glb->used, i)), name) == 0;
    if (!used)
        glb_add(glb, glb->used, json_string(name));
    json_t *list = json_object_get(object, "extensions");
    if (!list) {
        list = json_object();
        glb_set(glb, object, "extensions", list);
    }
    json_t *own = json_object_get(list, name);
    if (!own) {
        own = json_object();
        glb_set(glb, list, name, own);
    }
    return own;
}

int glb_add_view(struct glb *glb, const void *bytes, size_t size, int target)
{
    while (glb->bytes.length % 4 && !glb->bytes.failed)
        text_add_part(&glb->bytes, "\0", 1);
    json_t *view = json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)glb->bytes.length, "byteLength",
                             (json_int_t)size);
    if (target)
        glb_set(glb, view, "target", json_integer(target));
    text_add_part(&glb->bytes, bytes, size);
    return glb_add(glb, glb->views, view);
}

bool glb_error(struct glb *glb)
{
    return export_is_whole(glb->e) && export_text_is_whole(glb->e, &glb->bytes) &&
           export_no_memory(glb->e, glb->bytes.length);
}

bool glb_append(struct glb *glb, struct scene_list *list, const void *item, size_t size)
{
    return scene_list_append(list, item, size, glb->e->arena) ||
           export_no_memory(glb->e, 2 * (size_t)list->capacity * size);
}
