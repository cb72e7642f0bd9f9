#version 330 core
// LearnOpenGL's names of several lights of three kinds.
#define NR_POINT_LIGHTS 4
struct Material {
    vec3 ambient;
    vec3 diffuse;
    vec3 specular;
    float shininess;
};
struct DirLight {
    vec3 direction;
    vec3 ambient, diffuse, specular;
};
struct PointLight {
    vec3 position;
    vec3 ambient, diffuse, specular;
    float constant, linear, quadratic;
};
struct SpotLight {
    vec3 position;
    vec3 direction;
    float cutOff, outerCutOff;
    vec3 ambient, diffuse, specular;
    float constant, linear, quadratic;
};
uniform Material material;
uniform DirLight dirLight;
uniform PointLight pointLights[NR_POINT_LIGHTS];
uniform SpotLight spotLight;
uniform vec3 viewPos;

in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;

vec3 lit(vec3 n, vec3 l, vec3 v, vec3 diffuse, vec3 specular)
{
    float nl = max(dot(n, l), 0.0);
    float s = nl > 0.0 ? pow(max(dot(v, reflect(-l, n)), 0.0), material.shininess) : 0.0;
    return diffuse * nl * material.diffuse + specular * s * material.specular;
}

float weakened(float d, float constant, float linear, float quadratic)
{
    return 1.0 / (constant + linear * d + quadratic * d * d);
}

vec3 CalcDirLight(DirLight light, vec3 n, vec3 v)
{
    return light.ambient * material.ambient + lit(n, normalize(-light.direction), v, light.diffuse, light.specular);
}

vec3 CalcPointLight(PointLight light, vec3 n, vec3 v)
{
    vec3 way = light.position - FragPos;
    float attenuation = weakened(length(way), light.constant, light.linear, light.quadratic);
    return light.ambient * material.ambient + attenuation * lit(n, normalize(way), v, light.diffuse, light.specular);
}

vec3 CalcSpotLight(SpotLight light, vec3 n, vec3 v)
{
    vec3 way = light.position - FragPos, l = normalize(way);
    float attenuation = weakened(length(way), light.constant, light.linear, light.quadratic);
    float theta = dot(l, normalize(-light.direction));
    float intensity = clamp((theta - light.outerCutOff) / (light.cutOff - light.outerCutOff), 0.0, 1.0);
    return light.ambient * material.ambient + attenuation * intensity * lit(n, l, v, light.diffuse, light.specular);
}

void main()
{
    vec3 n = normalize(Normal);
    vec3 v = normalize(viewPos - FragPos);
    vec3 result = CalcDirLight(dirLight, n, v);
    for (int i = 0; i < NR_POINT_LIGHTS; i++)
        result += CalcPointLight(pointLights[i], n, v);
    result += CalcSpotLight(spotLight, n, v);
    FragColor = vec4(result, 1.0);
}
