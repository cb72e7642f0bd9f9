precision highp float;
struct PointLight {
    vec3 position;
    vec3 color;
};
uniform PointLight pointLights[2];
uniform vec3 ambientLightColor;
uniform vec3 uColor;

varying vec3 vNormal;
varying vec3 vViewPosition;

void main()
{
    vec3 n = normalize(vNormal);
    vec3 sum = ambientLightColor;
    for (int i = 0; i < 2; i++)
        sum += pointLights[i].color * max(dot(n, normalize(pointLights[i].position + vViewPosition)), 0.0);
    gl_FragColor = vec4(sum * uColor, 1.0);
}
