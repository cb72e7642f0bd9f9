#version 300 es
precision highp float;

#define LIGHT_COUNT 3

struct Light {
    vec3 direction;
    float range;
    vec3 color;
    float intensity;
    vec3 position;
    float innerConeCos;
    float outerConeCos;
    int type;
};

const int LIGHT_DIRECTIONAL = 0;
const int LIGHT_POINT = 1;
const int LIGHT_SPOT = 2;
const float M_PI = 3.141592653589793;

uniform Light u_Lights[LIGHT_COUNT];
uniform vec4 u_BaseColorFactor;
uniform float u_MetallicFactor;
uniform float u_RoughnessFactor;
uniform vec3 u_Camera;

in vec3 v_Position;
in vec3 v_Normal;
out vec4 g_finalColor;

float attenuation(Light light, float d)
{
    float window = light.range > 0.0 ? clamp(1.0 - pow(d / light.range, 4.0), 0.0, 1.0) : 1.0;
    return window / (d * d);
}

float cone(Light light, vec3 toLight)
{
    float c = dot(normalize(light.direction), -toLight);
    float x = clamp((c - light.outerConeCos) / max(light.innerConeCos - light.outerConeCos, 1e-6), 0.0, 1.0);
    return x * x;
}

float visibility(float nl, float nv, float a2)
{
    float l = nl * sqrt(nv * nv * (1.0 - a2) + a2);
    float v = nv * sqrt(nl * nl * (1.0 - a2) + a2);
    return l + v > 0.0 ? 0.5 / (l + v) : 0.0;
}

float distribution(float nh, float a2)
{
    float f = (nh * a2 - nh) * nh + 1.0;
    return a2 / (M_PI * f * f);
}

void main()
{
    vec3 n = normalize(v_Normal);
    vec3 v = normalize(u_Camera - v_Position);
    float nv = abs(dot(n, v));
    float alpha = u_RoughnessFactor * u_RoughnessFactor;
    float a2 = alpha * alpha;
    vec3 color = vec3(0.0);
    for (int i = 0; i < LIGHT_COUNT; i++) {
        Light light = u_Lights[i];
        vec3 way = light.type == LIGHT_DIRECTIONAL ? -light.direction : light.position - v_Position;
        vec3 l = normalize(way);
        vec3 h = normalize(l + v);
        float nl = max(dot(n, l), 0.0);
        vec3 arriving = light.color * light.intensity;
        if (light.type != LIGHT_DIRECTIONAL)
            arriving *= attenuation(light, length(way));
        if (light.type == LIGHT_SPOT)
            arriving *= cone(light, l);
        float power = pow(clamp(1.0 - dot(h, v), 0.0, 1.0), 5.0);
        float shine = nl > 0.0 ? visibility(nl, nv, a2) * distribution(max(dot(n, h), 0.0), a2) : 0.0;
        vec3 dielectric = mix(u_BaseColorFactor.rgb / M_PI, vec3(shine), mix(0.04, 1.0, power));
        vec3 metal = shine * mix(u_BaseColorFactor.rgb, vec3(1.0), power);
        color += arriving * nl * mix(dielectric, metal, u_MetallicFactor);
    }
    g_finalColor = vec4(pow(color, vec3(1.0 / 2.2)), u_BaseColorFactor.a);
}
