#version 330 core
// NYU's contract, one directional light, in GLSL 330 core.
uniform vec3 lightDirection;
uniform vec3 lightColor;
uniform vec3 specularLightColor;
uniform vec3 uColor;

in vec3 varyingNormal;
in vec3 varyingPosition;
out vec4 color;

void main()
{
    vec3 n = normalize(varyingNormal);
    vec3 v = normalize(-varyingPosition);
    float d = max(dot(n, lightDirection), 0.0);
    vec3 h = normalize(v + lightDirection);
    float s = d > 0.0 ? pow(max(dot(n, h), 0.0), 64.0) : 0.0;
    color = vec4(uColor * lightColor * d + specularLightColor * s, 1.0);
}
