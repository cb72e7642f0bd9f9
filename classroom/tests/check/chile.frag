#version 330
struct Material {
    vec3 ambient, diffuse, specular;
    float shininess;
};
struct PointLight {
    vec3 position;
    float constant, linear, quadratic;
    vec3 ambient, diffuse, specular;
};
uniform Material material;
uniform PointLight pointLights[1];
uniform vec3 viewPosition;

in vec3 fragPosition;
in vec3 fragNormal;
in vec3 fragColorOfVertex;
out vec4 fragColor;

void main()
{
    PointLight light = pointLights[0];
    vec3 n = normalize(fragNormal);
    vec3 way = light.position - fragPosition;
    vec3 l = normalize(way);
    vec3 v = normalize(viewPosition - fragPosition);
    float d = length(way);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    float nl = max(dot(n, l), 0.0);
    float s = nl > 0.0 ? pow(max(dot(reflect(-l, n), v), 0.0), material.shininess) : 0.0;
    vec3 lit = light.ambient + attenuation * (light.diffuse * nl + light.specular * s);
    fragColor = vec4(lit * fragColorOfVertex, 1.0);
}
