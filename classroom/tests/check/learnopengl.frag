#version 330 core
// LearnOpenGL's names of the first lesson: one colour of the surface, one of the light, strengths as numbers.
uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 lightColor;
uniform vec3 objectColor;

in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;

void main()
{
    float ambientStrength = 0.1;
    float specularStrength = 0.5;
    vec3 n = normalize(Normal);
    vec3 l = normalize(lightPos - FragPos);
    vec3 v = normalize(viewPos - FragPos);
    vec3 r = reflect(-l, n);
    float diffuse = max(dot(n, l), 0.0);
    float specular = diffuse > 0.0 ? pow(max(dot(v, r), 0.0), 32.0) : 0.0;
    FragColor = vec4((ambientStrength + diffuse + specularStrength * specular) * lightColor * objectColor, 1.0);
}
