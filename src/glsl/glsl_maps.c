// glsl_maps.c: generates the GLSL for maps: a struct with a member for each number that maps change, and for each side
// a function that reads the texels and fills it. The rules are the same as in src/cpu/shade/textures.inc.
//
// Longer than 600 lines: one generated text, built from the rows of its table.
#include "glsl_rows.h"

#define LANES 1
#include "lighting.h"

#include "texture_map.h"

#include <stdio.h>
#include <string.h>

// --- choices

static bool is_drawn(int map) { return map != LAM_MAP_DISPLACEMENT && map != LAM_MAP_REFLECTION; }

// If light is evaluated at vertices or once per triangle, these maps are still applied at each fragment.
static bool follows_lighting(int map)
{
    return map == LAM_MAP_DIFFUSE || map == LAM_MAP_OPACITY || map == LAM_MAP_EMISSION;
}

static bool is_read(const struct frame *frame, const lam_material *material, int map)
{
    return material->maps[map] && is_drawn(map) &&
           (frame->settings.shading == LAM_SHADING_PHONG || follows_lighting(map));
}

bool glsl_reads_maps(const struct frame *frame, const lam_material *material)
{
    bool any = false;
    for (int i = 0; i < LAM_MAP_COUNT; i++)
        any |= is_read(frame, material, i);
    return any;
}

static void choose_side(struct glsl_choices *c, const struct frame *frame, const lam_material *material, int side,
                        const lam_mesh *mesh, const lam_texture_map *seen[2 * LAM_MAP_COUNT], int *seen_count)
{
    c->converted[side] = glsl_converts(frame, material);
    for (int i = 0; i < LAM_MAP_COUNT; i++) {
        const lam_texture_map *map = material->maps[i];
        bool placed = map && glsl_has_texcoords(mesh, map);
        bool needs_tangents = i == LAM_MAP_NORMAL || i == LAM_MAP_CLEARCOAT_NORMAL;
        if (!is_read(frame, material, i) || (needs_tangents && (!mesh->tangents || !placed)) ||
            (i == LAM_MAP_BUMP && !placed))
            continue;
        if (map_layer((lam_map)i) && !(map_layer((lam_map)i) & frame_layers(frame, material)))
            continue;
        int texels = 0;
        while (texels < *seen_count && !texture_map_same(seen[texels], map))
            texels++;
        if (texels == *seen_count)
            seen[(*seen_count)++] = map;
        c->maps[side][i] = (struct glsl_map){.used = 1,
                                             .texels = (uint8_t)texels,
                                             .texcoords = (uint8_t)map->texcoords,
                                             .wrap_s = (uint8_t)map->wrap_s,
                                             .wrap_t = (uint8_t)map->wrap_t,
                                             .magnify = (uint8_t)map->magnify,
                                             .minify = (uint8_t)map->minify,
                                             .mip = (uint8_t)map->mip,
                                             .channel = (uint8_t)map->channel};
    }
}

void glsl_choose_maps(struct glsl_choices *c, const struct frame *frame, const struct frame_draw_range *range)
{
    const lam_texture_map *seen[2 * LAM_MAP_COUNT];
    int count = 0;
    c->anisotropy = (uint8_t)frame->settings.anisotropy;
    for (int side = 0; side < 2; side++) {
        const lam_material *material = frame->materials[side ? range->back : range->front];
        bool masks = material->alpha_mode == LAM_ALPHA_MASK && frame->masked && range->translucent;
        // If no texel has an alpha below 1, a map's scale makes nothing translucent.
        bool opaque =
            material->alpha_mode == LAM_ALPHA_MASK || (!range->translucent && glsl_reads_maps(frame, material));
        c->alpha[side] = masks ? LAM_ALPHA_MASK : opaque ? LAM_ALPHA_OPAQUE : (uint8_t)material->alpha_mode;
    }
    for (int side = 0; side <= c->back_material; side++)
        choose_side(c, frame, frame->materials[side ? range->back : range->front], side, frame->draws[range->draw].mesh,
                    seen, &count);
}

void glsl_use_hardware_filter(struct glsl_choices *c)
{
    c->hardware_filter = true;
    c->anisotropy = 1;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            struct glsl_map *map = &c->maps[side][i];
            map->wrap_s = map->wrap_t = map->magnify = map->minify = map->mip = 0;
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
    if (!glsl_has_texcoords(mesh, map)) { // as if all texels were 1
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
    return any && frame->settings.shading != LAM_SHADING_PHONG && !output_is_vector(frame->settings.output) &&
           !glsl_output_is_geometry(frame->settings.output);
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

// --- facts

bool glsl_is_physical(const struct glsl_facts *f) { return frame_is_physical(f->choices->reflection); }

// Returns the map of a side whose level of detail is shown, or LAM_MAP_COUNT if there is none.
static lam_map lod_map(const struct glsl_facts *f, int side)
{
    for (int i = 0; i < LOD_MAPS; i++)
        if (f->choices->maps[side][frame_lod_maps[i]].used)
            return frame_lod_maps[i];
    return LAM_MAP_COUNT;
}

// Returns whether the material at a point depends on a map of that side.
static bool material_reads(const struct glsl_facts *f, int side, lam_map map)
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
static bool reads(const struct glsl_facts *f, int side, lam_map map)
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

void glsl_find_maps(struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    bool two = c->two_sided && c->back_material, values = f->output_vector || f->output_geometry || f->output_material;
    for (int side = 0; side <= two; side++) {
        f->has_mask |= c->alpha[side] == LAM_ALPHA_MASK;
        f->separate_texture_terms |= c->maps[side][LAM_MAP_DIFFUSE].used || c->maps[side][LAM_MAP_EMISSION].used;
    }
    f->value_masks = f->has_mask && values;
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

lam_map glsl_map_owner(const struct glsl_facts *f, int side, lam_map map)
{
    const struct glsl_map *maps = f->choices->maps[side];
    for (int i = 0; i < (int)map && map != LAM_MAP_BUMP; i++) // a bump map is read beside the point
        if (f->maps[side][i] && i != LAM_MAP_BUMP && maps[i].texels == maps[map].texels)
            return (lam_map)i;
    return map;
}

static bool any_has(const struct glsl_facts *f, lam_map map) { return f->maps[0][map] || f->maps[1][map]; }

// The members of the struct, and the map of each; members for layers follow (glsl_layer_input).
enum {
    COLOR,
    AMBIENT,
    SPECULAR,
    EMISSION,
    NORMAL,
    OPACITY,
    SHININESS,
    OCCLUSION,
    ROUGHNESS,
    METALLIC,
    DIELECTRIC,
    SLOPES,
    ACROSS,
    DOWN,
    LEVEL,
    COAT_NORMAL,
    NORMAL_VARIANCE,
    COAT_VARIANCE,
    STRETCH,
    MEMBERS
};
static const struct {
    const char *name, *type, *meaning;
    lam_map map;
} members[MEMBERS] = {
    [COLOR] = {"color", "vec3", "factor of the diffuse or base colour", LAM_MAP_DIFFUSE},
    [AMBIENT] = {"ambient", "vec3", "factor of the ambient colour", LAM_MAP_AMBIENT},
    [SPECULAR] = {"specular", "vec3", "factor of the highlights", LAM_MAP_SPECULAR},
    [EMISSION] = {"emission", "vec3", "factor of the emission", LAM_MAP_EMISSION},
    [NORMAL] = {"normal", "vec3", "components of the normal along tangent, bitangent and the mesh's normal",
                LAM_MAP_NORMAL},
    [OPACITY] = {"opacity", "float", "factor of the opacity", LAM_MAP_OPACITY},
    [SHININESS] = {"shininess", "float", "exponent of the highlights", LAM_MAP_SHININESS},
    [OCCLUSION] = {"occlusion", "float", "unoccluded share of ambient light", LAM_MAP_OCCLUSION},
    [ROUGHNESS] = {"roughness", "float", "0 a mirror, 1 matt", LAM_MAP_ROUGHNESS},
    [METALLIC] = {"metallic", "float", "0 a dielectric, 1 a metal", LAM_MAP_METALLIC},
    [DIELECTRIC] = {"dielectric", "float", "factor of the diffuse light", LAM_MAP_METALLIC},
    [SLOPES] = {"slopes", "vec2", "by how much the surface rises along the next two", LAM_MAP_BUMP},
    [ACROSS] = {"across", "vec3", "the direction of the picture's rows in eye space, not unit", LAM_MAP_BUMP},
    [DOWN] = {"down", "vec3", "the direction of its columns", LAM_MAP_BUMP},
    [LEVEL] = {"level", "float", "level of detail", LAM_MAP_COUNT},
    [COAT_NORMAL] = {"coat_normal", "vec3", "components of the coat's normal", LAM_MAP_CLEARCOAT_NORMAL},
    [NORMAL_VARIANCE] = {"normal_variance", "float", "the variance of the normals within the pixel", LAM_MAP_NORMAL},
    [COAT_VARIANCE] = {"coat_variance", "float", "the variance of the coat's normals", LAM_MAP_CLEARCOAT_NORMAL},
    [STRETCH] = {"stretch", "vec3", "direction of the stretch by tangent and bitangent, and its strength",
                 LAM_MAP_ANISOTROPY},
};

static bool has_member(const struct glsl_facts *f, int member)
{
    bool masks = member == OPACITY && f->value_masks;
    if (member == LEVEL || (f->shows_level && !masks))
        return member == LEVEL && f->shows_level && f->has_maps && !f->maps_interpolated_light;
    if ((member == NORMAL_VARIANCE || member == COAT_VARIANCE) && !f->widens_roughness)
        return false;
    bool from_physical = member == SPECULAR || member == SHININESS
                             ? f->highlights
                             : member == ROUGHNESS || member == METALLIC || member == DIELECTRIC;
    return any_has(f, members[member].map) || (member == OPACITY && any_has(f, LAM_MAP_DIFFUSE)) ||
           (f->converts && f->has_maps && from_physical);
}

static bool has_layer_input(const struct glsl_facts *f, const struct glsl_layer_input *input)
{
    return input->map != LAM_MAP_COUNT && any_has(f, input->map) && !f->shows_level;
}

bool glsl_maps_have(const struct glsl_facts *f, const char *member)
{
    for (int i = 0; i < MEMBERS; i++)
        if (strcmp(members[i].name, member) == 0)
            return has_member(f, i);
    for (int i = 0; glsl_layer_input(i); i++)
        if (strcmp(glsl_layer_input(i)->member, member) == 0)
            return has_layer_input(f, glsl_layer_input(i));
    return false;
}

// --- text

static const char *prefix(int side) { return side ? "back_" : ""; }

// Appends a parameter of the side's material.
static void add_own(struct text *text, const struct glsl_facts *f, int side, const char *name)
{
    text_print(text, "%s%s%s", prefix(side), f->choices->products ? "" : "material.", name);
}

// Appends the value of a map, or of one channel.
static void add_value(struct text *text, const struct glsl_facts *f, int side, lam_map map, const char *channels)
{
    const char *name = lam_map_name(map), *owner = lam_map_name(glsl_map_owner(f, side, map));
    text_print(text, "%s_texel.%s * %s%s_map_s.w + %s%s_map_t.w", owner, channels, prefix(side), name, prefix(side),
               name);
}

static void add_number(struct text *text, const struct glsl_facts *f, int side, lam_map map)
{
    static const char *const channels[] = {"r", "g", "b", "a"};
    add_value(text, f, side, map, channels[f->choices->maps[side][map].channel]);
}

static void add_color(struct text *text, const struct glsl_facts *f, int side, int member, lam_map map)
{
    if (!has_member(f, member))
        return;
    text_print(text, "    maps.%s = ", members[member].name);
    if (f->maps[side][map])
        add_value(text, f, side, map, "rgb");
    else
        text_add(text, member == AMBIENT && has_member(f, COLOR) ? "maps.color" : "vec3(1.0)");
    text_add(text, ";\n");
}

// Appends a number: the material's own times the map's.
static void add_factor(struct text *text, const struct glsl_facts *f, int side, int member, lam_map map,
                       const char *own)
{
    if (!has_member(f, member))
        return;
    text_print(text, "    maps.%s = ", members[member].name);
    if (own)
        add_own(text, f, side, own);
    else
        text_add(text, "1.0");
    if (f->maps[side][map]) {
        text_add(text, " * (");
        add_number(text, f, side, map);
        text_add(text, ")");
    }
    text_add(text, ";\n");
}

// Appends the arguments for the texture lookup: its texture coordinates, and the filters that the shader computes.
static void add_sampling(struct text *text, const struct glsl_map *map)
{
    static const char *const wraps[] = {"WRAP_REPEAT", "WRAP_CLAMP", "WRAP_MIRROR"};
    static const char *const filters[] = {"FILTER_LINEAR", "FILTER_NEAREST"};
    static const char *const mips[] = {"MIP_LINEAR", "MIP_NEAREST", "MIP_NONE"};
    text_print(text, "%s,\n        sampling(%s, %s, %s, %s, %s)", map->texcoords ? "second" : "first",
               wraps[map->wrap_s], wraps[map->wrap_t], filters[map->magnify], filters[map->minify], mips[map->mip]);
}

static void add_texels(struct text *text, const struct glsl_facts *f, int side)
{
    for (int i = 0; i < LAM_MAP_COUNT && (!has_member(f, LEVEL) || f->value_masks); i++) {
        if (!f->maps[side][i] || i == LAM_MAP_BUMP || glsl_map_owner(f, side, (lam_map)i) != (lam_map)i)
            continue;
        const char *name = lam_map_name((lam_map)i), *p = prefix(side);
        text_print(text, "    vec4 %s_texel = map_texel(%s%s_map, %s%s_map_s, %s%s_map_t, ", name, p, name, p, name, p,
                   name);
        add_sampling(text, &f->choices->maps[side][i]);
        text_add(text, ");\n");
    }
}

// Appends the heights of a bump map one texel of level 0 before and behind the point, along rows and columns.
static void add_slopes(struct text *text, const struct glsl_facts *f, int side)
{
    if (!has_member(f, SLOPES))
        return;
    if (!f->maps[side][LAM_MAP_BUMP]) {
        text_add(text, "    maps.slopes = vec2(0.0);\n    maps.across = vec3(0.0);\n    maps.down = vec3(0.0);\n");
        return;
    }
    static const char *const names[] = {"left", "right", "above", "below"};
    const struct glsl_map *map = &f->choices->maps[side][LAM_MAP_BUMP];
    const char *p = prefix(side), *owner = lam_map_name(glsl_map_owner(f, side, LAM_MAP_BUMP));
    text_print(text, "    vec2 one = 1.0 / vec2(textureSize(%s%s_map, 0));\n", p, owner);
    for (int i = 0; i < 4; i++) {
        text_print(text, "    float %s = map_texel(%s%s_map, %sbump_map_s%s, %sbump_map_t%s, ", names[i], p, owner, p,
                   i == 0   ? " - vec4(0.0, 0.0, one.x, 0.0)"
                   : i == 1 ? " + vec4(0.0, 0.0, one.x, 0.0)"
                            : "",
                   p,
                   i == 2   ? " - vec4(0.0, 0.0, one.y, 0.0)"
                   : i == 3 ? " + vec4(0.0, 0.0, one.y, 0.0)"
                            : "");
        add_sampling(text, map);
        text_print(text, ").%c;\n", "rgba"[map->channel]);
    }
    text_print(text, "    maps.slopes = vec2(right - left, below - above) * (0.5 * %sbump_map_s.w);\n", p);
    text_print(text, "    picture_axes(p, %sbump_map_s, %sbump_map_t, %s, maps.across, maps.down);\n", p, p,
               map->texcoords ? "second" : "first");
}

static void add_opacity(struct text *text, const struct glsl_facts *f, int side)
{
    if (!has_member(f, OPACITY))
        return;
    text_add(text, "    maps.opacity = 1.0");
    for (int i = 0; i < 2; i++) {
        lam_map map = i ? LAM_MAP_OPACITY : LAM_MAP_DIFFUSE;
        if (!f->maps[side][map])
            continue;
        text_add(text, " * (");
        if (i)
            add_number(text, f, side, map);
        else
            add_value(text, f, side, map, "a");
        text_add(text, ")");
    }
    text_add(text, ";\n");
}

// Appends the numbers of a metallic-roughness material for a classic model (lam_material_as_classic).
static void add_conversion(struct text *text, const struct glsl_facts *f, int side)
{
    bool mirrored = lobe_properties((int)f->choices->reflection) & LOBE_MIRRORED;
    if (!has_member(f, SHININESS) || !has_member(f, SPECULAR))
        return;
    text_add(text, "    float exponent = classic_exponent(maps.roughness);\n    vec3 base = ");
    add_own(text, f, side, "diffuse.rgb");
    text_print(text, "%s%s;\n", f->choices->colors ? " * tint.rgb" : "", has_member(f, COLOR) ? " * maps.color" : "");
    text_print(text,
               "    maps.specular = classic_specular(base, maps.metallic, exponent);\n"
               "    maps.shininess = exponent%s;\n",
               mirrored ? " * 0.25" : "");
}

// Appends the normal from a normal map, along tangent, bitangent and the mesh's own normal.
static void add_normal(struct text *text, const struct glsl_facts *f, int side, int member, lam_map map)
{
    const char *to = members[member].name, *p = prefix(side), *name = lam_map_name(map);
    if (!has_member(f, member))
        return;
    if (!f->maps[side][map]) {
        text_print(text, "    maps.%s = vec3(0.0, 0.0, 1.0);\n", to);
        return;
    }
    const char *owner = lam_map_name(glsl_map_owner(f, side, map));
    text_print(text, "    maps.%s = vec3((%s_texel.xy * 2.0 - 1.0) * %s%s_map_s.w, %s_texel.z * 2.0 - 1.0);\n", to,
               owner, p, name, owner);
    text_print(text, "    if (%s%s_map_s.w == 0.0) {\n        maps.%s = vec3(0.0, 0.0, 1.0);\n    }\n", p, name, to);
}

// Appends the variance of a normal map.
static void add_variance(struct text *text, const struct glsl_facts *f, int side, int member, lam_map map)
{
    const char *to = members[member].name, *p = prefix(side), *name = lam_map_name(map);
    if (!has_member(f, member))
        return;
    if (!f->maps[side][map]) {
        text_print(text, "    maps.%s = 0.0;\n", to);
        return;
    }
    const char *owner = lam_map_name(glsl_map_owner(f, side, map));
    text_print(text,
               "    maps.%s = map_variance(%s_texel.xyz * 2.0 - 1.0, %s%s_map_s.w, map_level(%s%s_map, %s%s_map_s, "
               "%s%s_map_t, %s));\n",
               to, owner, p, name, p, owner, p, name, p, name,
               f->choices->maps[side][map].texcoords ? "second" : "first");
}

// Appends a number or a colour of a layer: the material's own times the map's. The thickness of a film is interpolated
// between two numbers.
static void add_layer_input(struct text *text, const struct glsl_facts *f, int side,
                            const struct glsl_layer_input *input)
{
    bool read = f->maps[side][input->map], between = read && input->map == LAM_MAP_IRIDESCENCE_THICKNESS;
    text_print(text, between ? "    maps.%s = mix(" : "    maps.%s = ", input->member);
    if (between) {
        add_own(text, f, side, "iridescence_thickness_min");
        text_add(text, ", ");
    }
    add_own(text, f, side, input->field);
    text_add(text, input->color ? ".rgb" : "");
    text_add(text, between ? ", " : read ? " * (" : "");
    if (read && input->color)
        add_value(text, f, side, input->map, "rgb");
    else if (read)
        add_number(text, f, side, input->map);
    text_add(text, read ? ");\n" : ";\n");
}

static void add_stretch(struct text *text, const struct glsl_facts *f, int side)
{
    if (!has_member(f, STRETCH))
        return;
    text_add(text, "    float turned = ");
    add_own(text, f, side, "anisotropy_rotation_rad");
    text_add(text, ";\n    vec3 stretch = ");
    if (f->maps[side][LAM_MAP_ANISOTROPY])
        add_value(text, f, side, LAM_MAP_ANISOTROPY, "rgb");
    else
        text_add(text, "vec3(1.0, 0.5, 1.0)");
    text_add(text, ";\n    stretch.xy = stretch.xy * 2.0 - 1.0;\n"
                   "    stretch.xy = stretch.xy * rsqrt(dot(stretch.xy, stretch.xy));\n"
                   "    maps.stretch = vec3(cos(turned) * stretch.x - sin(turned) * stretch.y,\n"
                   "                        sin(turned) * stretch.x + cos(turned) * stretch.y, stretch.z * ");
    add_own(text, f, side, "anisotropy");
    text_add(text, ");\n");
}

static void add_side(struct text *text, const struct glsl_facts *f, int side)
{
    const struct glsl_choices *c = f->choices;
    bool varies = c->converted[side] || f->maps[side][LAM_MAP_METALLIC];
    text_print(text,
               "\n// Returns the values of the maps of the %s at the point.\n"
               "surface_maps %s_maps(footprint first, footprint second, vec3 p, vec4 tint)\n{\n",
               side ? "back" : "front", side ? "back" : "front");
    text_add(text, "    surface_maps maps;\n");
    add_texels(text, f, side);
    add_color(text, f, side, COLOR, LAM_MAP_DIFFUSE);
    add_color(text, f, side, AMBIENT, LAM_MAP_AMBIENT);
    add_color(text, f, side, SPECULAR, LAM_MAP_SPECULAR);
    add_color(text, f, side, EMISSION, LAM_MAP_EMISSION);
    add_normal(text, f, side, NORMAL, LAM_MAP_NORMAL);
    add_normal(text, f, side, COAT_NORMAL, LAM_MAP_CLEARCOAT_NORMAL);
    add_variance(text, f, side, NORMAL_VARIANCE, LAM_MAP_NORMAL);
    add_variance(text, f, side, COAT_VARIANCE, LAM_MAP_CLEARCOAT_NORMAL);
    if (has_member(f, LEVEL)) {
        lam_map map = lod_map(f, side);
        const char *p = prefix(side), *name = map < LAM_MAP_COUNT ? lam_map_name(map) : NULL;
        if (name)
            text_print(text, "    maps.level = map_level(%s%s_map, %s%s_map_s, %s%s_map_t, %s);\n", p,
                       lam_map_name(glsl_map_owner(f, side, map)), p, name, p, name,
                       f->choices->maps[side][map].texcoords ? "second" : "first");
        else
            text_add(text, "    maps.level = 0.0;\n");
    }
    add_slopes(text, f, side);
    add_opacity(text, f, side);
    add_factor(text, f, side, SHININESS, LAM_MAP_SHININESS, "shininess");
    add_factor(text, f, side, OCCLUSION, LAM_MAP_OCCLUSION, NULL);
    add_factor(text, f, side, ROUGHNESS, LAM_MAP_ROUGHNESS, "roughness");
    add_factor(text, f, side, METALLIC, LAM_MAP_METALLIC, "metallic");
    if (has_member(f, DIELECTRIC)) // without products, the diffuse colours of lights never include this factor
        text_add(text, varies || (!c->products && f->microfacet) ? "    maps.dielectric = 1.0 - maps.metallic;\n"
                                                                 : "    maps.dielectric = 1.0;\n");
    for (int i = 0; glsl_layer_input(i); i++)
        if (has_layer_input(f, glsl_layer_input(i)))
            add_layer_input(text, f, side, glsl_layer_input(i));
    add_stretch(text, f, side);
    if (c->converted[side])
        add_conversion(text, f, side);
    text_add(text, "    return maps;\n}\n");
}

void glsl_add_maps(struct text *text, const struct glsl_facts *f)
{
    if (!f->has_maps)
        return;
    text_add(text, "// The values of maps at a point.\nSTRUCT(surface_maps)\n{\n");
    for (int i = 0; i < MEMBERS; i++)
        if (has_member(f, i))
            text_print(text, "    %s %s; // %s\n", members[i].type, members[i].name, members[i].meaning);
    for (int i = 0; material_field(i); i++) {
        const struct glsl_layer_input *input = glsl_layer_input_of(material_field(i));
        if (input && has_layer_input(f, input))
            text_print(text, "    %s %s; // %s\n", input->color ? "vec3" : "float", input->member,
                       material_field(i)->field.summary);
    }
    text_add(text, "};\n");
    for (int side = 0; side <= f->back_material; side++)
        add_side(text, f, side);
}
