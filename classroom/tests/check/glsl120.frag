#version 120
varying vec3 normal;
varying vec3 point;

void main()
{
    vec3 n = normalize(normal);
    vec3 l = normalize(gl_LightSource[0].position.xyz - point);
    vec3 h = normalize(l + normalize(-point));
    float d = max(dot(n, l), 0.0);
    float s = d > 0.0 ? pow(max(dot(n, h), 0.0), gl_FrontMaterial.shininess) : 0.0;
    vec4 color = gl_FrontLightModelProduct.sceneColor + gl_FrontLightProduct[0].ambient + d * gl_FrontLightProduct[0].diffuse +
                 s * gl_FrontLightProduct[0].specular;
    gl_FragColor = vec4(color.rgb, 1.0);
}
