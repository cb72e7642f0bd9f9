#version 330 compatibility
// Oregon's contract: flat and smooth values side by side.
uniform float uLightX, uLightY, uLightZ;

flat out vec3 vNf, vLf, vEf;
out vec3 vNs, vLs, vEs;

void main()
{
    vec3 point = (gl_ModelViewMatrix * gl_Vertex).xyz;
    vNs = normalize(gl_NormalMatrix * gl_Normal);
    vLs = vec3(uLightX, uLightY, uLightZ) - point;
    vEs = -point;
    vNf = vNs;
    vLf = vLs;
    vEf = vEs;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
