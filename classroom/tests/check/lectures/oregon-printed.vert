#version 330 compatibility
uniform float uLightX, uLightY, uLightZ;

flat out vec3 vNf, vLf, vEf;
out vec3 vNs, vLs, vEs;

void main()
{
    vec4 point = gl_ModelViewMatrix * gl_Vertex;
    vec3 light = vec3(uLightX, uLightY, uLightZ);
    vNf = vNs = normalize(gl_NormalMatrix * gl_Normal);
    vLf = vLs = light - point.xyz;
    vEf = vEs = vec3(0.0) - point.xyz;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
