#version 330 core
// The Pittsburgh contract in the core profile: a uniform block, precision qualifiers, an output location.
precision highp float;
layout(location = 0) out vec4 frag_color;
uniform vec4 ambient_product, diffuse_product, specular_product;
uniform float shininess;
uniform float attenuation_constant, attenuation_linear, attenuation_quadratic;
in Surface { vec3 normal; vec3 point; vec4 light; } surface;
void main() {
    vec3 toLight = surface.light.xyz - (surface.light.w != 0.0 ? surface.point : vec3(0));
    float dist = length(toLight);
    vec3 l = toLight / dist, v = -normalize(surface.point), n = normalize(surface.normal), h = normalize(l + v);
    float kd = max(0.0, dot(l, n));
    float ks = 0.0;
    if (kd > 0.0) ks = pow(max(0.0, dot(n, h)), shininess);
    float att = 1.0 / (attenuation_constant + attenuation_linear * dist + attenuation_quadratic * pow(dist, 2.0));
    frag_color.rgb = ambient_product.rgb + att * (kd * diffuse_product.rgb + ks * specular_product.rgb);
    frag_color.a = diffuse_product.a;
}
