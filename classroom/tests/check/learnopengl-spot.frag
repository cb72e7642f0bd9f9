#version 330 core
// LearnOpenGL's names of a spot, with textures in place of the material's colours.
struct Material {
    sampler2D diffuse;
    sampler2D specular;
    float shininess;
};
struct Light {
    vec3 position;
    vec3 direction;
    float cutOff;
    float outerCutOff;
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
    vec2 uv = vec2(0.5);
    vec3 kd = texture(material.diffuse, uv).rgb;
    vec3 ks = texture(material.specular, uv).rgb;
    vec3 n = normalize(Normal);
    vec3 way = light.position - FragPos;
    vec3 l = normalize(way);
    float nl = max(dot(n, l), 0.0);
    float s = nl > 0.0 ? pow(max(dot(normalize(viewPos - FragPos), reflect(-l, n)), 0.0), material.shininess) : 0.0;
    float theta = dot(l, normalize(-light.direction));
    float intensity = clamp((theta - light.outerCutOff) / (light.cutOff - light.outerCutOff), 0.0, 1.0);
    float d = length(way);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * (d * d));
    vec3 lit = light.diffuse * nl * kd + light.specular * s * ks;
    FragColor = vec4(light.ambient * kd + attenuation * intensity * lit, 1.0);
}
