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
        json_none(json, "map");
        return;
    }
    json_open(json, "map", '{');
    json_text(json, "texture", lam_texture_name(map->texture));
    json_count(json, "width", (uint64_t)lam_texture_width(map->texture, 0));
    json_count(json, "height", (uint64_t)lam_texture_height(map->texture, 0));
    json_text(json, "values", lam_texture_values_of(map->texture) == LAM_TEXTURE_COLOR ? "color" : "numbers");
    json_count(json, "texcoords", (uint64_t)map->texcoords);
    json_text(json, "wrap_s", wraps[map->wrap_s]);
    json_text(json, "wrap_t", wraps[map->wrap_t]);
    json_text(json, "magnify", filters[map->magnify]);
    json_text(json, "minify", filters[map->minify]);
    json_text(json, "mip", mips[map->mip]);
    json_close(json, '}');
}

static void uniforms(struct json *json, const char *key, const lam_shader_uniform *list, int count)
{
    json_open(json, key, '[');
    for (int i = 0; i < count; i++) {
        const lam_shader_uniform *u = &list[i];
        json_open(json, NULL, '{');
        json_text(json, "name", u->name);
        json_text(json, "type", u->type);
        json_text(json, "block", u->block);
        if (u->block)
            json_count(json, "offset", (uint64_t)u->offset);
        else
            json_none(json, "offset");
        json_text(json, "meaning", u->meaning);
        if (u->count)
            numbers(json, "value", u->value, u->count);
        else
            json_none(json, "value");
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
        json_count(json, "object", (uint64_t)d->object);
        json_text(json, "object_name", d->object_name);
        json_count(json, "first_triangle", d->first_triangle);
        json_count(json, "triangle_count", d->triangle_count);
        json_text(json, "material", d->material_name);
        json_text(json, "front", d->clockwise ? "clockwise" : "counter-clockwise");
        json_text(json, "cull", culls[d->cull]);
        json_flag(json, "translucent", d->translucent);
        json_flag(json, "has_colors", d->has_colors);
        json_flag(json, "has_tangents", d->has_tangents);
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
    json_text(&json, "model", model);
    json_text(&json, "glsl", lam_glsl_name(s->glsl));
    json_text(&json, "lights_in", lights[s->lights]);
    json_flag(&json, "products", s->products);
    json_flag(&json, "flat", s->flat);
    json_text(&json, "vertex", s->vertex);
    json_text(&json, "fragment", s->fragment);
    json_text(&json, "application", s->application);
    json_open(&json, "attributes", '[');
    for (int i = 0; i < s->attribute_count; i++) {
        const lam_shader_attribute *a = &s->attributes[i];
        json_open(&json, NULL, '{');
        json_text(&json, "name", a->name);
        json_text(&json, "type", a->type);
        json_count(&json, "location", (uint64_t)a->location);
        json_text(&json, "meaning", a->meaning);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    uniforms(&json, "uniforms", s->uniforms, s->uniform_count);
    draws(&json, s);
    json_open(&json, "lists", '[');
    for (int i = 0; i < s->texture_count; i++) {
        json_open(&json, NULL, '{');
        json_text(&json, "name", s->textures[i].name);
        json_count(&json, "texels", (uint64_t)s->textures[i].texels);
        numbers(&json, "values", s->textures[i].values, 4 * s->textures[i].texels);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', file);
}
