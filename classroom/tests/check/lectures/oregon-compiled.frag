#version 330 compatibility
// The same with its declarations mended, so that it compiles.
uniform float uKa, uKd, uKs;
uniform vec3 uColor, uSpecularColor;
uniform float uShininess;
uniform bool uFlat;

flat in vec3 vNf, vLf, vEf;
in vec3 vNs;
in vec3 vLs;
in vec3 vEs;

void main()
{
    vec3 n = normalize(uFlat ? vNf : vNs);
    vec3 l = normalize(uFlat ? vLf : vLs);
    vec3 e = normalize(uFlat ? vEf : vEs);
    vec3 diffuse = max(dot(n, l), 0.0) * uColor;
    vec3 r = normalize(reflect(-l, n));
    float s = pow(max(dot(e, r), 0.0), uShininess);
    gl_FragColor = vec4(uKa * uColor + uKd * diffuse + uKs * s * uSpecularColor, 1.0);
}
