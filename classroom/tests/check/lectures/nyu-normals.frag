// The same with the attenuation declared, so that it compiles.
struct Light {
    vec3 lightPosition;
    vec3 lightColor;
    vec3 specularLightColor;
};
uniform Light lights[2];
uniform vec3 uColor;

varying vec3 varyingNormal;
varying vec3 varyingPosition;

float attenuate(float d, float a, float b) { return 1.0 / (1.0 + a * d + b * d * d); }

void main()
{
    vec3 n = normalize(varyingNormal);
    vec3 diffuse = vec3(0.0);
    vec3 specular = vec3(0.0);
    vec3 v = normalize(-varyingPosition);
    for (int i = 0; i < 2; i++) {
        vec3 way = lights[i].lightPosition - varyingPosition;
        vec3 l = normalize(way);
        float attenuation = attenuate(length(way) / 5.0, 2.7, 5.0);
        diffuse += lights[i].lightColor * max(dot(n, l), 0.0) * attenuation;
        vec3 h = normalize(l + v);
        specular += lights[i].specularLightColor * pow(max(dot(n, h), 0.0), 64.0);
    }
    gl_FragColor = vec4(uColor * diffuse + specular, 1.0);
}
