#version 300 es
precision highp float;

in vec3 frag_pos;
in vec3 frag_normal;

uniform vec3 light_ambient;
uniform vec3 light_position;
uniform vec3 light_color;
uniform vec3 camera_position;
uniform vec3 material_color;
uniform vec3 material_specular;
uniform float material_shininess;

out vec4 FragColor;

void main()
{
    vec3 n = normalize(frag_normal);
    vec3 l = normalize(light_position - frag_pos);
    vec3 v = normalize(camera_position - frag_pos);
    float d = max(dot(n, l), 0.0);
    float s = d > 0.0 ? pow(max(dot(reflect(-l, n), v), 0.0), material_shininess) : 0.0;
    FragColor = vec4((light_ambient + light_color * d) * material_color + light_color * material_specular * s, 1.0);
}
