// glsl_combinations.c: enumerates the choices for the shader tests.
#include "glsl_combinations.h"

#include <string.h>

struct visitor {
    void (*visit)(void *user, const struct glsl_choices *choices);
    void *user;
    int count;
};

static void call(struct visitor *v, const struct glsl_choices *choices)
{
    v->visit(v->user, choices);
    v->count++;
}

static const struct method {
    lam_shading shading;
    lam_stage stage;
} methods[] = {
    {LAM_SHADING_PHONG, LAM_STAGE_FRAGMENT},   {LAM_SHADING_GOURAUD, LAM_STAGE_VERTEX},
    {LAM_SHADING_FLAT, LAM_STAGE_VERTEX},      {LAM_SHADING_FLAT, LAM_STAGE_FRAGMENT},
    {LAM_SHADING_FLAT, LAM_STAGE_APPLICATION}, {LAM_SHADING_GOURAUD, LAM_STAGE_APPLICATION},
};
enum { METHODS = sizeof methods / sizeof *methods };

static void every_light(struct glsl_choices *c)
{
    for (int kind = 0; kind < GLSL_KINDS; kind++)
        for (int falloff = 0; falloff < (kind == 1 ? 1 : GLSL_FALLOFFS); falloff++) {
            c->groups[c->group_count++] = (struct glsl_group){kind, falloff, 1 + falloff};
            c->light_count += 1 + falloff;
        }
    c->hemisphere_count = 2;
}

// Varies one independent choice at a time.
static void single_choices(struct visitor *v, const struct glsl_choices *base)
{
    for (int output = LAM_OUTPUT_PICTURE; output < LAM_OUTPUT_COUNT; output++) {
        struct glsl_choices c = *base;
        c.output = (lam_output)output;
        if (c.version == GLSL_120 && (output == LAM_OUTPUT_IDS || output == LAM_OUTPUT_LOD))
            continue;
        call(v, &c);
        c.reflection = LAM_REFLECTION_NONE;
        call(v, &c);
    }
    static const int some[] = {0, 1, 2, 4, 8, 16, 32, 63};
    for (int i = 0; i < 8; i++) {
        int bits = some[i];
        struct glsl_choices c = *base;
        c.distant_viewer = bits & 1;
        c.gl1 = bits & 2;
        c.colors = bits & 4;
        c.exposes = bits & 4;
        c.tangents = bits & 8;
        c.encoding = bits & 16 ? GLSL_PREMULTIPLIED : GLSL_STRAIGHT;
        if (bits & 32)
            c.environment = c.version == GLSL_120 ? GLSL_CUBE : GLSL_FACES;
        call(v, &c);
        c.environment = bits & 32 ? GLSL_CUBE : GLSL_NO_ENVIRONMENT;
        c.reflection = LAM_REFLECTION_KAJIYA_KAY;
        call(v, &c);
        c.reflection = LAM_REFLECTION_NONE;
        call(v, &c);
        memset(c.groups, 0, sizeof c.groups); // only ambient light and hemispheres
        c.group_count = c.light_count = 0;
        c.reflection = LAM_REFLECTION_BLINN_PHONG;
        call(v, &c);
        c.hemisphere_count = 0;
        call(v, &c);
    }
}

// Materials with every map, on both sides, with a few of the ways to read them.
static void maps(struct visitor *v, const struct glsl_choices *base)
{
    static const lam_reflection models[] = {LAM_REFLECTION_NONE, LAM_REFLECTION_LAMBERT, LAM_REFLECTION_PHONG,
                                            LAM_REFLECTION_GGX};
    for (int i = 0; i < 16; i++) {
        struct glsl_choices c = *base;
        c.reflection = models[i % 4];
        c.two_sided = i & 4;
        c.back_material = i & 8;
        c.tangents = true;
        c.colors = i & 4;
        c.converted[0] = i & 4 && c.reflection != LAM_REFLECTION_GGX;
        c.layers = c.reflection == LAM_REFLECTION_GGX ? (uint8_t)(i == 3 ? 0 : 37 * i + 2) : 0;
        c.field_layers = (uint8_t)(c.layers | (i & 8 ? 127 : 0));
        c.transmits = c.layer == GLSL_PEELS && i % 2;
        c.alpha[0] = (uint8_t)(i % 3);
        c.alpha[1] = (uint8_t)(i / 4 % 3);
        for (int side = 0; side <= c.back_material; side++)
            for (int map = 0; map < LAM_MAP_COUNT; map++)
                c.maps[side][map] =
                    (struct glsl_map){.used = map != LAM_MAP_DISPLACEMENT && map != LAM_MAP_REFLECTION &&
                                              (i < 12 || (map + i + side) % 3),
                                      .texels = (uint8_t)(i & 1 ? map / 2 : map),
                                      .texcoords = (uint8_t)((map + i) % 2),
                                      .wrap_s = (uint8_t)(map % 3),
                                      .wrap_t = (uint8_t)(i % 3),
                                      .magnify = (uint8_t)(map % 2),
                                      .minify = (uint8_t)(i % 2),
                                      .mip = (uint8_t)(map % 3),
                                      .channel = (uint8_t)(map % 4)};
        call(v, &c);
        c.output = LAM_OUTPUT_NORMALS;
        call(v, &c);
        for (int output = LAM_OUTPUT_BASE_COLOR; output < LAM_OUTPUT_LOD + (c.version != GLSL_120); output++) {
            c.output = (lam_output)output;
            call(v, &c);
        }
    }
}

int glsl_combinations(void (*visit)(void *user, const struct glsl_choices *choices), void *user)
{
    struct visitor v = {visit, user, 0};
    for (int version = GLSL_120; version <= GLSL_300_ES; version++)
        for (int storage = GLSL_ARRAY; storage <= (version == GLSL_120 ? GLSL_ARRAY : GLSL_TEXTURE); storage++)
            for (int method = 0; method < METHODS; method++)
                for (int products = 0; products < 2; products++) {
                    struct glsl_choices base;
                    memset(&base, 0, sizeof base);
                    base.version = (enum glsl_version)version;
                    base.storage = (enum glsl_storage)storage;
                    base.shading = methods[method].shading;
                    base.stage = methods[method].stage;
                    base.products = products;
                    every_light(&base);
                    for (int model = LAM_REFLECTION_NONE; model < LAM_REFLECTION_COUNT; model++)
                        for (int sides = 0; sides < 3; sides++) {
                            struct glsl_choices c = base;
                            c.reflection = (lam_reflection)model;
                            c.two_sided = sides > 0;
                            c.back_material = sides > 1;
                            call(&v, &c);
                        }
                    base.reflection = LAM_REFLECTION_BLINN_PHONG;
                    base.two_sided = base.back_material = true;
                    single_choices(&v, &base);
                    maps(&v, &base);
                }
    return v.count;
}
