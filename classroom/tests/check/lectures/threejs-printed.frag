uniform vec3 lightPosition;
uniform vec3 lightColor;
uniform vec3 uColor;

varying vec3 vNormal;
varying vec3 vWorldPosition;

void main()
{
    vec3 n = normalize(vNormal);
    vec3 l = normalize(lightPosition - vWorldPosition);
    vec3 v = normalize(cameraPosition - vWorldPosition);
    float diffuse = max(dot(n, l), 0.0);
    float specular = pow(max(dot(n, normalize(l + v)), 0.0), 32.0);
    gl_FragColor = vec4(lightColor * (uColor * diffuse + specular), 1.0);
}
