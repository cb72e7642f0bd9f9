#version 330 core
// As LearnOpenGL prints it for point lights: the ambient term is attenuated too.
struct Material {
    sampler2D diffuse;
    sampler2D specular;
    float shininess;
};
struct Light {
    vec3 position;
    vec3 ambient, diffuse, specular;
    float constant, linear, quadratic;
};
uniform Material material;
uniform Light light;
uniform vec3 viewPos;

in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;

void main()
{
    vec2 uv = vec2(0.5);
    vec3 norm = normalize(Normal);
    vec3 lightDir = normalize(light.position - FragPos);
    vec3 viewDir = normalize(viewPos - FragPos);
    float diff = max(dot(norm, lightDir), 0.0);
    float spec = pow(max(dot(viewDir, reflect(-lightDir, norm)), 0.0), material.shininess);
    float d = length(light.position - FragPos);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * (d * d));
    vec3 ambient = light.ambient * texture(material.diffuse, uv).rgb;
    vec3 diffuse = light.diffuse * diff * texture(material.diffuse, uv).rgb;
    vec3 specular = light.specular * spec * texture(material.specular, uv).rgb;
    FragColor = vec4((ambient + diffuse + specular) * attenuation, 1.0);
}
