// The Pittsburgh contract in another style: macros, helper functions, an unused uniform.
#define SAT(x) clamp(x, 0.0, 1.0)
uniform vec4 ambient_product, diffuse_product, specular_product;
uniform float shininess, attenuation_constant, attenuation_linear, attenuation_quadratic;
uniform vec3 unused_thing;
varying vec3 fN, fL, fV;
float lobe(vec3 n, vec3 l, vec3 v) { return dot(n, l) > 0.0 ? pow(SAT(dot(n, normalize(l + v))), shininess) : 0.0; }
void main() {
    vec3 n = normalize(fN), l = normalize(fL), v = normalize(fV);
    float d = length(fL), a = 1.0 / dot(vec3(attenuation_constant, attenuation_linear, attenuation_quadratic), vec3(1.0, d, d * d));
    vec3 c = ambient_product.rgb + a * (SAT(dot(n, l)) * diffuse_product.rgb + lobe(n, l, v) * specular_product.rgb);
    gl_FragColor = vec4(c, diffuse_product.a);
}
