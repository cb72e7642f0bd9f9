#version 120
varying vec3 N;
varying vec3 L;
varying vec3 V;

uniform vec4 ambient_product;
uniform vec4 diffuse_product;
uniform vec4 specular_product;
uniform float shininess;
uniform float attenuation_constant;
uniform float attenuation_linear;
uniform float attenuation_quadratic;

void main()
{
    vec3 n = normalize(N);
    vec3 l = normalize(L);
    vec3 v = normalize(V);
    vec3 h = normalize(l + v);
    float d = length(L);
    float attenuation = 1.0 / (attenuation_constant + attenuation_linear * d + attenuation_quadratic * d * d);
    vec4 ambient = ambient_product;
    vec4 diffuse = diffuse_product * max(dot(n, l), 0.0);
    vec4 specular = specular_product * pow(max(dot(n, h), 0.0), shininess);
    if (dot(n, l) <= 0.0)
        specular = vec4(0.0);
    vec4 color = ambient + attenuation * (diffuse + specular);
    gl_FragColor = vec4(color.rgb, diffuse_product.a);
}
