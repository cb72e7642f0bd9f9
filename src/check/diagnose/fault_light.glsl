// fault_light.glsl: the lighting, correct where no fault is switched on. Both stages of the fault shader include it.
//
// is(NAME) returns whether a fault is switched on; fault.h lists the names. Vectors have four components, since some
// faults involve the fourth; in the others w is 0.

#define LAMPS 3

struct Lamp {
    vec4 position; // in eye space; w 0: the direction to it
    vec4 given;    // the value that the shader under test receives
    vec3 diffuse, specular;
    vec3 attenuation;
    vec4 axis; // of a spot, in eye space; w 0
    vec4 cone; // cosine of the cutoff (-1: no spot), exponent; z, w: unused
};

uniform int fault_on[FAULT_BITS];
uniform Lamp lamps[LAMPS];
uniform int lamp_count;
uniform vec3 ambient_product, kd, ks;
uniform vec3 kd_with_ks, ks_with_kd; // the colours with each other's strength
uniform vec3 specular_as_diffuse;
uniform vec3 tint;                   // multiplies a tinted highlight
uniform float light_capacity;        // of the shader under test
uniform float opacity, shininess;
uniform bool phong_lobe;
uniform mat4 model_view, projection;

bool is(int bit) { return fault_on[bit] != 0; }

vec4 unit4(vec4 a)
{
    float square = dot(a, a);
    return square > 0.0 ? a * inversesqrt(square) : a;
}

bool is_far(int i) { return lamps[i].position.w == 0.0; }

// From a point to light i, in the space of the lighting; not normalized.
vec4 to_lamp(int i, vec4 p)
{
    vec4 place = is(LIGHT_AS_GIVEN) ? lamps[i].given : lamps[i].position;
    if (is(LIGHT_TWICE)) {
        place = model_view * place;
    }
    if (is(LIGHT_CLIP)) {
        place = projection * place;
    }
    bool far = is_far(i);
    vec4 way = far && !is(DIRECTION_AS_POINT) ? vec4(place.xyz, 0.0) : place - p;
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
        return vec4(0.0, 0.0, 1.0, 0.0);
    }
    vec4 way = is(FOUR) ? vec4(0.0, 0.0, 0.0, 1.0) - p : vec4(-p.xyz, 0.0);
    return is(EYE_BACKWARDS) ? -way : way;
}

float attenuation_of(int i, float d)
{
    vec3 a = lamps[i].attenuation;
    if (is(ATTENUATION_SWAPPED)) {
        a = a.xzy;
    }
    float sum = a.x + a.y * d + a.z * d * d;
    return is(ATTENUATION_INVERTED) ? sum : 1.0 / sum;
}

float cone_of(int i, vec4 l)
{
    vec2 cone = lamps[i].cone.xy;
    if (cone.x <= -1.0 || is(NO_CONE)) {
        return 1.0;
    }
    float c = dot(-l.xyz, lamps[i].axis.xyz);
    if (c < cone.x && !is(NO_CUTOFF)) {
        return 0.0;
    }
    return is(NO_EXPONENT) ? 1.0 : pow(max(c, 0.0), cone.y);
}

// n: the interpolated normal. pl, pv: the points from which l and v are computed. early: l of each light, normalized at
// the vertices; early_eye: v likewise; distances: of the vertices.
vec4 shade(vec4 n, vec4 pl, vec4 pv, vec4 early[LAMPS], vec4 early_eye, float distances[LAMPS])
{
    if (!is(LONG_NORMAL)) {
        n = unit4(n);
    }
    vec4 way_eye = is(EARLY_EYE) ? early_eye : to_eye(pv);
    vec4 v = is(LONG_EYE) ? way_eye : unit4(way_eye);
    vec3 diffuse_color = is(KD_KS_SWAPPED) ? kd_with_ks : kd, specular_color = is(KD_KS_SWAPPED) ? ks_with_kd : ks;
    vec3 ambient_color = ambient_product;
    if (is(KA_KD_SWAPPED)) {
        ambient_color = kd;
        diffuse_color = ambient_product;
    }
    if (is(SPECULAR_TINTED)) {
        specular_color *= tint;
    }
    if (is(SPECULAR_AS_DIFFUSE)) {
        specular_color = specular_as_diffuse;
    }
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    float diffuse_alpha = 0.0, specular_alpha = 0.0, arrived = 1.0;
    for (int i = 0; i < lamp_count; i++) {
        if ((is(FIRST_LIGHT_ONLY) && i > 0) || (is(LAST_LIGHT_ONLY) && i < lamp_count - 1)) {
            continue;
        }
        vec4 exact = to_lamp(i, pl);
        vec4 way = is(EARLY_LIGHT) ? early[i] : exact;
        vec4 l = is(LONG_LIGHT) ? way : unit4(way);
        if (is(DIRECTION_MINUS_ORIGIN) && is_far(i)) {
            l = vec4(way.xyz * inversesqrt(dot(way.xyz, way.xyz) + 1.0), 0.0);
        }
        float d = is(MEAN_DISTANCE) ? distances[i] : length(exact);
        float attenuation = attenuation_of(i, d), cone = cone_of(i, unit4(exact));
        arrived = attenuation * cone;
        float nl = dot(n, l);
        float D = is(NO_CLAMP) ? nl : (is(ABSOLUTE) ? abs(nl) : max(nl, 0.0));
        bool phong = is(OTHER_LOBE) ? !phong_lobe : phong_lobe;
        float base;
        if (phong) {
            vec4 r = 2.0 * dot(n, l) * n - l;
            base = dot(is(REFLECT_SIGN) ? -r : r, v);
        } else {
            vec4 h = (is(RAW_HALF) ? way : l) + v;
            base = dot(n, is(HALF_LONG) ? h : (is(HALF_MEAN) ? 0.5 * h : unit4(h)));
        }
        float exponent = shininess * (is(SHININESS_4) ? 4.0 : (is(SHININESS_QUARTER) ? 0.25 : 1.0));
        float S = is(ABSOLUTE) ? pow(abs(base), exponent) : (base > 0.0 ? pow(base, exponent) : (exponent > 0.0 ? 0.0 : 1.0));
        if (nl <= 0.0 && !is(NO_GATE) && !is(ABSOLUTE)) {
            S = 0.0;
        }
        if (is(SPECULAR_TIMES_D)) {
            S *= max(nl, 0.0);
        }
        float kept_d = is(BARE_DIFFUSE) ? cone : arrived, kept_s = is(BARE_SPECULAR) ? cone : arrived;
        diffuse += lamps[i].diffuse * diffuse_color * (kept_d * D);
        specular += lamps[i].specular * specular_color * (kept_s * S);
        diffuse_alpha += kept_d * opacity * D;
        specular_alpha += kept_s * S;
    }
    vec3 sum = vec3(0.0);
    if (!is(NO_AMBIENT)) {
        sum += ambient_color * (is(AMBIENT_ATTENUATED) ? arrived : 1.0) * (is(AMBIENT_EACH_LIGHT) ? light_capacity : 1.0);
    }
    if (!is(NO_DIFFUSE)) {
        sum += diffuse;
    }
    if (!is(NO_SPECULAR)) {
        sum += specular;
    }
    if (is(ENCODED)) {
        sum = pow(clamp(sum, 0.0, 1.0), vec3(1.0 / 2.2));
    }
    float alpha = is(ALPHA_ONE) ? 1.0 : (is(ALPHA_SUM) ? 1.0 + diffuse_alpha + specular_alpha : opacity);
    return vec4(sum, alpha);
}
