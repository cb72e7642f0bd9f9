uniform vec3 lightPosition;
uniform vec3 lightColor;
uniform vec3 ambientLightColor;
uniform vec3 diffuse;
uniform vec3 specular;
uniform float shininess;

varying vec3 vWorldPosition;
varying vec3 vWorldNormal;

void main()
{
    vec3 n = normalize(vWorldNormal);
    vec3 l = normalize(lightPosition - vWorldPosition);
    vec3 v = normalize(cameraPosition - vWorldPosition);
    vec3 h = normalize(l + v);
    float d = max(dot(n, l), 0.0);
    float s = d > 0.0 ? pow(max(dot(n, h), 0.0), shininess) : 0.0;
    gl_FragColor = vec4(ambientLightColor * diffuse + lightColor * (diffuse * d + specular * s), 1.0);
}
