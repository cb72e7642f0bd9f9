#version 120
uniform mat4 ambient_product, diffuse_product, specular_product;
uniform float shininess;
uniform float attenuation_constant, attenuation_linear, attenuation_quadratic;

varying vec4 N;
varying vec4 L;
varying vec4 V;
varying float distance;

main()
{
    vec4 n = normalize(N);
    vec4 l = normalize(L);
    vec4 half = normalize(l + normalize(V));
    float attenuation = 1.0 / (attenuation_constant + attenuation_linear * distance + attenuation_quadratic * distance * distance);
    vec4 diffuse = diffuse_product * max(dot(n, l), 0.0);
    vec4 specular = specular_product * pow(max(dot(n, half), 0.0), shininess);
    gl_FragColor = ambient_product + attenuation * (diffuse + specular);
}
