#version 330 core
// LearnOpenGL's names of materials, and of a point light that becomes weaker with the distance.
struct Material {
    vec3 ambient;
    vec3 diffuse;
    vec3 specular;
    float shininess;
};
struct Light {
    vec3 position;
    vec3 ambient;
    vec3 diffuse;
    vec3 specular;
    float constant;
    float linear;
    float quadratic;
};
uniform Material material;
uniform Light light;
uniform vec3 viewPos;

in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;

void main()
{
    vec3 n = normalize(Normal);
    vec3 way = light.position - FragPos;
    vec3 l = normalize(way);
    vec3 v = normalize(viewPos - FragPos);
    float d = length(way);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    float nl = max(dot(n, l), 0.0);
    float s = nl > 0.0 ? pow(max(dot(v, reflect(-l, n)), 0.0), material.shininess) : 0.0;
    vec3 ambient = light.ambient * material.ambient;
    vec3 diffuse = light.diffuse * nl * material.diffuse;
    vec3 specular = light.specular * s * material.specular;
    FragColor = vec4(ambient + attenuation * (diffuse + specular), 1.0);
}
