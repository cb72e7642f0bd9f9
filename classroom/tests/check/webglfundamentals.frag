precision highp float;

varying vec3 v_normal;
varying vec3 v_surfaceToLight;
varying vec3 v_surfaceToView;

uniform vec4 u_color;
uniform vec3 u_lightColor;
uniform vec3 u_specularColor;
uniform float u_shininess;

void main()
{
    vec3 n = normalize(v_normal);
    vec3 l = normalize(v_surfaceToLight);
    vec3 h = normalize(l + normalize(v_surfaceToView));
    float d = max(dot(n, l), 0.0);
    float s = d > 0.0 ? pow(max(dot(n, h), 0.0), u_shininess) : 0.0;
    gl_FragColor = vec4(u_color.rgb * d * u_lightColor + s * u_specularColor, u_color.a);
}
