#version 330 core
// The structure of LearnOpenGL's own: functions for D, G and F, a loop over four lights, a tone curve, and gamma.
in vec2 TexCoords;
in vec3 WorldPos;
in vec3 Normal;

uniform vec3 albedo;
uniform float metallic;
uniform float roughness;
uniform float ao;
uniform vec3 lightPositions[4];
uniform vec3 lightColors[4];
uniform vec3 camPos;

out vec4 FragColor;

const float PI = 3.14159265359;

float distribution(float nh)
{
    float a = roughness * roughness;
    float a2 = a * a;
    float f = nh * nh * (a2 - 1.0) + 1.0;
    return a2 / (PI * f * f);
}

float masking(float cosine)
{
    float k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    return cosine / (cosine * (1.0 - k) + k);
}

void main()
{
    vec3 n = normalize(Normal);
    vec3 v = normalize(camPos - WorldPos);
    float nv = max(dot(n, v), 0.0);
    vec3 F0 = mix(vec3(0.04), albedo, metallic);
    vec3 Lo = vec3(0.0);
    for (int i = 0; i < 4; i++) {
        vec3 way = lightPositions[i] - WorldPos;
        vec3 l = normalize(way);
        vec3 h = normalize(l + v);
        float nl = max(dot(n, l), 0.0);
        vec3 radiance = lightColors[i] / dot(way, way);
        vec3 F = F0 + (1.0 - F0) * pow(clamp(1.0 - dot(h, v), 0.0, 1.0), 5.0);
        float G = masking(nl) * masking(nv);
        vec3 specular = distribution(max(dot(n, h), 0.0)) * G * F / (4.0 * nl * nv + 0.0001);
        vec3 kD = (vec3(1.0) - F) * (1.0 - metallic);
        Lo += (kD * albedo / PI + specular) * radiance * nl;
    }
    vec3 color = vec3(0.03) * albedo * ao + Lo;
    color = color / (color + vec3(1.0));
    color = pow(color, vec3(1.0 / 2.2));
    FragColor = vec4(color, 1.0);
}
