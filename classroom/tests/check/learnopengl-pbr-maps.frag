#version 330 core
// As learnopengl-pbr.frag, with a map for each number, and the frame of the normal map from derivatives.
in vec3 WorldPos;
in vec3 Normal;
in vec2 TexCoords;

uniform sampler2D albedoMap;
uniform sampler2D normalMap;
uniform sampler2D metallicMap;
uniform sampler2D roughnessMap;
uniform sampler2D aoMap;
uniform vec3 lightPositions[4];
uniform vec3 lightColors[4];
uniform vec3 camPos;

out vec4 FragColor;

const float PI = 3.14159265359;

vec3 bentNormal()
{
    vec3 bump = texture(normalMap, TexCoords).xyz * 2.0 - 1.0;
    vec3 px = dFdx(WorldPos);
    vec3 py = dFdy(WorldPos);
    vec2 ux = dFdx(TexCoords);
    vec2 uy = dFdy(TexCoords);
    vec3 N = normalize(Normal);
    vec3 T = normalize(px * uy.t - py * ux.t);
    vec3 B = -normalize(cross(N, T));
    return normalize(mat3(T, B, N) * bump);
}

float masking(float cosine, float roughness)
{
    float k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    return cosine / (cosine * (1.0 - k) + k);
}

void main()
{
    vec3 albedo = pow(texture(albedoMap, TexCoords).rgb, vec3(2.2));
    float metallic = texture(metallicMap, TexCoords).r;
    float roughness = texture(roughnessMap, TexCoords).r;
    float ao = texture(aoMap, TexCoords).r;
    vec3 n = bentNormal();
    vec3 v = normalize(camPos - WorldPos);
    float nv = max(dot(n, v), 0.0);
    float a2 = roughness * roughness * roughness * roughness;
    vec3 F0 = mix(vec3(0.04), albedo, metallic);
    vec3 Lo = vec3(0.0);
    for (int i = 0; i < 4; i++) {
        vec3 way = lightPositions[i] - WorldPos;
        vec3 l = normalize(way);
        vec3 h = normalize(l + v);
        float nl = max(dot(n, l), 0.0);
        float nh = max(dot(n, h), 0.0);
        vec3 radiance = lightColors[i] / dot(way, way);
        float f = nh * nh * (a2 - 1.0) + 1.0;
        vec3 F = F0 + (1.0 - F0) * pow(clamp(1.0 - dot(h, v), 0.0, 1.0), 5.0);
        float G = masking(nl, roughness) * masking(nv, roughness);
        vec3 specular = a2 / (PI * f * f) * G * F / (4.0 * nl * nv + 0.0001);
        vec3 kD = (vec3(1.0) - F) * (1.0 - metallic);
        Lo += (kD * albedo / PI + specular) * radiance * nl;
    }
    vec3 color = vec3(0.03) * albedo * ao + Lo;
    color = color / (color + vec3(1.0));
    color = pow(color, vec3(1.0 / 2.2));
    FragColor = vec4(color, 1.0);
}
