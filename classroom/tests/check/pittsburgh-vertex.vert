// Lit per vertex, with the Pittsburgh contract's names, without a version line.
attribute vec4 vPosition;
attribute vec4 vNormal;

uniform mat4 model_view;
uniform mat4 projection;
uniform mat3 normal_matrix;
uniform vec4 light_position;
uniform vec4 ambient_product, diffuse_product, specular_product;
uniform float shininess, attenuation_constant, attenuation_linear, attenuation_quadratic;

varying vec4 color;

void main()
{
    vec4 point = model_view * vPosition;
    vec3 n = normalize(normal_matrix * vNormal.xyz);
    vec4 light = model_view * light_position;
    vec3 way = light.w == 0.0 ? light.xyz : light.xyz - point.xyz;
    vec3 l = normalize(way);
    vec3 v = normalize(-point.xyz);
    vec3 h = normalize(l + v);
    float d = length(way);
    float attenuation = 1.0 / (attenuation_constant + attenuation_linear * d + attenuation_quadratic * d * d);
    float s = dot(n, l) > 0.0 ? pow(max(dot(n, h), 0.0), shininess) : 0.0;
    color = ambient_product + attenuation * (diffuse_product * max(dot(n, l), 0.0) + specular_product * s);
    color.a = diffuse_product.a;
    gl_Position = projection * point;
}
