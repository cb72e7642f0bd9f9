// fault.c: sets of faults, and the faults that can occur in a pair of shaders.
#include "fault.h"
#include "contract.h"

#include <string.h>

bool fault_set_has(const fault_set *set, enum fault_bit bit) { return set->words[bit / 64] >> (bit % 64) & 1; }

bool fault_set_equal(const fault_set *a, const fault_set *b)
{
    return memcmp(a->words, b->words, sizeof a->words) == 0 && a->factor == b->factor && a->constant == b->constant;
}

fault_set fault_set_add(const fault_set *set, const struct fault *fault)
{
    fault_set out = *set;
    for (int i = 0; i < MAX_FAULT_BITS && fault->bits[i]; i++)
        out.words[fault->bits[i] / 64] |= (uint64_t)1 << (fault->bits[i] % 64);
    if (fault->factor > 0)
        out.factor = fault->factor;
    return out;
}

static bool hands_on_four(const struct declarations *fragment)
{
    for (int i = 0; i < fragment->count; i++)
        if (fragment->items[i].kind == DECLARED_INPUT && strcmp(fragment->items[i].type, "vec4") == 0)
            return true;
    return false;
}

// Returns the bits of fault_where for a contract with metalness and roughness.
static unsigned physical_bits(const struct physical_convention *c)
{
    return WHERE_PHYSICAL | (c->masking == MASKING_SCHLICK ? WHERE_SCHLICK : WHERE_SMITH) |
           (c->diffuse == DIFFUSE_WHOLE ? 0u : WHERE_SHARED) |
           (c->diffuse == DIFFUSE_OF_MIX ? WHERE_OF_MIX : WHERE_NOT_OF_MIX) |
           (c->tone == TONE_NONE ? WHERE_UNTONED : WHERE_TONED) |
           (c->encoding == ENCODING_NONE ? WHERE_LINEAR : WHERE_ENCODED);
}

// Returns the bits of fault_maps.
static unsigned map_bits(const struct shader_interface *r)
{
    static const struct {
        enum uniform_semantic map;
        unsigned read, factor;
    } rows[] = {{SEMANTIC_BASE_COLOR_MAP, MAPS_BASE, MAPS_BASE_FACTOR},
                {SEMANTIC_METALLIC_ROUGHNESS_MAP, MAPS_METALLIC_ROUGHNESS | MAPS_DATA, MAPS_DATA_FACTOR},
                {SEMANTIC_METALLIC_MAP, MAPS_DATA, MAPS_DATA_FACTOR},
                {SEMANTIC_ROUGHNESS_MAP, MAPS_DATA, MAPS_DATA_FACTOR},
                {SEMANTIC_NORMAL_MAP, MAPS_NORMAL, 0},
                {SEMANTIC_OCCLUSION_MAP, MAPS_OCCLUSION_READ, 0},
                {SEMANTIC_EMISSION_MAP, MAPS_EMISSION, MAPS_EMISSION_FACTOR}};
    unsigned bits = r->contract->maps.encoded ? MAPS_ENCODED : MAPS_LINEAR;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        bits |= r->maps & map_bit(rows[i].map) ? rows[i].read : 0;
        bits |= r->factors & map_bit(rows[i].map) ? rows[i].factor : 0;
    }
    bits |= bits & MAPS_OCCLUSION_READ && r->contract->terms & TERM_AMBIENT ? MAPS_OCCLUSION : 0;
    bits |= r->has_tangents ? MAPS_TANGENTS : 0;
    bits |= r->supports & NEED_TANGENT_SIGN ? MAPS_SIGN : 0;
    bits |= declarations_uses(&r->fragment, "dFdx") ? MAPS_DERIVATIVES : 0;
    bits |= r->contract->maps.v_down ? MAPS_DOWN : MAPS_UP;
    return bits | (bits & MAPS_BASE ? 0 : MAPS_NO_BASE) | (bits & MAPS_OCCLUSION_READ ? 0 : MAPS_NO_OCCLUSION);
}

bool fault_applies(const struct fault *fault, const struct shader_interface *interface, lam_light_frame frame,
                   lam_reflection reflection, unsigned needs)
{
    bool reflects =
        declarations_uses(&interface->vertex, "reflect") || declarations_uses(&interface->fragment, "reflect");
    unsigned here = (interface->vertex_lit ? WHERE_VERTEX : WHERE_FRAGMENT) |
                    (frame == LAM_FRAME_OBJECT              ? WHERE_OBJECT_LIGHT
                     : frame == interface->space            ? WHERE_EYE_LIGHT
                     : interface->space == LAM_FRAME_CAMERA ? WHERE_WORLD_LIGHT
                                                            : 0u) |
                    (interface->space == LAM_FRAME_WORLD ? WHERE_WORLD : 0) |
                    (reflection == LAM_REFLECTION_PHONG ? WHERE_PHONG : WHERE_BLINN) | (reflects ? WHERE_REFLECT : 0) |
                    (declarations_uses(&interface->fragment, "flat") ? WHERE_FLAT : 0) |
                    (interface->contract->material_strengths ? WHERE_STRENGTHS : 0) |
                    (interface->vertex_lit || hands_on_four(&interface->fragment) ? WHERE_FOUR : 0) |
                    (interface->physical ? physical_bits(&interface->contract->physical) : WHERE_CLASSIC);
    return (fault->where & ~here) == 0 && (fault->needs & ~needs) == 0 &&
           (!fault->maps || (fault->maps & ~map_bits(interface)) == 0);
}

bool fault_is_style(const struct fault *fault, const struct shader_interface *interface)
{
    return fault->style || (fault->demand && !(fault->demand & interface->contract->demands));
}

// Returns row `index` of the public list. The list contains the first form of each mistake, and no styles.
static const struct fault *listed(int index)
{
    for (int i = 0; i < fault_count; i++)
        if (!faults[i].style && (i == 0 || strcmp(faults[i].id, faults[i - 1].id) != 0) && index-- == 0)
            return &faults[i];
    return NULL;
}

const char *lam_check_mistake(int index)
{
    const struct fault *fault = index >= 0 ? listed(index) : NULL;
    return fault ? fault->id : NULL;
}

const char *lam_check_mistake_explanation(int index)
{
    const struct fault *fault = index >= 0 ? listed(index) : NULL;
    return fault ? fault->explanation : NULL;
}
