// shader_json.c: prints a scene's shaders and their inputs as one line of JSON (docs/shader.schema.json).
#include "shader.h"

#include "json.h"

static void numbers(struct json *json, const char *key, const float *values, int count)
{
    json_open(json, key, '[');
    for (int i = 0; i < count; i++)
        json_number(json, NULL, (double)values[i]);
    json_close(json, ']');
}

// Writes the material's map that a sampler reads, or null.
static void map_of(struct json *json, const lam_texture_map *map)
{
    static const char *const wraps[] = {"repeat", "clamp", "mirror"}, *const filters[] = {"linear", "nearest"};
    static const char *const mips[] = {"linear", "nearest", "none"};
    if (!map) {
        json_put(json, NONE("map"));
        return;
    }
    json_put(json,
             OBJECT("map", TEXT("texture", lam_texture_name(map->texture)),
                    COUNT("width", lam_texture_width(map->texture, 0)),
                    COUNT("height", lam_texture_height(map->texture, 0)),
                    TEXT("values", lam_texture_values_of(map->texture) == LAM_TEXTURE_COLOR ? "color" : "numbers"),
                    COUNT("texcoords", map->texcoords), TEXT("wrap_s", wraps[map->wrap_s]),
                    TEXT("wrap_t", wraps[map->wrap_t]), TEXT("magnify", filters[map->magnify]),
                    TEXT("minify", filters[map->minify]), TEXT("mip", mips[map->mip])));
}

static void uniforms(struct json *json, const char *key, const lam_shader_uniform *list, int count)
{
    json_open(json, key, '[');
    for (int i = 0; i < count; i++) {
        const lam_shader_uniform *u = &list[i];
        json_open(json, NULL, '{');
        json_put(json, TEXT("name", u->name), TEXT("type", u->type), TEXT("block", u->block));
        if (u->block)
            json_put(json, COUNT("offset", u->offset));
        else
            json_put(json, NONE("offset"));
        json_text(json, "meaning", u->meaning);
        if (u->count)
            numbers(json, "value", u->value, u->count);
        else
            json_put(json, NONE("value"));
        map_of(json, u->map);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void draws(struct json *json, const lam_shader *s)
{
    static const char *const culls[] = {"none", "back", "front"};
    json_open(json, "draws", '[');
    for (int i = 0; i < s->draw_count; i++) {
        const lam_shader_draw *d = &s->draws[i];
        json_open(json, NULL, '{');
        json_put(json, COUNT("object", d->object), TEXT("object_name", d->object_name),
                 COUNT("first_triangle", d->first_triangle), COUNT("triangle_count", d->triangle_count),
                 TEXT("material", d->material_name), TEXT("front", d->clockwise ? "clockwise" : "counter-clockwise"),
                 TEXT("cull", culls[d->cull]), FLAG("translucent", d->translucent), FLAG("has_colors", d->has_colors),
                 FLAG("has_tangents", d->has_tangents));
        json_numbers(json, "origin", d->origin, 3);
        uniforms(json, "uniforms", d->uniforms, d->uniform_count);
        json_close(json, '}');
    }
    json_close(json, ']');
}

void shader_json(FILE *file, const lam_shader *s, const char *model)
{
    static const char *const lights[] = {"auto", "array", "block", "texture"};
    struct json json = {.file = file};
    json_open(&json, NULL, '{');
    json_put(&json, TEXT("model", model), TEXT("glsl", lam_glsl_name(s->glsl)), TEXT("lights_in", lights[s->lights]),
             FLAG("products", s->products), FLAG("flat", s->flat), TEXT("vertex", s->vertex),
             TEXT("fragment", s->fragment), TEXT("application", s->application));
    json_open(&json, "attributes", '[');
    for (int i = 0; i < s->attribute_count; i++) {
        const lam_shader_attribute *a = &s->attributes[i];
        json_put(&json, OBJECT(NULL, TEXT("name", a->name), TEXT("type", a->type), COUNT("location", a->location),
                               TEXT("meaning", a->meaning)));
    }
    json_close(&json, ']');
    uniforms(&json, "uniforms", s->uniforms, s->uniform_count);
    draws(&json, s);
    json_open(&json, "lists", '[');
    for (int i = 0; i < s->texture_count; i++) {
        json_open(&json, NULL, '{');
        json_put(&json, TEXT("name", s->textures[i].name), COUNT("texels", s->textures[i].texels));
        numbers(&json, "values", s->textures[i].values, 4 * s->textures[i].texels);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', file);
}
