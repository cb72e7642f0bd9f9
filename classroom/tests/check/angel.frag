#version 150
uniform vec4 AmbientProduct, DiffuseProduct, SpecularProduct;
uniform float Shininess;

in vec3 fN;
in vec3 fL;
in vec3 fE;
out vec4 fColor;

void main()
{
    vec3 N = normalize(fN);
    vec3 L = normalize(fL);
    vec3 H = normalize(L + normalize(fE));
    float d = max(dot(L, N), 0.0);
    float s = d > 0.0 ? pow(max(dot(N, H), 0.0), Shininess) : 0.0;
    vec4 color = AmbientProduct + d * DiffuseProduct + s * SpecularProduct;
    fColor = vec4(color.rgb, 1.0);
}
