// fault_light.glsl: the lighting, which is correct unless faults are switched on. Both stages of the fault shader
// include this file.
//
// is(NAME) returns whether a fault is switched on; fault.h lists the names. Vectors have four components, because some
// faults involve the fourth component; without these faults, w is 0.
//
// fault_shader.c writes the following constants before this text:
//    LAMPS, lamp_count, physical, phong_lobe
//    spots: a light may have a cone
//    products: the shader receives the material's colours multiplied by the colours of the light
//    ambient_by_light: the shader adds the ambient term of each light together with that light
//    NAME of each fault, or -1 if the fault cannot be on

struct Lamp {
    vec4 position; // in the space of the lighting, which is eye or world space; if w is 0, the direction to the light
    vec4 given;    // the value that the shader under test receives
    vec3 diffuse, specular;
    vec3 ambient;  // the light's part of the ambient term
    vec3 attenuation;
    vec4 axis; // axis of a spot, in the space of the lighting; w is 0
    vec4 cone; // cosine of the cutoff (-1 if not a spot), exponent; z and w are unused
};

uniform int fault_on[FAULT_BITS];
uniform Lamp lamps[LAMPS];
uniform vec3 ambient_light, ka, kd, ks;
uniform vec3 bare_ka, bare_kd, bare_ks; // the colours without their strengths
uniform vec3 kd_with_ks, ks_with_kd; // the diffuse colour with the specular strength, and the reverse
uniform vec3 specular_as_diffuse;
uniform vec3 tint;                   // multiplies a tinted highlight
uniform float light_capacity;        // number of lights of the shader under test
uniform float opacity, shininess;
uniform float exponent_factor, exponent_constant; // values of a wrong exponent; 0 if not used
uniform mat4 to_lighting, to_clip; // model space to lighting space, lighting space to clip space
uniform mat4 to_eye_space;         // lighting space to eye space
uniform vec4 eye_position;         // in the space of the lighting; w is 1
uniform vec4 eye_axis;             // direction from the scene to an infinitely distant eye; w is 0

bool is(int bit) { return bit >= 0 && fault_on[max(bit, 0)] != 0; }

vec4 unit4(vec4 a)
{
    float square = dot(a, a);
    return square > 0.0 ? a * inversesqrt(square) : a;
}

bool is_far(int i) { return lamps[i].position.w == 0.0; }

// Returns the vector from a point to light i, in the space of the lighting; not normalized.
vec4 to_lamp(int i, vec4 p)
{
    vec4 place = is(LIGHT_AS_GIVEN) ? lamps[i].given : lamps[i].position;
    if (is(LIGHT_TWICE)) {
        place = to_lighting * place;
    }
    if (is(LIGHT_CLIP)) {
        place = to_clip * place;
    }
    bool far = is_far(i);
    vec4 way = (far && !is(DIRECTION_AS_POINT)) || is(POINT_AS_DIRECTION) ? vec4(place.xyz, 0.0) : (is(LIGHT_PLUS_POINT) ? place + p : place - p);
    if (far && is(DIRECTION_REVERSED)) {
        way = -way;
    }
    if (!is(FOUR)) {
        way.w = 0.0;
    }
    return is(LIGHT_BACKWARDS) ? -way : way;
}

vec4 to_eye(vec4 p)
{
    if (is(VIEWER_INFINITE)) {
        return eye_axis;
    }
    vec4 eye = is(EYE_AT_ORIGIN) ? vec4(0.0, 0.0, 0.0, 1.0) : eye_position;
    vec4 way = is(FOUR) ? eye - p : vec4(eye.xyz - p.xyz, 0.0);
    return is(EYE_BACKWARDS) ? -way : way;
}

float attenuation_of(int i, float d)
{
    vec3 a = lamps[i].attenuation;
    if (is(ATTENUATION_SWAPPED)) {
        a = a.xzy;
    }
    if (is(SQUARE_FOR_D)) {
        d *= d;
    }
    if (is(DISTANCE_ONE)) {
        d = 1.0;
    }
    if (is(INVERSE_SQUARE) || is(INVERSE_DISTANCE)) {
        return 1.0 / (is(INVERSE_SQUARE) ? d * d : d);
    }
    float sum = a.x + a.y * d + a.z * d * (is(D_FOR_SQUARE) ? 1.0 : d);
    sum = is(ATTENUATION_INVERTED) ? sum : 1.0 / sum;
    return is(ATTENUATION_TWICE) ? sum * sum : sum;
}

float cone_of(int i, vec4 l)
{
    vec2 cone = lamps[i].cone.xy;
    bool spot = cone.x > -1.0 || is(EVERY_LIGHT_A_SPOT);
    if (!spots || !spot || is(NO_CONE)) {
        return 1.0;
    }
    float c = dot(-l.xyz, lamps[i].axis.xyz);
    if (is(CONE_REVERSED)) {
        c = -c;
    }
    float compared = is(CONE_BY_ACOS) || is(CONE_IN_DEGREES) ? acos(clamp(c, -1.0, 1.0)) : c;
    bool inside = is(CONE_BY_ACOS) ? compared <= cone.x : (is(CONE_IN_DEGREES) ? degrees(compared) <= cone.x : c >= cone.x);
    if (inside == is(CONE_INSIDE_OUT) && !is(NO_CUTOFF)) {
        return 0.0;
    }
    return is(NO_EXPONENT) ? 1.0 : pow(max(c, 0.0), cone.y);
}

// The values that the vertex shader passes to the fragment shader.
struct Surface {
    vec4 normal;
    vec4 light, eye;           // the points from which l and v are computed
    vec4 early_eye;            // v, normalized at the vertices
    vec4 early_light[LAMPS];   // l of each light, normalized at the vertices
    vec4 early_mirror[LAMPS];  // the half vector, or r, of each light, normalized at the vertices
    float distance[LAMPS];     // distance from the vertices to each light
    Frame frame;
};

vec4 mirrored(vec4 l, vec4 n) { return 2.0 * dot(n, l) * n - l; }

bool is_phong() { return is(OTHER_LOBE) ? !phong_lobe : phong_lobe; }

// `way` is l before normalization.
vec4 half_vector(int i, Surface s, vec4 l, vec4 way, vec4 v)
{
    vec4 h = is(EARLY_MIRROR) ? s.early_mirror[i] : (is(RAW_HALF) ? way : l) + v;
    return is(HALF_LONG) ? h : (is(HALF_MEAN) ? 0.5 * h : unit4(h));
}

// The cosine of the angle between n and the half vector, or between r and v. If a fault exchanges n and v, the other of
// the two vectors is used.
float highlight_base(int i, Surface s, vec4 n, vec4 l, vec4 way, vec4 v)
{
    if (is_phong()) {
        vec4 r = is(EARLY_MIRROR) ? unit4(s.early_mirror[i]) : mirrored(l, n);
        r = is(UNIT_REFLECTION) ? unit4(r) : r;
        return dot(is(REFLECT_SIGN) ? -r : r, is(LOBE_OF_OTHER) ? n : v);
    }
    return dot(is(LOBE_OF_OTHER) ? v : n, half_vector(i, s, l, way, v));
}

float diffuse_of(float nl)
{
    float d = max(nl, 0.0);
    if (is(NO_CLAMP)) {
        d = nl;
    } else if (is(ABSOLUTE) || is(ABSOLUTE_DIFFUSE)) {
        d = abs(nl);
    } else if (is(HALF_LAMBERT)) {
        d = 0.5 * nl + 0.5;
    }
    return is(SQUARED_DIFFUSE) ? d * d : d;
}

float specular_of(float base, float nl)
{
    float exponent = exponent_constant > 0.0 ? exponent_constant : shininess;
    exponent *= exponent_factor > 0.0 ? exponent_factor : 1.0;
    float S = base > 0.0 ? pow(base, exponent) : (exponent > 0.0 ? 0.0 : 1.0);
    if (is(ABSOLUTE)) {
        S = pow(abs(base), exponent);
    } else if (nl <= 0.0 && !is(NO_GATE)) {
        S = 0.0;
    }
    return is(SPECULAR_TIMES_D) ? S * max(nl, 0.0) : S;
}

vec3 diffuse_light(int i)
{
    if (is(WHITE_LIGHT)) {
        return vec3(physical ? 1.0 / PI : 1.0); // the shader divides by pi
    }
    return products && is(KD_KS_SWAPPED) ? lamps[i].specular : (products && is(KA_KD_SWAPPED) ? ambient_light : lamps[i].diffuse);
}

vec3 specular_light(int i)
{
    bool other = is(SPECULAR_LIGHT_AS_DIFFUSE) || (products && (is(KD_KS_SWAPPED) || is(SPECULAR_AS_DIFFUSE)));
    return other ? lamps[i].diffuse : lamps[i].specular;
}

bool is_left_out(int i)
{
    return (is(FIRST_LIGHT_ONLY) && i > 0) || (is(LAST_LIGHT_ONLY) && i < lamp_count - 1) ||
           (is(LAST_LIGHT_MISSING) && i == lamp_count - 1) || (is(FIRST_LIGHT_MISSING) && i == 0);
}

// The factor of a term that a fault adds twice or halves.
float scale_of(bool twice, bool halved) { return twice ? 2.0 : (halved ? 0.5 : 1.0); }

vec4 shade(Surface s)
{
    vec4 n = is(LONG_NORMAL) ? s.normal : unit4(s.normal);
    n = bumped(n, s.normal, s.frame);
    vec4 way_eye = is(EARLY_EYE) ? s.early_eye : to_eye(s.eye);
    vec4 v = is(LONG_EYE) ? way_eye : unit4(way_eye);
    if (is(FACE_FORWARD) && dot(n, v) < 0.0) {
        n = -n;
    }
    vec3 diffuse_color = is(KD_KS_SWAPPED) ? kd_with_ks : (is(KA_KD_SWAPPED) ? ka : (is(BARE_KD) ? bare_kd : kd));
    vec3 specular_color = is(KD_KS_SWAPPED) ? ks_with_kd : (is(SPECULAR_AS_DIFFUSE) ? specular_as_diffuse : (is(BARE_KS) ? bare_ks : ks));
    vec3 ambient_color = is(KA_KD_SWAPPED) ? kd * (products ? lamps[0].diffuse : ambient_light) : (is(BARE_KA) ? bare_ka : ka) * ambient_light;
    if (is(SPECULAR_TINTED)) {
        specular_color *= tint * (products ? lamps[0].diffuse : vec3(1.0));
    }
    vec3 ambient = vec3(0.0), diffuse = vec3(0.0), specular = vec3(0.0);
    vec3 product = vec3(1.0);
    float diffuse_alpha = 0.0, specular_alpha = 0.0, arrived = 1.0, cosines = 0.0;
    for (int i = 0; i < lamp_count; i++) {
        if (is_left_out(i)) {
            continue;
        }
        vec4 exact = to_lamp(i, s.light);
        vec4 way = is(EARLY_LIGHT) ? s.early_light[i] : exact;
        vec4 l = is(LONG_LIGHT) ? way : unit4(way);
        if (is(DIRECTION_MINUS_ORIGIN) && is_far(i)) {
            l = vec4(way.xyz * inversesqrt(dot(way.xyz, way.xyz) + 1.0), 0.0);
        }
        float d = is(MEAN_DISTANCE) ? s.distance[i] : (is(DISTANCE_KEPT) ? distance(lamps[i].position.xyz, s.light.xyz) : length(exact));
        float attenuation = attenuation_of(i, d), cone = cone_of(i, is(CONE_OF_L) ? l : unit4(exact));
        arrived = attenuation * cone;
        float nl = dot(n, l), D = diffuse_of(nl);
        cosines += D;
        ambient += lamps[i].ambient * ((is(AMBIENT_ATTENUATED) ? arrived : 1.0) * (is(AMBIENT_TIMES_D) ? D : 1.0));
        float kept_d = is(BARE_DIFFUSE) ? cone : arrived, kept_s = is(BARE_SPECULAR) ? cone : arrived;
        if (physical) {
            vec4 h = half_vector(i, s, l, way, v);
            vec3 matt, shine;
            reflect_physical(Angles(is(ABSOLUTE_DIFFUSE) ? abs(nl) : max(nl, 0.0), eye_cosine(dot(n, v)), max(dot(n, h), 0.0), clamp(dot(h, v), 0.0, 1.0), D), matt, shine);
            diffuse += diffuse_light(i) * kept_d * matt;
            specular += diffuse_light(i) * kept_s * shine;
            continue;
        }
        float S = specular_of(highlight_base(i, s, n, l, way, v), nl);
        diffuse += diffuse_light(i) * diffuse_color * (kept_d * D);
        specular += specular_light(i) * specular_color * (kept_s * S);
        if (is(LIGHTS_MULTIPLIED)) {
            product *= diffuse_light(i) * diffuse_color * (kept_d * D) + specular_light(i) * specular_color * (kept_s * S);
        }
        diffuse_alpha += kept_d * opacity * D;
        specular_alpha += kept_s * S;
    }
    vec3 sum = vec3(0.0);
    if (!is(NO_AMBIENT)) {
        bool by_light = ambient_by_light && !is(KA_KD_SWAPPED);
        sum += ambient_factor() * (by_light ? ambient : ambient_color * ((is(AMBIENT_ATTENUATED) ? arrived : 1.0) * (is(AMBIENT_EACH_LIGHT) ? light_capacity : 1.0) * (is(AMBIENT_TIMES_D) ? cosines : 1.0)));
        sum *= scale_of(is(AMBIENT_TWICE), is(AMBIENT_HALVED));
    }
    if (is(LIGHTS_MULTIPLIED)) { // lights that are missing in the scene are black
        diffuse = int(light_capacity) > lamp_count ? vec3(0.0) : product;
        specular = vec3(0.0);
    }
    float share = is(LIGHTS_AVERAGED) ? 1.0 / light_capacity : (is(LIGHTS_MEAN) ? 1.0 / float(lamp_count) : 1.0);
    if (!is(NO_DIFFUSE)) {
        sum += diffuse * (lamp_occlusion() * share * scale_of(is(DIFFUSE_TWICE), is(DIFFUSE_HALVED)));
    }
    if (!is(NO_SPECULAR)) {
        sum += specular * (lamp_occlusion() * share * scale_of(is(SPECULAR_TWICE), is(SPECULAR_HALVED)));
    }
    if (physical) {
        sum += emitted();
        sum = displayed(sum);
    } else {
        sum = toned(sum);
    }
    if (is(CHANNELS_REVERSED)) {
        sum = sum.bgr;
    } else if (is(RED_EVERYWHERE)) {
        sum = sum.rrr;
    }
    if (is(ENCODED)) {
        sum = pow(clamp(sum, 0.0, 1.0), vec3(1.0 / 2.2));
    }
    float alpha = is(ALPHA_ONE) ? 1.0 : (is(ALPHA_SUM) ? 1.0 + diffuse_alpha + specular_alpha : opacity);
    return vec4(sum, alpha);
}
