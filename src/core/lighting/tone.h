// tone.h: tone curves, from linear light of any strength to linear light of a display, 0...1 (docs/lighting/tone.md).
//
// The same source is compiled as C and as GLSL (prelude_c.h, prelude.glsl). Colours have the primaries of sRGB, and no
// channel is below 0.
#pragma once

// Reinhard, Stark, Shirley and Ferwerda (2002), for each channel:
//    x / (1 + x)
FN vec3 reinhard_tone(vec3 c) { return vec3_of(c.x / (1.0f + c.x), c.y / (1.0f + c.y), c.z / (1.0f + c.z)); }

// Hill's fit of the reference and output transforms of ACES for sRGB screens (BakingLab, ACES.hlsl): convert to the
// working space, apply a rational curve, and convert back.
FN num aces_curve(num x)
{
    return (x * (x + 0.0245786f) - 0.000090537f) / (x * (0.983729f * x + 0.4329510f) + 0.238081f);
}

FN vec3 aces_tone(vec3 c)
{
    num r = aces_curve(dot3(vec3_of(num_of(0.59719f), num_of(0.35458f), num_of(0.04823f)), c));
    num g = aces_curve(dot3(vec3_of(num_of(0.07600f), num_of(0.90834f), num_of(0.01566f)), c));
    num b = aces_curve(dot3(vec3_of(num_of(0.02840f), num_of(0.13383f), num_of(0.83777f)), c));
    vec3 curved = vec3_of(r, g, b);
    return vec3_of(dot3(vec3_of(num_of(1.60475f), num_of(-0.53108f), num_of(-0.07367f)), curved),
                   dot3(vec3_of(num_of(-0.10208f), num_of(1.10813f), num_of(-0.00605f)), curved),
                   dot3(vec3_of(num_of(-0.00327f), num_of(-0.07276f), num_of(1.07602f)), curved));
}

// Sobotka's AgX (2022) with Wrensch's polynomial for its default contrast: convert to the inset primaries, take the
// logarithm from 2^-12.47393 to 2^4.026069, apply a sigmoid, convert back, and decode the curve's encoding (2.2) to
// linear light.
FN num agx_curve(num light)
{
    num x = saturate((log2_of(light) + 12.47393f) / (4.026069f + 12.47393f));
    num square = x * x;
    num fourth = square * square;
    num even = 15.5f * fourth * square + 31.96f * fourth + 0.4298f * square - 0.00232f;
    return even - (40.14f * fourth + 6.868f * square - 0.1191f) * x;
}

FN vec3 agx_tone(vec3 c)
{
    num r = agx_curve(dot3(vec3_of(num_of(0.842479062f), num_of(0.0784336f), num_of(0.0792237451f)), c));
    num g = agx_curve(dot3(vec3_of(num_of(0.0423282423f), num_of(0.878468636f), num_of(0.0791661275f)), c));
    num b = agx_curve(dot3(vec3_of(num_of(0.0423756549f), num_of(0.0784336f), num_of(0.879142974f)), c));
    vec3 curved = vec3_of(r, g, b);
    r = dot3(vec3_of(num_of(1.196879005f), num_of(-0.0980208811f), num_of(-0.0990297441f)), curved);
    g = dot3(vec3_of(num_of(-0.0528968518f), num_of(1.15190313f), num_of(-0.0989611768f)), curved);
    b = dot3(vec3_of(num_of(-0.0529716355f), num_of(-0.0980434501f), num_of(1.151073673f)), curved);
    return vec3_of(power(positive(r), num_of(2.2f)), power(positive(g), num_of(2.2f)),
                   power(positive(b), num_of(2.2f)));
}

// Khronos PBR Neutral (2024): the mirror reflection of a dielectric is subtracted, so that a base colour is reproduced
// exactly; above 0.76 the brightest channel is compressed towards 1, and the colour fades to white.
#define NEUTRAL_START        0.76f
#define NEUTRAL_DESATURATION 0.15f

FN vec3 khronos_neutral_tone(vec3 c)
{
    num least = min_of(min_of(c.x, c.y), c.z);
    num offset = pick(least < 0.08f, least - 6.25f * least * least, num_of(0.04f));
    vec3 base = sub3(c, vec3_of(offset, offset, offset));
    num peak = max_of(max_of(base.x, base.y), base.z);
    num above = max_of(peak, num_of(NEUTRAL_START));
    num pressed = 1.0f - (1.0f - NEUTRAL_START) * (1.0f - NEUTRAL_START) / (above + (1.0f - 2.0f * NEUTRAL_START));
    num fade = 1.0f - 1.0f / (NEUTRAL_DESATURATION * (above - pressed) + 1.0f);
    vec3 bright = mix3(scale3(base, pressed / above), vec3_of(pressed, pressed, pressed), fade);
    return pick3(peak < NEUTRAL_START, base, bright);
}

// Unchanged up to SOFT_START, and compressed towards 1 above, for each channel, so that strong light does not burn a
// pale colour to plain white:
//    1 - (1 - s)^2 / (x + 1 - 2 s)
#define SOFT_START 0.85f

FN num soft_curve(num x)
{
    num above = max_of(x, num_of(SOFT_START));
    num pressed = 1.0f - (1.0f - SOFT_START) * (1.0f - SOFT_START) / (above + (1.0f - 2.0f * SOFT_START));
    return pick(x < SOFT_START, x, pressed);
}

FN vec3 soft_tone(vec3 c) { return vec3_of(soft_curve(c.x), soft_curve(c.y), soft_curve(c.z)); }

// The contrast of programs that display light without encoding it: about the light itself as the encoded value. Each
// channel c becomes pivot (c / pivot)^2, which leaves the pivot as it is.
#define CONTRAST_PIVOT 0.4f

FN vec3 contrast_tone(vec3 c)
{
    return scale3(vec3_of(c.x * c.x, c.y * c.y, c.z * c.z), num_of(1.0f / CONTRAST_PIVOT));
}

// Clamps the argument of a tone curve: not below 0, not infinite.
FN num tone_limit(num x) { return min_of(positive(x), num_of(1.0e6f)); }

FN vec3 tone_input(vec3 c) { return vec3_of(tone_limit(c.x), tone_limit(c.y), tone_limit(c.z)); }

FN vec3 saturate3(vec3 c) { return vec3_of(saturate(c.x), saturate(c.y), saturate(c.z)); }

// --- C only: the GLSL text ends here (src/gpu/glsl/embed.py).

// The table of the curves: enumerator of lam_tone without LAM_TONE_, function, keyword, formula (lam_tone_formula).
// clang-format off
#define TONES(X) \
    X(REINHARD, reinhard_tone, "reinhard", "x / (1 + x)") \
    X(ACES, aces_tone, "aces", "Hill's fit of ACES, docs/lighting/tone.md") \
    X(AGX, agx_tone, "agx", "AgX, docs/lighting/tone.md") \
    X(KHRONOS_NEUTRAL, khronos_neutral_tone, "khronos-neutral", "Khronos PBR Neutral, docs/lighting/tone.md") \
    X(CONTRAST, contrast_tone, "contrast", "min(0.4 · (x / 0.4)², 1)") \
    X(SOFT, soft_tone, "soft", "min(x, 1 − 0.0225 / (max(x, 0.85) − 0.7))")
// clang-format on

// AUTO and NONE clip at 1.
LANE_FN vec3 tone_color(vec3 c, int tone)
{
    switch (tone) {
#define TONE(NAME, function, ...)                                                                                      \
    case LAM_TONE_##NAME:                                                                                              \
        return saturate3(function(tone_input(c)));
        TONES(TONE)
#undef TONE
    default:
        return saturate3(c);
    }
}
