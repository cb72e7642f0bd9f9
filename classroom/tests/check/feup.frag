#version 300 es
precision highp float;

uniform mat4 uMVMatrix;
uniform vec3 uLightDirection;
uniform vec4 uLightAmbient, uLightDiffuse, uLightSpecular;
uniform vec4 uMaterialAmbient, uMaterialDiffuse, uMaterialSpecular;
uniform float uShininess;

in vec3 vNormal;
in vec3 vEyeVec;
out vec4 fragColor;

void main()
{
    vec3 n = normalize(vNormal);
    vec3 l = -normalize(mat3(uMVMatrix) * uLightDirection);
    float d = max(dot(n, l), 0.0);
    float s = d > 0.0 ? pow(max(dot(reflect(-l, n), normalize(vEyeVec)), 0.0), uShininess) : 0.0;
    vec4 color = uLightAmbient * uMaterialAmbient + uLightDiffuse * uMaterialDiffuse * d + uLightSpecular * uMaterialSpecular * s;
    fragColor = vec4(color.rgb, 1.0);
}
