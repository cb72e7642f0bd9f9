#version 330 compatibility
uniform float uKa, uKd, uKs;
uniform vec3 uColor, uSpecularColor;
uniform float uShininess;
uniform bool uFlat;

flat in vec3 vNf, vLf, vEf;
in vec3 vNs, vLs, vEs;

void main()
{
    vec3 n = normalize(uFlat ? vNf : vNs);
    vec3 l = normalize(uFlat ? vLf : vLs);
    vec3 e = normalize(uFlat ? vEf : vEs);
    vec3 r = reflect(-l, n);
    float d = max(dot(n, l), 0.0);
    float s = dot(n, l) > 0.0 ? pow(max(dot(r, e), 0.0), uShininess) : 0.0;
    vec3 color = uKa * uColor + uKd * d * uColor + uKs * s * uSpecularColor;
    gl_FragColor = vec4(color, 1.0);
}
