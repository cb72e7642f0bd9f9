uniform vec3 color;
uniform float metalness;
uniform float roughness;
uniform sampler2D map;
uniform sampler2D metalnessMap;
uniform sampler2D roughnessMap;
uniform sampler2D normalMap;
uniform vec2 normalScale;
uniform vec3 lightPosition;
uniform vec3 lightColor;

varying vec3 vWorldPosition;
varying vec3 vWorldNormal;
varying vec3 vWorldTangent;
varying vec3 vWorldBitangent;
varying vec2 vUv;

const float RECIPROCAL_PI = 0.3183098861837907;

void main()
{
    vec3 base = color * texture2D(map, vUv).rgb;
    float metal = metalness * texture2D(metalnessMap, vUv).b;
    float rough = roughness * texture2D(roughnessMap, vUv).g;
    vec3 bump = texture2D(normalMap, vUv).xyz * 2.0 - 1.0;
    bump.xy *= normalScale;
    vec3 n = normalize(mat3(normalize(vWorldTangent), normalize(vWorldBitangent), normalize(vWorldNormal)) * bump);
    vec3 v = normalize(cameraPosition - vWorldPosition);
    vec3 l = normalize(lightPosition - vWorldPosition);
    vec3 h = normalize(l + v);
    float dotNL = clamp(dot(n, l), 0.0, 1.0), dotNV = abs(dot(n, v));
    float dotNH = clamp(dot(n, h), 0.0, 1.0), dotVH = clamp(dot(v, h), 0.0, 1.0);
    float alpha = rough * rough, a2 = alpha * alpha;
    float f = dotNH * dotNH * (a2 - 1.0) + 1.0;
    float D = RECIPROCAL_PI * a2 / (f * f);
    float V = 0.5 / max(dotNL * sqrt(a2 + (1.0 - a2) * dotNV * dotNV) + dotNV * sqrt(a2 + (1.0 - a2) * dotNL * dotNL), 1e-6);
    vec3 f0 = mix(vec3(0.04), base, metal);
    vec3 F = f0 + (1.0 - f0) * pow(1.0 - dotVH, 5.0);
    vec3 diffuse = base * (1.0 - metal) * RECIPROCAL_PI;
    gl_FragColor = vec4(lightColor * dotNL * (diffuse + F * (V * D)), 1.0);
}
