// glsl_rows.c: the table of a text's uniforms, and their declarations.
#include "glsl_rows.h"

#include <stdio.h>
#include <string.h>

static bool is_place(lam_output show)
{
    return show == LAM_OUTPUT_DEPTH || show == LAM_OUTPUT_FACING || show == LAM_OUTPUT_IDS ||
           show == LAM_OUTPUT_COVERAGE || show == LAM_OUTPUT_OVERDRAW;
}

struct glsl_facts glsl_facts_of(const struct glsl_choices *c)
{
    struct glsl_facts f = {.choices = c};
    f.shows_place = is_place(c->show);
    f.shows_one_light = c->show == LAM_OUTPUT_N_L || c->show == LAM_OUTPUT_N_H;
    f.shows_vector = f.shows_one_light || c->show == LAM_OUTPUT_NORMALS || c->show == LAM_OUTPUT_TANGENTS;
    f.shading = f.shows_place ? LAM_SHADING_PHONG : c->shading;
    f.application = c->stage == LAM_STAGE_APPLICATION && !f.shows_place;
    f.per_vertex = c->stage == LAM_STAGE_VERTEX && !f.shows_place;
    f.per_fragment = !f.application && !f.per_vertex;
    f.lit = !f.application && !f.shows_place;
    f.paints = f.lit && c->reflection == LAM_REFLECTION_NONE && !f.shows_vector;
    bool sums = f.lit && !f.paints && !f.shows_vector;
    f.lights = c->light_count > 0 && (sums || f.shows_one_light);
    f.skies = c->hemisphere_count > 0 && sums;
    f.environment = c->environment != GLSL_NO_ENVIRONMENT && sums;
    const lam_reflection_info *lobe = lam_reflection_describe(c->reflection);
    f.sums = sums;
    f.threads = (sums && lobe->tangents) || (f.lit && c->show == LAM_OUTPUT_TANGENTS);
    f.highlights = sums && c->light_count > 0 && lobe->base;
    f.back = c->two_sided && c->back_material && f.lit && !f.shows_vector;
    for (int i = 0; i < c->group_count; i++) {
        f.falloff |= f.lights && !f.shows_vector && c->groups[i].falloff != FALLOFF_NONE;
        f.cones |= f.lights && !f.shows_vector && c->groups[i].kind >= LIGHT_SPOT_CUTOFF;
        f.positions |= c->groups[i].kind != LIGHT_DIRECTIONAL;
        f.directions |= c->groups[i].kind != LIGHT_POINT;
    }
    return f;
}

struct list {
    struct glsl_row *rows;
    int count;
};

__attribute__((format(printf, 6, 7))) static void add(struct list *list, enum glsl_what what, const char *type,
                                                      int count, const char *block, const char *name, ...);
static void add(struct list *list, enum glsl_what what, const char *type, int count, const char *block,
                const char *name, ...)
{
    struct glsl_row *row = &list->rows[list->count++];
    *row = (struct glsl_row){.what = what, .type = type, .count = count, .block = block};
    __builtin_va_list arguments;
    __builtin_va_start(arguments, name);
    vsnprintf(row->name, sizeof row->name, name, arguments);
    __builtin_va_end(arguments);
}

static void add_member(struct list *list, enum glsl_what what, const char *type, int at, const char *name,
                       const char *meaning)
{
    add(list, what, type, 0, NULL, "%s", name);
    list->rows[list->count - 1].at = at;
    list->rows[list->count - 1].meaning = meaning;
}

static void mean(struct list *list, const char *meaning) { list->rows[list->count - 1].meaning = meaning; }

// Whether the equations read a field of the material.
static bool is_read(const struct glsl_facts *f, const struct material_field *row)
{
    switch (row->reader) {
    case FIELD_LIT:
        return !f->paints;
    case FIELD_ENVIRONMENT:
        return f->environment;
    case FIELD_HIGHLIGHT:
        return f->highlights;
    case FIELD_LOBE:
        return glsl_lobe_reads(f, row->field.name);
    default:
        return true;
    }
}

// The fields of the material: those of its struct, or (with products) rows of their own. A block has all of them.
static void add_fields(struct list *list, const struct glsl_facts *f, const char *block, const char *prefix)
{
    bool products = f->choices->products;
    struct glsl_material_layout layout = glsl_material_layout(products);
    for (int i = 0; i < layout.count; i++) {
        const struct material_field *row = layout.fields[i];
        if (f->choices->storage != GLSL_BLOCK && !is_read(f, row))
            continue;
        add(list, products ? GLSL_HEAD : GLSL_MATERIAL, row->field.type < LAM_FIELD_RGB ? "float" : "vec4", 0, block,
            "%s%s", prefix, glsl_field_name(row, products));
        mean(list, products && row->product_summary ? row->product_summary : row->field.summary);
        list->rows[list->count - 1].at = layout.at[i];
    }
}

static void add_products(struct list *list, const struct glsl_facts *f, bool back)
{
    const struct glsl_choices *c = f->choices;
    const char *p = back ? "back_" : "",
               *block = c->storage == GLSL_BLOCK ? (back ? "BackProducts" : "Products") : NULL;
    bool all = block != NULL, lists = c->storage != GLSL_TEXTURE;
    int first = list->count, lights = f->lights && lists ? c->light_count : 0,
        skies = f->skies && lists ? c->hemisphere_count : 0;
    add_fields(list, f, block, p);
    if (lights) {
        add(list, GLSL_DIFFUSE_PRODUCT, "vec4", lights, block, "%sdiffuse_product", p);
        mean(list, "kd Ld, for each light");
        if (all || f->highlights) {
            add(list, GLSL_SPECULAR_PRODUCT, "vec4", lights, block, "%sspecular_product", p);
            mean(list, "ks Ls, for each light");
        }
        if (c->gl1) {
            add(list, GLSL_LIGHT_AMBIENT_PRODUCT, "vec4", lights, block, "%slight_ambient_product", p);
            mean(list, "ka La of each light, weakened like the rest of it");
        }
    }
    if (skies) {
        add(list, GLSL_SKY_PRODUCT, "vec4", skies, block, "%ssky_product", p);
        mean(list, "ka times the light from above, for each hemisphere");
        add(list, GLSL_GROUND_PRODUCT, "vec4", skies, block, "%sground_product", p);
        mean(list, "ka times the light from below, for each hemisphere");
    }
    if (!lists && (f->lights || f->skies)) {
        add(list, GLSL_FIRST_PRODUCT, "int", 0, NULL, "%sfirst_product", p);
        mean(list, "the texel of product_list where the material's products begin");
    }
    for (int i = first; i < list->count; i++)
        list->rows[i].back = back;
}

int glsl_rows(const struct glsl_facts *f, struct glsl_row rows[GLSL_ROWS_MAX])
{
    const struct glsl_choices *c = f->choices;
    struct list list = {.rows = rows};
    add(&list, GLSL_MODEL_VIEW_PROJECTION, "mat4", 0, NULL, "model_view_projection");
    mean(&list, "positions of the mesh to clip space");
    bool normals = f->lit && !f->paints;
    if (normals || c->show == LAM_OUTPUT_DEPTH) {
        add(&list, GLSL_MODEL_VIEW, "mat4", 0, NULL, "model_view");
        mean(&list, "positions of the mesh to eye space");
    }
    if (normals) {
        add(&list, GLSL_NORMAL_MATRIX, "mat3", 0, NULL, "normal_matrix");
        mean(&list, "normals to eye space: the inverse transpose of model_view's 3x3, times any positive number");
    }
    if (c->exposes && !f->shows_place && !f->shows_vector) {
        add(&list, GLSL_EXPOSURE, "float", 0, NULL, "exposure");
        mean(&list, "all light is multiplied by it: 2 to the power of the stops");
    }
    if (c->show == LAM_OUTPUT_IDS) {
        add(&list, GLSL_OBJECT, "float", 0, NULL, "object");
        mean(&list, "the object's number");
    }
    if (f->environment) {
        add(&list, GLSL_ENVIRONMENT_MATRIX, "mat3", 0, NULL, "environment_matrix");
        mean(&list, "directions of eye space to the axes of the surroundings");
        if (c->environment == GLSL_CUBE) {
            add(&list, GLSL_ENVIRONMENT, "samplerCube", 0, NULL, "environment");
            mean(&list, "the surroundings in linear light: bilinear, seamless, no mipmaps");
        } else {
            add(&list, GLSL_ENVIRONMENT, "sampler2DArray", 0, NULL, "environment_faces");
            mean(&list, "the surroundings in linear light: six faces +x -x +y -y +z -z, each with a border "
                        "of one texel");
        }
    }
    if (!f->lit || f->shows_vector) {
        if (f->lights) {
            const char *block = c->storage == GLSL_BLOCK ? "Lights" : NULL;
            add(&list, GLSL_LIGHTS, c->storage == GLSL_TEXTURE ? "sampler2D" : "Light",
                c->storage == GLSL_TEXTURE ? 0 : c->light_count, block,
                c->storage == GLSL_TEXTURE ? "light_list" : "lights");
            list.rows[list.count - 1].what = c->storage == GLSL_TEXTURE ? GLSL_LIGHT_LIST : GLSL_LIGHTS;
            mean(&list, "the light");
        }
        return list.count;
    }
    const char *block = c->storage == GLSL_BLOCK ? "Lights" : NULL;
    if (!c->products && !f->paints) {
        add(&list, GLSL_AMBIENT_LIGHT, "vec4", 0, block, "ambient_light");
        mean(&list, "La: all light from everywhere, that of the lights included");
    }
    if (c->storage == GLSL_TEXTURE) {
        if (f->lights || f->skies) {
            add(&list, GLSL_LIGHT_LIST, "sampler2D", 0, NULL, "light_list");
            mean(&list, "float texture, 1024 texels wide, no filter: the lights, then the hemispheres "
                        "(docs/shaders.md)");
            if (c->products) {
                add(&list, GLSL_PRODUCT_LIST, "sampler2D", 0, NULL, "product_list");
                mean(&list, "the same: the materials' products with them");
            }
        }
    } else {
        if (f->lights) {
            add(&list, GLSL_LIGHTS, "Light", c->light_count, block, "lights");
            mean(&list, "the lights, those of one kind side by side");
        }
        if (f->skies) {
            add(&list, GLSL_HEMISPHERES, "Hemisphere", c->hemisphere_count, block, "hemispheres");
            mean(&list, "skies over a ground");
        }
    }
    for (int back = 0; back <= f->back; back++) {
        if (c->products) {
            add_products(&list, f, back);
            continue;
        }
        add(&list, GLSL_MATERIAL, "Material", 0, c->storage == GLSL_BLOCK ? "Materials" : NULL, "%smaterial",
            back ? "back_" : "");
        mean(&list, back ? "of the back" : "of the front");
        list.rows[list.count - 1].back = back;
    }
    return list.count;
}

int glsl_attributes(const struct glsl_facts *f, struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX])
{
    const struct glsl_choices *c = f->choices;
    bool flat = f->shading == LAM_SHADING_FLAT, old = c->version == GLSL_120, looks = f->lit && !f->paints;
    int count = 0;
    rows[count++] = (struct glsl_attribute){0, "vec3", "position", "of the mesh"};
    if (looks)
        rows[count++] = (struct glsl_attribute){1, "vec3", "normal",
                                                flat ? "of the mesh: the triangle's own, the same at its three vertices"
                                                     : "of the mesh, of any length"};
    if (c->colors && f->lit && !f->shows_vector)
        rows[count++] = (struct glsl_attribute){
            2, "vec4", "color",
            flat && old ? "linear, not premultiplied: of the triangle's last vertex, at its three"
                        : "linear, not premultiplied"};
    if (f->threads && c->tangents)
        rows[count++] = (struct glsl_attribute){
            3, "vec3", "tangent",
            flat && old ? "of the mesh, along the surface: of the triangle's last vertex, at its three"
                        : "of the mesh, along the surface"};
    if (f->application) {
        rows[count++] =
            (struct glsl_attribute){4, "vec4", "front_color", "the light that leaves the front there, and the opacity"};
        if (c->two_sided)
            rows[count++] = (struct glsl_attribute){5, "vec4", "back_color",
                                                    "the light that leaves the back there, and the opacity"};
    }
    if (flat && old && looks)
        rows[count++] =
            (struct glsl_attribute){6, "vec3", "provoking_position",
                                    "of the triangle's last vertex, at its three: where a flat triangle is lit"};
    return count;
}

void glsl_declare_attributes(struct text *text, const struct glsl_facts *f)
{
    struct glsl_attribute rows[GLSL_ATTRIBUTES_MAX];
    int count = glsl_attributes(f, rows), width = 0;
    for (int i = 0; i < count; i++)
        width = (int)strlen(rows[i].name) > width ? (int)strlen(rows[i].name) : width;
    for (int i = 0; i < count; i++) {
        char start[40];
        snprintf(start, sizeof start, "layout(location = %d) in ", rows[i].location);
        text_print(text, "%s%s %s;%*s // %s%s", f->choices->version == GLSL_120 ? "attribute " : start, rows[i].type,
                   rows[i].name, width - (int)strlen(rows[i].name), "", rows[i].meaning, i + 1 < count ? "\n" : "");
    }
}

bool glsl_row_is_in(const struct glsl_facts *f, const struct glsl_row *row, bool fragment)
{
    switch (row->what) {
    case GLSL_MODEL_VIEW_PROJECTION:
    case GLSL_NORMAL_MATRIX:
        return !fragment;
    case GLSL_EXPOSURE:
        return fragment;
    case GLSL_MODEL_VIEW: // also the axis of threads without tangents
        return !fragment || (f->per_fragment && f->threads && !f->choices->tangents);
    default:
        return fragment == f->per_fragment;
    }
}

int glsl_members(const struct glsl_facts *f, const char *type, struct glsl_row rows[GLSL_ROWS_MAX])
{
    const struct glsl_choices *c = f->choices;
    struct list list = {.rows = rows};
    bool all = c->storage == GLSL_BLOCK; // a block keeps its layout, whatever is looked at
    if (strcmp(type, "Light") == 0) {
        bool both = all || f->shows_vector;
        if (both || f->positions) {
            add_member(&list, GLSL_LIGHTS, "vec4", 0, "position",
                       "in eye space, w 1; a directional light's is not looked at");
        }
        if (both || f->directions) {
            add_member(&list, GLSL_LIGHTS, "vec4", 4, "direction",
                       "in eye space, unit, w 0: the way a directional light travels, a spot's axis");
        }
        if (all || f->falloff) {
            add_member(&list, GLSL_LIGHTS, "vec4", 8, "attenuation",
                       "constant, linear, quadratic, 1 / range (0: no range)");
        }
        if (all || f->cones) {
            add_member(&list, GLSL_LIGHTS, "vec4", 12, "cone",
                       "cos cutoff, exponent, cos outer, 1 / max(0.001, cos inner - cos outer); "
                       "of these what the spot has");
        }
        if (c->products || f->shows_vector)
            return list.count;
        add_member(&list, GLSL_LIGHTS, "vec4", 16, "diffuse", "Ld");
        if (all || f->highlights) {
            add_member(&list, GLSL_LIGHTS, "vec4", 20, "specular", "Ls");
        }
        if (c->gl1) {
            add_member(&list, GLSL_LIGHTS, "vec4", 24, "ambient", "La, weakened like the rest");
        }
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

// The comments of rows that stand together begin in one column.
static void declare(struct text *text, const char *start, const struct glsl_row *row, int width)
{
    char name[48];
    snprintf(name, sizeof name, row->count ? "%s[%d];" : "%s;", row->name, row->count);
    text_print(text, "%s%s %s%*s // %s\n", start, row->type, name, width - width_of(row), "", row->meaning);
}

static void declare_struct(struct text *text, const struct glsl_facts *facts, const char *type)
{
    struct glsl_row members[GLSL_ROWS_MAX];
    int count = glsl_members(facts, type, members);
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

void glsl_declare(struct text *text, const struct glsl_facts *facts, bool fragment)
{
    struct glsl_row rows[GLSL_ROWS_MAX];
    int count = glsl_rows(facts, rows);
    const char *block = NULL;
    int width = 0;
    for (int i = 0; i < count; i++)
        if (glsl_row_is_in(facts, &rows[i], fragment))
            width = width_of(&rows[i]) > width ? width_of(&rows[i]) : width;
    if (!width)
        return;
    text_add(text, "\n// --- what the program sets\n\n");
    for (int i = 0; i < count; i++) { // a struct stands before what has it
        bool told = !glsl_row_is_in(facts, &rows[i], fragment);
        for (int k = 0; k < i; k++)
            told |= strcmp(rows[k].type, rows[i].type) == 0;
        if (!told)
            declare_struct(text, facts, rows[i].type);
    }
    for (int i = 0; i < count; i++) {
        if (!glsl_row_is_in(facts, &rows[i], fragment))
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
