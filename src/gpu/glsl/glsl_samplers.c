// glsl_samplers.c: sets the choices for a shader's maps, finds the maps that the shader reads, and writes the replacements
// for the names in maps.glsl.
#include "fail.h"
#include "glsl_declarations.h"
#include "maps.inc"
#include "glsl_text.h"
#include "layer_inputs.h"

#define LANES 1
#include "lighting.h"

#include "texture_map.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the material values that layers use (src/core/lighting/layer_inputs.h)

#define NUMBER(member)                    {#member, #member, LAM_MAP_COUNT, false},
#define MAPPED_NUMBER(member, field, map) {#member, #field, LAM_MAP_##map, false},
#define MAPPED_COLOR(member, field, map)  {#member, #field, LAM_MAP_##map, true},
static const struct glsl_layer_input layer_inputs[] = {LAYER_NUMBERS(NUMBER) LAYER_MAPPED_NUMBERS(MAPPED_NUMBER)
                                                           LAYER_MAPPED_COLORS(MAPPED_COLOR)};
#undef NUMBER
#undef MAPPED_NUMBER
#undef MAPPED_COLOR

const struct glsl_layer_input *glsl_layer_input(int index)
{
    return (unsigned)index < sizeof layer_inputs / sizeof *layer_inputs ? &layer_inputs[index] : NULL;
}

const struct glsl_layer_input *glsl_layer_input_of(const struct material_field *row)
{
    for (int i = 0; glsl_layer_input(i); i++)
        if (row->reader == FIELD_LAYER && strcmp(layer_inputs[i].field, row->field.name) == 0)
            return &layer_inputs[i];
    return NULL;
}

// --- choices

// If light is evaluated at vertices or once per triangle, these maps are still applied at each fragment.
static bool follows_lighting(int map)
{
    return map == LAM_MAP_DIFFUSE || map == LAM_MAP_OPACITY || map == LAM_MAP_EMISSION;
}

static void choose_side(struct glsl_choices *c, const struct frame *frame, const lam_material *material, int side,
                        const lam_mesh *mesh, const lam_texture_map *seen[2 * LAM_MAP_COUNT], int *seen_count)
{
    const unsigned used = frame_maps(frame, material);
    c->converted[side] = frame_converts_at_points(frame, material);
    for (int i = 0; i < LAM_MAP_COUNT; i++) {
        const lam_texture_map *map = material->maps[i];
        bool placed = map && frame_has_texcoords(mesh, map);
        bool needs_tangents = i == LAM_MAP_NORMAL || i == LAM_MAP_CLEARCOAT_NORMAL;
        if (!(used >> i & 1) || (needs_tangents && (!mesh->tangents || !placed)) || (i == LAM_MAP_BUMP && !placed))
            continue;
        int texels = 0;
        while (texels < *seen_count && !texture_map_same(seen[texels], map))
            texels++;
        if (texels == *seen_count)
            seen[(*seen_count)++] = map;
        const struct texture_sampler sampler = frame_map_sampler(frame, material, map);
        c->maps[side][i] = (struct glsl_map){.used = 1,
                                             .texels = (uint8_t)texels,
                                             .texcoords = (uint8_t)map->texcoords,
                                             .wrap_s = (uint8_t)map->wrap_s,
                                             .wrap_t = (uint8_t)map->wrap_t,
                                             .channel = (uint8_t)map->channel,
                                             .magnify = (uint8_t)sampler.magnify,
                                             .minify = (uint8_t)sampler.minify,
                                             .mip = (uint8_t)sampler.mip,
                                             .probes = (uint8_t)sampler.probes};
    }
}

void glsl_choose_maps(struct glsl_choices *c, const struct frame *frame, const struct frame_draw_range *range)
{
    const lam_texture_map *seen[2 * LAM_MAP_COUNT];
    int count = 0;
    for (int side = 0; side < 2; side++) {
        const lam_material *material = frame->materials[side ? range->back : range->front];
        bool masks = material->alpha_mode == LAM_ALPHA_MASK && frame->masked && range->translucent;
        // If no texel has an alpha below 1, no scale of the map makes the surface translucent.
        bool opaque = material->alpha_mode == LAM_ALPHA_MASK || (!range->translucent && frame_maps(frame, material));
        c->alpha[side] = masks ? LAM_ALPHA_MASK : opaque ? LAM_ALPHA_OPAQUE : (uint8_t)material->alpha_mode;
    }
    for (int side = 0; side <= c->back_material; side++)
        choose_side(c, frame, frame->materials[side ? range->back : range->front], side, frame->draws[range->draw].mesh,
                    seen, &count);
}

void glsl_use_hardware_filter(struct glsl_choices *c)
{
    c->hardware_filter = true;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            struct glsl_map *map = &c->maps[side][i];
            map->wrap_s = map->wrap_t = map->magnify = map->minify = map->mip = map->probes = 0;
        }
}

void glsl_map_values(const lam_texture_map *map, const lam_mesh *mesh, float s[4], float t[4])
{
    static const float nothing[2][4] = {{1, 0, 0, 0}, {0, 1, 0, 1}};
    memcpy(s, nothing[0], sizeof nothing[0]);
    memcpy(t, nothing[1], sizeof nothing[1]);
    if (!map)
        return;
    bool given = false;
    for (int i = 0; i < 6; i++)
        given |= map->transform[i / 3][i % 3] != 0;
    if (given) {
        memcpy(s, map->transform[0], sizeof map->transform[0]);
        memcpy(t, map->transform[1], sizeof map->transform[1]);
    }
    s[3] = map->scale != 0 ? map->scale : 1;
    t[3] = map->offset;
    if (!frame_has_texcoords(mesh, map)) { // a map without texture coordinates has the value 1 everywhere
        t[3] += s[3];
        s[3] = 0;
    }
}

bool glsl_separates_texture_terms(const struct frame *frame, const struct frame_draw_range *range)
{
    bool any = false;
    for (int side = 0; side < 2; side++) {
        const lam_material *material = frame->materials[side ? range->back : range->front];
        if (!side || (!frame->draws[range->draw].one_sided && range->back != range->front))
            any |= material->maps[LAM_MAP_DIFFUSE] || material->maps[LAM_MAP_EMISSION];
    }
    return any && frame->settings.shading != LAM_SHADING_PHONG &&
           output_kind(frame->settings.output) != OUTPUT_VECTOR && !glsl_output_is_geometry(frame->settings.output);
}

float glsl_alpha_cutoff(const struct frame *frame, const lam_material *material)
{
    float cutoff = material->alpha_mode == LAM_ALPHA_MASK ? material->alpha_cutoff : 0, opacity = material->diffuse.a;
    if (!output_is_value(frame->settings.output) || !(cutoff > 0))
        return cutoff;
    return opacity > 0 ? cutoff / opacity : 2;
}

void glsl_mapped_emission(const struct frame *frame, const struct frame_draw_range *range, bool back, float out[4])
{
    const lam_material *material = frame->materials[back ? range->back : range->front];
    bool shown = output_is_picture(frame->settings.output) || frame->settings.output == LAM_OUTPUT_EMISSION;
    shown &= range->reflection != LAM_REFLECTION_NONE;
    out[0] = shown ? material->emission.r : 0;
    out[1] = shown ? material->emission.g : 0;
    out[2] = shown ? material->emission.b : 0;
    out[3] = 1;
}

// --- the sampling of maps

bool glsl_is_physical(const struct glsl_stage *f) { return frame_is_physical(f->choices->reflection); }

// Returns the map whose level of detail LAM_OUTPUT_LOD shows on a side, or LAM_MAP_COUNT if the side has no such map.
static lam_map lod_map(const struct glsl_stage *f, int side)
{
    for (int i = 0; i < LOD_MAPS; i++)
        if (f->choices->maps[side][frame_lod_maps[i]].used)
            return frame_lod_maps[i];
    return LAM_MAP_COUNT;
}

// Returns whether the material at a point depends on a map of side `side`.
static bool material_reads(const struct glsl_stage *f, int side, lam_map map)
{
    switch (f->choices->output) {
    case LAM_OUTPUT_BASE_COLOR:
        return map == LAM_MAP_DIFFUSE;
    case LAM_OUTPUT_ROUGHNESS:
        return map == LAM_MAP_ROUGHNESS && glsl_is_physical(f);
    case LAM_OUTPUT_METALLIC:
        return map == LAM_MAP_METALLIC && glsl_is_physical(f);
    case LAM_OUTPUT_OCCLUSION:
        return map == LAM_MAP_OCCLUSION;
    default:
        return map == lod_map(f, side);
    }
}

// Returns whether the shader's output depends on a map.
static bool reads(const struct glsl_stage *f, int side, lam_map map)
{
    if (f->output_material)
        return (!f->maps_interpolated_light && material_reads(f, side, map)) ||
               (f->value_masks && (map == LAM_MAP_DIFFUSE || map == LAM_MAP_OPACITY));
    bool sums = f->adds_lights, lit = f->lit && !f->unlit;
    switch (map) {
    case LAM_MAP_DIFFUSE:
    case LAM_MAP_OPACITY:
        return f->value_masks || (!f->output_geometry && !f->output_vector);
    case LAM_MAP_EMISSION:
        return sums || (f->application && !f->output_vector);
    case LAM_MAP_NORMAL:
    case LAM_MAP_BUMP: // GLSL 120 has no textureSize
        return lit && (f->has_lights || f->has_hemispheres || f->has_environment || f->output_vector) &&
               (map == LAM_MAP_NORMAL || f->choices->version != GLSL_120);
    case LAM_MAP_SHININESS:
        return sums && f->highlights && !f->microfacet;
    case LAM_MAP_METALLIC:
    case LAM_MAP_ROUGHNESS:
        return sums && (f->microfacet || f->converts);
    default:
        return sums && (!map_layer(map) || f->layers & map_layer(map));
    }
}

void glsl_find_maps(struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    bool two = c->two_sided && c->back_material, values = f->output_vector || f->output_geometry || f->output_material;
    for (int side = 0; side <= two; side++) {
        f->has_mask |= c->alpha[side] == LAM_ALPHA_MASK;
        f->separate_texture_terms |= c->maps[side][LAM_MAP_DIFFUSE].used || c->maps[side][LAM_MAP_EMISSION].used;
    }
    f->value_masks = f->has_mask && (values || f->one_point);
    f->maps_interpolated_light = !(f->lit && f->per_fragment && f->shading == LAM_SHADING_PHONG);
    f->separate_texture_terms &= f->maps_interpolated_light && !values;
    f->back_material |= two && (f->value_masks || (f->application && !values));
    for (int side = 0; side <= f->back_material; side++)
        f->converts |= c->converted[side] && f->adds_lights && f->has_lights && !f->maps_interpolated_light;
    for (int side = 0; side <= f->back_material; side++)
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            if (!c->maps[side][i].used || (f->maps_interpolated_light && !follows_lighting(i)) ||
                !reads(f, side, (lam_map)i))
                continue;
            f->maps[side][i] = f->has_maps = true;
            f->first_texcoords |= !c->maps[side][i].texcoords;
            f->second_texcoords |= c->maps[side][i].texcoords != 0;
            f->has_normal_map |= i == LAM_MAP_NORMAL;
            f->has_coat_normal_map |= i == LAM_MAP_CLEARCOAT_NORMAL;
            f->has_bump_map |= i == LAM_MAP_BUMP;
        }
    f->converts &= f->has_maps;
}

lam_map glsl_map_owner(const struct glsl_stage *f, int side, lam_map map)
{
    const struct glsl_map *maps = f->choices->maps[side];
    // a bump map is sampled beside the point, so it has its own sampler
    for (int i = 0; i < (int)map && map != LAM_MAP_BUMP; i++)
        if (f->maps[side][i] && i != LAM_MAP_BUMP && maps[i].texels == maps[map].texels)
            return (lam_map)i;
    return map;
}

static bool any_has(const struct glsl_stage *f, lam_map map) { return f->maps[0][map] || f->maps[1][map]; }

static bool has_layer_input(const struct glsl_stage *f, const struct glsl_layer_input *input)
{
    return input->map != LAM_MAP_COUNT && any_has(f, input->map) && !f->shows_level;
}

bool glsl_maps_have(const struct glsl_stage *f, const char *member)
{
    // The members of surface_maps that other files read, and the map of each member. Members for layers follow.
    static const struct {
        const char *name;
        lam_map map;
        bool converted; // a conversion to a classic model also computes the member
    } members[] = {{"color", LAM_MAP_DIFFUSE, false},       {"ambient", LAM_MAP_AMBIENT, false},
                   {"specular", LAM_MAP_SPECULAR, true},    {"emission", LAM_MAP_EMISSION, false},
                   {"opacity", LAM_MAP_OPACITY, false},     {"shininess", LAM_MAP_SHININESS, true},
                   {"occlusion", LAM_MAP_OCCLUSION, false}, {"roughness", LAM_MAP_ROUGHNESS, true},
                   {"metallic", LAM_MAP_METALLIC, true},    {"dielectric", LAM_MAP_METALLIC, true},
                   {"stretch", LAM_MAP_ANISOTROPY, false}};
    bool opacity = strcmp(member, "opacity") == 0;
    if (strcmp(member, "level") == 0)
        return f->shows_level && f->has_maps && !f->maps_interpolated_light;
    if (f->shows_level && !(opacity && f->value_masks))
        return false;
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        if (strcmp(members[i].name, member) == 0) {
            bool of_highlight = members[i].map == LAM_MAP_SPECULAR || members[i].map == LAM_MAP_SHININESS;
            return any_has(f, members[i].map) || (opacity && any_has(f, LAM_MAP_DIFFUSE)) ||
                   (members[i].converted && f->converts && f->has_maps && (f->highlights || !of_highlight));
        }
    for (int i = 0; glsl_layer_input(i); i++)
        if (strcmp(glsl_layer_input(i)->member, member) == 0)
            return has_layer_input(f, glsl_layer_input(i));
    return false;
}

// --- text

// The names in maps.glsl for one side, and their replacements.
enum { WORDS_MAX = 9 * LAM_MAP_COUNT + 24, WORD_MAX = 128 };
struct words {
    const struct glsl_stage *stage;
    int side;
    struct constant rows[WORDS_MAX + 1];
    char names[WORDS_MAX][36], texts[WORDS_MAX][WORD_MAX];
    int count;
};

// Adds the name that consists of `start` and `end`.
__attribute__((format(printf, 4, 5))) static void add_word(struct words *w, const char *start, const char *end,
                                                           const char *format, ...);
static void add_word(struct words *w, const char *start, const char *end, const char *format, ...)
{
    __builtin_va_list arguments;
    __builtin_va_start(arguments, format);
    vsnprintf(w->texts[w->count], WORD_MAX, format, arguments);
    __builtin_va_end(arguments);
    snprintf(w->names[w->count], sizeof *w->names, "%s%s", start, end);
    w->rows[w->count] = (struct constant){w->names[w->count], w->texts[w->count]};
    w->count++;
}

static void add_flag(struct words *w, const char *start, const char *end, bool holds)
{
    add_word(w, start, end, "%s", holds ? "true" : "false");
}

static const char *prefix(int side) { return side ? "back_" : ""; }

// Adds a parameter of the side's material.
static void add_own(struct words *w, const char *name)
{
    add_word(w, "own_", name, "%s%s%s", prefix(w->side), w->stage->choices->products ? "" : "material.", name);
}

static const char *footprint_word(const struct glsl_map *map) { return map->texcoords ? "second" : "first"; }

// Writes the arguments of the texture lookup: the map's texture coordinates, and the filters that the shader computes.
static void write_sampling(char out[WORD_MAX], const struct glsl_map *map)
{
    static const char *const wraps[] = {"WRAP_REPEAT", "WRAP_CLAMP", "WRAP_MIRROR"};
    static const char *const filters[] = {"FILTER_LINEAR", "FILTER_NEAREST"};
    static const char *const mips[] = {"MIP_LINEAR", "MIP_NEAREST", "MIP_NONE"};
    snprintf(out, WORD_MAX, "%s,\n        sampling(%s, %s, %s, %s, %s, %d)", footprint_word(map), wraps[map->wrap_s],
             wraps[map->wrap_t], filters[map->magnify], filters[map->minify], mips[map->mip], map->probes);
}

static void add_map(struct words *w, lam_map map)
{
    const struct glsl_stage *f = w->stage;
    const struct glsl_map *of = &f->choices->maps[w->side][map];
    const char *p = prefix(w->side), *name = lam_map_name(map), *owner = lam_map_name(glsl_map_owner(f, w->side, map));
    char factor[WORD_MAX / 2];
    snprintf(factor, sizeof factor, "* %s%s_map_s.w + %s%s_map_t.w", p, name, p, name);
    add_flag(w, "has_", name, f->maps[w->side][map]);
    add_flag(w, "any_", name, any_has(f, map));
    add_word(w, name, "_texel", "%s_texel", owner);
    add_word(w, name, "_scale", "%s%s_map_s.w", p, name);
    add_word(w, name, "_rgb", "%s_texel.rgb %s", owner, factor);
    add_word(w, name, "_alpha", "%s_texel.a %s", owner, factor);
    add_word(w, name, "_number", "%s_texel.%c %s", owner, "rgba"[of->channel], factor);
    add_word(w, name, "_level", "map_level(%s%s_map, %s%s_map_s, %s%s_map_t, %s, %d)", p, owner, p, name, p, name,
             footprint_word(of), of->probes);
}

static void add_bump(struct words *w)
{
    const struct glsl_map *map = &w->stage->choices->maps[w->side][LAM_MAP_BUMP];
    char sampling[WORD_MAX];
    write_sampling(sampling, map);
    add_word(w, "bump_picture", "", "%s%s_map", prefix(w->side),
             lam_map_name(glsl_map_owner(w->stage, w->side, LAM_MAP_BUMP)));
    add_word(w, "bump_s", "", "%sbump_map_s", prefix(w->side));
    add_word(w, "bump_t", "", "%sbump_map_t", prefix(w->side));
    add_word(w, "BUMP_SAMPLING", "", "%s", sampling);
    add_word(w, "BUMP_CHANNEL", "", ".%c", "rgba"[map->channel]);
    add_word(w, "BUMP_FOOTPRINT", "", "%s", footprint_word(map));
}

static void add_texels(struct text *text, const struct glsl_stage *f, int side)
{
    for (int i = 0; i < LAM_MAP_COUNT && (!glsl_maps_have(f, "level") || f->value_masks); i++) {
        if (!f->maps[side][i] || i == LAM_MAP_BUMP || glsl_map_owner(f, side, (lam_map)i) != (lam_map)i)
            continue;
        const char *name = lam_map_name((lam_map)i), *p = prefix(side);
        char sampling[WORD_MAX];
        write_sampling(sampling, &f->choices->maps[side][i]);
        text_print(text, "    vec4 %s_texel = map_texel(%s%s_map, %s%s_map_s, %s%s_map_t, %s);\n", name, p, name, p,
                   name, p, name, sampling);
    }
}

// Appends the numbers and colours of layers: the material's value times the map's value. The thickness of a film is
// interpolated between two numbers.
static void add_layer_values(struct text *text, const struct glsl_stage *f, int side)
{
    const char *p = prefix(side), *own = f->choices->products ? "" : "material.";
    for (int i = 0; glsl_layer_input(i); i++) {
        const struct glsl_layer_input *input = glsl_layer_input(i);
        if (!has_layer_input(f, input))
            continue;
        bool read = f->maps[side][input->map], between = read && input->map == LAM_MAP_IRIDESCENCE_THICKNESS;
        const char *name = lam_map_name(input->map);
        text_print(text, "    maps.%s = ", input->member);
        if (between)
            text_print(text, "mix(%s%siridescence_thickness_min, ", p, own);
        text_print(text, "%s%s%s%s", p, own, input->field, input->color ? ".rgb" : "");
        if (read)
            text_print(text, "%s%s_texel.%.*s * %s%s_map_s.w + %s%s_map_t.w)", between ? ", " : " * (",
                       lam_map_name(glsl_map_owner(f, side, input->map)), input->color ? 3 : 1,
                       input->color ? "rgb" : &"rgba"[f->choices->maps[side][input->map].channel], p, name, p, name);
        text_add(text, ";\n");
    }
}

static void add_layer_members(struct text *text, const struct glsl_stage *f)
{
    for (int i = 0; material_field(i); i++) {
        const struct glsl_layer_input *input = glsl_layer_input_of(material_field(i));
        if (input && has_layer_input(f, input))
            text_print(text, "    %s %s; // %s\n", input->color ? "vec3" : "float", input->member,
                       material_field(i)->field.summary);
    }
}

static const char *level_word(const struct words *w)
{
    lam_map map = lod_map(w->stage, w->side);
    for (int i = 0; map < LAM_MAP_COUNT && i < w->count; i++)
        if (strncmp(w->names[i], lam_map_name(map), strlen(lam_map_name(map))) == 0 &&
            strcmp(w->names[i] + strlen(lam_map_name(map)), "_level") == 0)
            return w->texts[i];
    return "0.0";
}

static void add_side(struct text *text, const struct glsl_stage *f, int side)
{
    const struct glsl_choices *c = f->choices;
    struct words w = {.stage = f, .side = side};
    struct text texels = {0}, layers = {0}, members = {0};
    for (int i = 0; i < LAM_MAP_COUNT; i++)
        add_map(&w, (lam_map)i);
    add_bump(&w);
    add_flag(&w, "of_back", "", side);
    add_flag(&w, "shows_level", "", f->shows_level);
    add_flag(&w, "varies", "", // without products, the diffuse colours of lights never include this factor
             c->converted[side] || f->maps[side][LAM_MAP_METALLIC] || (!c->products && f->microfacet));
    add_flag(&w, "is_converted", "", c->converted[side]);
    add_flag(&w, "mirrored", "", lobe_properties((int)c->reflection) & LOBE_MIRRORED);
    add_word(&w, "MAPS_OF_SIDE", "", side ? "back_maps" : "front_maps");
    add_word(&w, "LEVEL", "", "%s", level_word(&w));
    add_word(&w, "BASE", "", "%s%sdiffuse.rgb%s%s", prefix(side), c->products ? "" : "material.",
             c->colors ? " * tint.rgb" : "", any_has(f, LAM_MAP_DIFFUSE) ? " * maps.color" : "");
    static const char *const fields[] = {"shininess", "roughness", "metallic", "anisotropy", "anisotropy_rotation_rad"};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        add_own(&w, fields[i]);
    add_texels(&texels, f, side);
    add_layer_values(&layers, f, side);
    add_layer_members(&members, f);
    const struct constant made[] = {{"TEXELS", texels.bytes ? texels.bytes : ""},
                                    {"LAYER_VALUES", layers.bytes ? layers.bytes : ""},
                                    {"LAYER_MEMBERS", members.bytes ? members.bytes : ""}};
    memcpy(w.rows + w.count, made, sizeof made);
    specialize_branches(text, text_maps_glsl, w.rows);
    text->failed |= texels.failed || layers.failed || members.failed;
    free(texels.bytes);
    free(layers.bytes);
    free(members.bytes);
}

void glsl_add_maps(struct text *text, const struct glsl_stage *f)
{
    for (int side = 0; side <= f->back_material && f->has_maps; side++)
        add_side(text, f, side);
}
