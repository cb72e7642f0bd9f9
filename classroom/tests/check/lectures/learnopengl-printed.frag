#version 330 core
// As LearnOpenGL prints it: the highlight has no gate.
uniform vec3 lightPos, viewPos, lightColor, objectColor;

in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;

void main()
{
    float ambientStrength = 0.1;
    float specularStrength = 0.5;
    vec3 norm = normalize(Normal);
    vec3 lightDir = normalize(lightPos - FragPos);
    vec3 viewDir = normalize(viewPos - FragPos);
    vec3 reflectDir = reflect(-lightDir, norm);
    float diff = max(dot(norm, lightDir), 0.0);
    float spec = pow(max(dot(viewDir, reflectDir), 0.0), 32.0);
    vec3 sum = (ambientStrength + diff + specularStrength * spec) * lightColor;
    FragColor = vec4(sum * objectColor, 1.0);
}
