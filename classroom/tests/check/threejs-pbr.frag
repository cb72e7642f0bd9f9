uniform vec3 color;
uniform float metalness;
uniform float roughness;
uniform vec3 lightPosition;
uniform vec3 lightColor;

varying vec3 vWorldPosition;
varying vec3 vWorldNormal;

const float RECIPROCAL_PI = 0.3183098861837907;

void main()
{
    vec3 n = normalize(vWorldNormal);
    vec3 v = normalize(cameraPosition - vWorldPosition);
    vec3 l = normalize(lightPosition - vWorldPosition);
    vec3 h = normalize(l + v);
    float dotNL = clamp(dot(n, l), 0.0, 1.0), dotNV = abs(dot(n, v));
    float dotNH = clamp(dot(n, h), 0.0, 1.0), dotVH = clamp(dot(v, h), 0.0, 1.0);
    float alpha = roughness * roughness, a2 = alpha * alpha;
    float f = dotNH * dotNH * (a2 - 1.0) + 1.0;
    float D = RECIPROCAL_PI * a2 / (f * f);
    float V = 0.5 / max(dotNL * sqrt(a2 + (1.0 - a2) * dotNV * dotNV) + dotNV * sqrt(a2 + (1.0 - a2) * dotNL * dotNL), 1e-6);
    vec3 f0 = mix(vec3(0.04), color, metalness);
    vec3 F = f0 + (1.0 - f0) * pow(1.0 - dotVH, 5.0);
    vec3 diffuse = color * (1.0 - metalness) * RECIPROCAL_PI;
    gl_FragColor = vec4(lightColor * dotNL * (diffuse + F * (V * D)), 1.0);
}
