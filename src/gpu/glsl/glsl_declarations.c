// glsl_declarations.c: the table of a shader's uniforms and attributes, and their declarations.
#include "glsl_declarations.h"

#include <stdio.h>
#include <string.h>

struct list {
    struct glsl_row *rows;
    int count;
};

__attribute__((format(printf, 7, 8))) static void add(struct list *list, enum glsl_semantic semantic, const char *type,
                                                      int count, const char *block, const char *meaning,
                                                      const char *name, ...);
static void add(struct list *list, enum glsl_semantic semantic, const char *type, int count, const char *block,
                const char *meaning, const char *name, ...)
{
    struct glsl_row *row = &list->rows[list->count++];
    *row = (struct glsl_row){.semantic = semantic, .type = type, .count = count, .block = block, .meaning = meaning};
    __builtin_va_list arguments;
    __builtin_va_start(arguments, name);
    vsnprintf(row->name, sizeof row->name, name, arguments);
    __builtin_va_end(arguments);
}

static void add_member(struct list *list, enum glsl_semantic semantic, const char *type, int at, const char *name,
                       const char *meaning)
{
    add(list, semantic, type, 0, NULL, meaning, "%s", name);
    list->rows[list->count - 1].at = at;
}

// Returns whether the equations use a field of the material.
static bool is_read(const struct glsl_stage *f, const struct material_field *row)
{
    switch (row->reader) {
    case FIELD_LIT:
        return !f->unlit;
    case FIELD_ENVIRONMENT:
        return f->has_environment;
    case FIELD_HIGHLIGHT:
        return f->highlights && !f->microfacet;
    case FIELD_LAYER:
        return f->layers & row->layer;
    case FIELD_LOBE:
        return glsl_lobe_reads(f, row->field.name);
    default:
        return true;
    }
}

// Adds the fields of the material: members of its struct or, with products, separate rows. A block has all fields.
static void add_fields(struct list *list, const struct glsl_stage *f, const char *block, const char *prefix)
{
    bool products = f->choices->products;
    struct glsl_material_layout layout = glsl_material_layout(products, f->choices->field_layers);
    for (int i = 0; i < layout.count; i++) {
        const struct material_field *row = layout.fields[i];
        if (f->choices->storage != GLSL_BLOCK && !is_read(f, row))
            continue;
        add(list, products ? GLSL_HEAD : GLSL_MATERIAL, row->field.type < LAM_FIELD_RGB ? "float" : "vec4", 0, block,
            products && row->product_summary ? row->product_summary : row->field.summary, "%s%s", prefix,
            glsl_field_name(row, products));
        list->rows[list->count - 1].at = layout.at[i];
    }
}

static void add_products(struct list *list, const struct glsl_stage *f, bool back)
{
    const struct glsl_choices *c = f->choices;
    const char *p = back ? "back_" : "",
               *block = c->storage == GLSL_BLOCK ? (back ? "BackProducts" : "Products") : NULL;
    bool all = block != NULL, lists = c->storage != GLSL_TEXTURE;
    int first = list->count, lights = f->has_lights && lists ? c->light_count : 0,
        hemispheres = f->has_hemispheres && lists ? c->hemisphere_count : 0;
    add_fields(list, f, block, p);
    if (lights) {
        add(list, GLSL_DIFFUSE_PRODUCT, "vec4", lights, block, "kd Ld of each light", "%sdiffuse_product", p);
        if (all || f->highlights)
            add(list, GLSL_SPECULAR_PRODUCT, "vec4", lights, block, "ks Ls of each light", "%sspecular_product", p);
        if (c->gl1)
            add(list, GLSL_LIGHT_AMBIENT_PRODUCT, "vec4", lights, block, "ka La of each light, before attenuation",
                "%slight_ambient_product", p);
    }
    if (hemispheres) {
        add(list, GLSL_SKY_PRODUCT, "vec4", hemispheres, block, "ka times the light from above, of each hemisphere",
            "%ssky_product", p);
        add(list, GLSL_GROUND_PRODUCT, "vec4", hemispheres, block, "ka times the light from below, of each hemisphere",
            "%sground_product", p);
    }
    if (!lists && (f->has_lights || f->has_hemispheres))
        add(list, GLSL_FIRST_PRODUCT, "int", 0, NULL, "index of the material's first texel in product_list",
            "%sfirst_product", p);
    for (int i = first; i < list->count; i++)
        list->rows[i].back = back;
}

static void add_map_row(struct list *list, enum glsl_semantic semantic, const char *type, lam_map map, int side,
                        const char *ending, const char *meaning)
{
    add(list, semantic, type, 0, NULL, meaning, "%s%s_map%s", side ? "back_" : "", lam_map_name(map), ending);
    list->rows[list->count - 1].map = map;
    list->rows[list->count - 1].back = side;
}

static void add_maps(struct list *list, const struct glsl_stage *f)
{
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            if (!f->maps[side][i])
                continue;
            if (glsl_map_owner(f, side, (lam_map)i) == (lam_map)i)
                add_map_row(list, GLSL_MAP, "sampler2D", (lam_map)i, side, "",
                            "linear RGBA, all levels of detail, first row at the top");
            add_map_row(list, GLSL_MAP_S, "vec4", (lam_map)i, side, "_s",
                        "first row of the matrix to the picture's coordinates; factor of the texel");
            add_map_row(list, GLSL_MAP_T, "vec4", (lam_map)i, side, "_t",
                        "second row of the matrix to the picture's coordinates; added to the texel");
        }
}

static void add_environment(struct list *list, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    if (f->has_environment) {
        add(list, GLSL_ENVIRONMENT_MATRIX, "mat3", 0, NULL, "directions in eye space to the environment's axes",
            "environment_matrix");
        if (c->environment == GLSL_CUBE) {
            add(list, GLSL_ENVIRONMENT, "samplerCube", 0, NULL, "linear light; bilinear filter, seamless, no mipmaps",
                "environment");
        } else {
            add(list, GLSL_ENVIRONMENT, "sampler2DArray", 0, NULL,
                "linear light; six faces +x -x +y -y +z -z, each with a border of one texel", "environment_faces");
        }
        if (f->environment_light)
            add(list, GLSL_ENVIRONMENT_LIGHT, "sampler2D", 0, NULL,
                "float texture, 1024 texels wide, no filter: lam_environment_light_image", "environment_light");
    }
    if (f->occluded)
        add(list, GLSL_OCCLUSION, "sampler2D", 0, NULL,
            "a texel for each pixel: the unoccluded share of surrounding light", "ambient_occlusion");
}

// For an output that shows one light, adds the uniform of this light.
static void add_one_light(struct list *list, const struct glsl_stage *f)
{
    bool texture = f->choices->storage == GLSL_TEXTURE;
    if (!f->has_lights)
        return;
    add(list, texture ? GLSL_LIGHT_LIST : GLSL_LIGHTS, texture ? "sampler2D" : "Light",
        texture ? 0 : f->choices->light_count, f->choices->storage == GLSL_BLOCK ? "Lights" : NULL, "the light",
        texture ? "light_list" : "lights");
}

static void add_lights(struct list *list, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    const char *block = c->storage == GLSL_BLOCK ? "Lights" : NULL;
    if (!c->products && !f->unlit)
        add(list, GLSL_AMBIENT_LIGHT, "vec4", 0, block, "La: global ambient light plus the ambient light of all lights",
            "ambient_light");
    if (c->storage == GLSL_TEXTURE) {
        if (f->has_lights || f->has_hemispheres) {
            add(list, GLSL_LIGHT_LIST, "sampler2D", 0, NULL,
                "float texture, 1024 texels wide, no filter: the lights, then the hemispheres "
                "(docs/shaders.md)",
                "light_list");
            if (c->products)
                add(list, GLSL_PRODUCT_LIST, "sampler2D", 0, NULL,
                    "float texture, 1024 texels wide, no filter: the products of the materials and the "
                    "lights",
                    "product_list");
        }
    } else {
        if (f->has_lights)
            add(list, GLSL_LIGHTS, "Light", c->light_count, block, "the lights, grouped by kind", "lights");
        if (f->has_hemispheres)
            add(list, GLSL_HEMISPHERES, "Hemisphere", c->hemisphere_count, block, "hemisphere lights", "hemispheres");
    }
    if (c->passed && f->has_lights && c->storage != GLSL_TEXTURE)
        add(list, GLSL_PASSED, "float", c->light_count, NULL, "the unblocked share of each light, 0...1", "passed");
}

int glsl_declarations(const struct glsl_stage *f, struct glsl_row rows[GLSL_ROWS_MAX])
{
    const struct glsl_choices *c = f->choices;
    struct list list = {.rows = rows};
    add(&list, GLSL_MODEL_VIEW_PROJECTION, "mat4", 0, NULL, "mesh positions to clip space", "model_view_projection");
    if (f->needs_position)
        add(&list, GLSL_MODEL_VIEW, "mat4", 0, NULL, "mesh positions to eye space", "model_view");
    if (f->needs_normal)
        add(&list, GLSL_NORMAL_MATRIX, "mat3", 0, NULL,
            "normals to eye space: the inverse transpose of model_view's 3x3, times any positive number",
            "normal_matrix");
    if (c->exposes && !f->output_geometry && !f->output_vector)
        add(&list, GLSL_EXPOSURE, "float", 0, NULL, "factor of all light: 2 to the power of the stops", "exposure");
    for (int back = 0; back <= f->back_material && f->has_mask; back++)
        if (c->alpha[back] == LAM_ALPHA_MASK) {
            add(&list, GLSL_ALPHA_CUTOFF, "float", 0, NULL, "points with less opacity are discarded", "%salpha_cutoff",
                back ? "back_" : "");
            list.rows[list.count - 1].back = back;
        }
    add_maps(&list, f);
    bool has_emission_map =
        f->maps_interpolated_light && (f->maps[0][LAM_MAP_EMISSION] || f->maps[1][LAM_MAP_EMISSION]);
    for (int back = 0; back <= f->back_material && has_emission_map; back++) {
        add(&list, GLSL_MAPPED_EMISSION, "vec4", 0, NULL, "emission, which the emission map multiplies", "%sglow",
            back ? "back_" : "");
        list.rows[list.count - 1].back = back;
    }
    if (c->output == LAM_OUTPUT_IDS)
        add(&list, GLSL_OBJECT, "float", 0, NULL, "index of the object", "object");
    add_environment(&list, f);
    if (!f->lit || f->output_vector) {
        add_one_light(&list, f);
        return list.count;
    }
    add_lights(&list, f);
    for (int back = 0; back <= f->back_material; back++) {
        if (c->products) {
            add_products(&list, f, back);
            continue;
        }
        add(&list, GLSL_MATERIAL, "Material", 0, c->storage == GLSL_BLOCK ? "Materials" : NULL,
            back ? "material of the back" : "material of the front", "%smaterial", back ? "back_" : "");
        list.rows[list.count - 1].back = back;
    }
    return list.count;
}

int glsl_attributes(const struct glsl_stage *f, struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX])
{
    const struct glsl_choices *c = f->choices;
    bool flat = f->shading == LAM_SHADING_FLAT, glsl_120 = c->version == GLSL_120, shaded = f->lit && !f->unlit;
    int count = 0;
    rows[count++] = (struct glsl_attribute){0, "vec3", "position", "mesh position"};
    if (shaded)
        rows[count++] = (struct glsl_attribute){1, "vec3", "normal",
                                                flat ? "mesh normal of the triangle, equal at its three vertices"
                                                     : "mesh normal, of any length"};
    if (c->colors && ((f->lit && !f->output_vector) || f->value_masks))
        rows[count++] = (struct glsl_attribute){
            2, "vec4", "color",
            flat && glsl_120 ? "linear, not premultiplied; the last vertex's value at all three vertices"
                             : "linear, not premultiplied"};
    if (f->signed_tangent)
        rows[count++] = (struct glsl_attribute){3, "vec4", "tangent",
                                                "mesh tangent, unit, and the sign of the bitangent (MikkTSpace)"};
    else if (f->needs_tangent && c->tangents)
        rows[count++] =
            (struct glsl_attribute){3, "vec3", "tangent",
                                    flat && glsl_120 ? "mesh tangent; the last vertex's value at all three vertices"
                                                     : "mesh tangent, along the surface"};
    if (f->application) {
        rows[count++] = (struct glsl_attribute){4, "vec4", "front_color",
                                                "light that leaves the front at the vertex, and the opacity"};
        if (c->two_sided)
            rows[count++] = (struct glsl_attribute){5, "vec4", "back_color",
                                                    "light that leaves the back at the vertex, and the opacity"};
    }
    if (f->application && f->separate_texture_terms) {
        static const char meaning[] = "the part of that light which the diffuse map does not multiply";
        rows[count++] = (struct glsl_attribute){9, "vec3", "front_plain", meaning};
        if (c->two_sided)
            rows[count++] = (struct glsl_attribute){10, "vec3", "back_plain", meaning};
    }
    if (flat && glsl_120 && shaded)
        rows[count++] = (struct glsl_attribute){6, "vec3", "provoking_position",
                                                "position of the triangle's last vertex, where a flat triangle is lit"};
    if (f->first_texcoords)
        rows[count++] = (struct glsl_attribute){7, "vec2", "texcoord", "texture coordinates"};
    if (f->second_texcoords)
        rows[count++] = (struct glsl_attribute){8, "vec2", "second_texcoord", "second set of texture coordinates"};
    return count;
}

void glsl_declare_attributes(struct text *text, const struct glsl_stage *f)
{
    struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX];
    int count = glsl_attributes(f, rows), width = 0;
    for (int i = 0; i < count; i++)
        width = (int)strlen(rows[i].name) > width ? (int)strlen(rows[i].name) : width;
    for (int i = 0; i < count; i++) {
        char start[40];
        snprintf(start, sizeof start, "layout(location = %d) in ", rows[i].location);
        text_print(text, "%s%s %s;%*s // %s\n", f->choices->version == GLSL_120 ? "attribute " : start, rows[i].type,
                   rows[i].name, width - (int)strlen(rows[i].name), "", rows[i].meaning);
    }
}

// Returns whether the vertex shader (`fragment` false) or the fragment shader uses a uniform.
static bool glsl_row_is_in(const struct glsl_stage *f, const struct glsl_row *row, bool fragment)
{
    switch (row->semantic) {
    case GLSL_MODEL_VIEW_PROJECTION:
    case GLSL_NORMAL_MATRIX:
        return !fragment;
    case GLSL_EXPOSURE:
    case GLSL_MAP:
    case GLSL_MAP_S:
    case GLSL_MAP_T:
    case GLSL_ALPHA_CUTOFF:
    case GLSL_MAPPED_EMISSION:
        return fragment;
    case GLSL_MODEL_VIEW: // field_tangent reads the columns of the matrix
        return !fragment ||
               (f->per_fragment && ((f->needs_tangent && !f->choices->tangents) || f->layers & LAYER_VOLUME));
    default:
        return fragment == f->per_fragment;
    }
}

int glsl_members(const struct glsl_stage *f, const char *type, struct glsl_row rows[GLSL_ROWS_MAX])
{
    const struct glsl_choices *c = f->choices;
    struct list list = {.rows = rows};
    bool all = c->storage == GLSL_BLOCK; // a block has all members, used or not
    if (strcmp(type, "Light") == 0) {
        bool both = all || f->output_vector;
        if (both || f->positions)
            add_member(&list, GLSL_LIGHTS, "vec4", 0, "position",
                       "in eye space, w 1; not read for a directional light");
        if (both || f->directions)
            add_member(&list, GLSL_LIGHTS, "vec4", 4, "direction",
                       "in eye space, unit, w 0: direction of travel of a directional light, axis of a spot");
        if (all || f->has_falloff)
            add_member(&list, GLSL_LIGHTS, "vec4", 8, "attenuation",
                       "constant, linear, quadratic, 1 / range (0: no range)");
        if (all || f->has_cone)
            add_member(&list, GLSL_LIGHTS, "vec4", 12, "cone",
                       "cos cutoff, exponent, cos outer, 1 / max(0.001, cos inner - cos outer); "
                       "read according to the kind of spot");
        if (c->products || f->output_vector)
            return list.count;
        add_member(&list, GLSL_LIGHTS, "vec4", 16, "diffuse", "Ld");
        if (all || f->highlights)
            add_member(&list, GLSL_LIGHTS, "vec4", 20, "specular", "Ls");
        if (c->gl1)
            add_member(&list, GLSL_LIGHTS, "vec4", 24, "ambient", "La, before attenuation");
    } else if (strcmp(type, "Hemisphere") == 0) {
        add_member(&list, GLSL_HEMISPHERES, "vec4", 0, "up", "in eye space, unit, w 0: towards the sky");
        if (c->products)
            return list.count;
        add_member(&list, GLSL_HEMISPHERES, "vec4", 4, "sky", "light from above");
        add_member(&list, GLSL_HEMISPHERES, "vec4", 8, "ground", "light from below");
    } else if (strcmp(type, "Material") == 0) {
        add_fields(&list, f, NULL, "");
    }
    return list.count;
}

static int width_of(const struct glsl_row *row)
{
    return (int)strlen(row->type) + (int)strlen(row->name) + (row->count ? snprintf(NULL, 0, "[%d]", row->count) : 0);
}

// Appends a declaration; the comments of consecutive rows are aligned.
static void declare(struct text *text, const char *start, const struct glsl_row *row, int width)
{
    char name[48];
    snprintf(name, sizeof name, row->count ? "%s[%d];" : "%s;", row->name, row->count);
    text_print(text, "%s%s %s%*s // %s\n", start, row->type, name, width - width_of(row), "", row->meaning);
}

static void declare_struct(struct text *text, const struct glsl_stage *stage, const char *type)
{
    struct glsl_row members[GLSL_ROWS_MAX];
    int count = glsl_members(stage, type, members);
    if (!count)
        return;
    text_print(text, "struct %s {\n", type);
    int width = 0;
    for (int i = 0; i < count; i++)
        width = width_of(&members[i]) > width ? width_of(&members[i]) : width;
    for (int i = 0; i < count; i++)
        declare(text, "    ", &members[i], width);
    text_add(text, "};\n");
}

void glsl_declare(struct text *text, const struct glsl_stage *stage, bool fragment)
{
    struct glsl_row rows[GLSL_ROWS_MAX];
    int count = glsl_declarations(stage, rows);
    const char *block = NULL;
    int width = 0;
    for (int i = 0; i < count; i++)
        if (glsl_row_is_in(stage, &rows[i], fragment))
            width = width_of(&rows[i]) > width ? width_of(&rows[i]) : width;
    if (!width)
        return;
    text_add(text, "\n// --- uniforms, set by the application\n\n");
    for (int i = 0; i < count; i++) { // structs are declared before the uniforms of their type
        bool skip = !glsl_row_is_in(stage, &rows[i], fragment);
        for (int k = 0; k < i; k++)
            skip |= strcmp(rows[k].type, rows[i].type) == 0;
        if (!skip)
            declare_struct(text, stage, rows[i].type);
    }
    for (int i = 0; i < count; i++) {
        if (!glsl_row_is_in(stage, &rows[i], fragment))
            continue;
        bool opens = rows[i].block && (!block || strcmp(block, rows[i].block) != 0);
        if (block && (opens || !rows[i].block))
            text_add(text, "};\n");
        if (opens)
            text_print(text, "layout(std140) uniform %s {\n", rows[i].block);
        block = rows[i].block;
        declare(text, block ? "    " : "uniform ", &rows[i], width);
    }
    if (block)
        text_add(text, "};\n");
}
