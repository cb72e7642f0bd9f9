// refraction.h: the effect of a transmitting surface on the picture behind it. The formulas are from the implementation
// notes of KHR_materials_transmission, KHR_materials_volume and KHR_materials_ior; three.js and the Khronos sample
// viewer use the same formulas. C only: OpenGL rejects rough and thick glass.
#ifndef REFRACTION_H
#define REFRACTION_H

// Returns the direction of a ray from the eye after refraction (Snell). v is the unit direction to the eye, and n is
// the unit normal on the eye's side. The index of refraction is at least 1.
FN vec3 refracted3(vec3 v, vec3 n, num ior)
{
    num inverse = 1.0f / ior, c = positive(cosine(dot3(v, n)));
    num inside = square_root(positive(1.0f - (1.0f - c * c) * (inverse * inverse)));
    return unit3(sub3(scale3(n, c * inverse - inside), scale3(v, inverse)));
}

// Returns the width over which a surface blurs the picture behind it, as a fraction of the picture's height: 1024^(r −
// 1) with r = roughness · min(2 ior − 2, 1), at most 1/8. In a picture 1024 pixels high, this width is one texel of
// mipmap level r log2(1024), which three.js reads. The limit is reached at r = 0.7. Without the limit, the roughest
// glass would show the mean colour of the whole picture, including the background. Returns 0 for r = 0.
FN num transmission_blur(num roughness, num ior)
{
    num r = roughness * min_of(positive(2.0f * ior - 2.0f), num_of(1.0f));
    return pick(r > 0.0f, exp2_of(min_of(10.0f * r - 10.0f, num_of(-3.0f))), num_of(0.0f));
}

#endif
