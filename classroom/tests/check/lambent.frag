#version 330 core
struct Light {
    vec4 position;
    vec4 direction;
    vec4 attenuation;
    vec4 cone;
    vec4 diffuse;
    vec4 specular;
};
struct Material {
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
    float shininess;
};
uniform Light lights[3];
uniform Material material;
uniform vec4 ambient_light;

in vec3 eye_position;
in vec3 eye_normal;
out vec4 pixel;

void main()
{
    vec3 n = gl_FrontFacing ? normalize(eye_normal) : -normalize(eye_normal);
    vec3 v = normalize(-eye_position);
    vec3 color = material.ambient.rgb * ambient_light.rgb;
    for (int i = 0; i < 3; i++) {
        vec3 way = lights[i].position.xyz - eye_position;
        vec3 l = normalize(way);
        float distance = length(way);
        vec4 a = lights[i].attenuation;
        float attenuation = 1.0 / (a.x + a.y * distance + a.z * distance * distance);
        float c = dot(-l, lights[i].direction.xyz);
        float spot = 1.0;
        if (lights[i].cone.x > -1.0)
            spot = c >= lights[i].cone.x ? pow(max(c, 0.0), lights[i].cone.y) : 0.0;
        vec3 h = normalize(l + v);
        float s = dot(n, l) > 0.0 ? pow(max(dot(n, h), 0.0), material.shininess) : 0.0;
        vec3 diffuse = material.diffuse.rgb * lights[i].diffuse.rgb * max(dot(n, l), 0.0);
        vec3 specular = material.specular.rgb * lights[i].specular.rgb * s;
        color += attenuation * spot * (diffuse + specular);
    }
    pixel = vec4(color, material.diffuse.a);
}
