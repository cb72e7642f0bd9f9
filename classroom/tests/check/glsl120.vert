#version 120
// The lights and materials of OpenGL's fixed state.
varying vec3 normal;
varying vec3 point;

void main()
{
    point = (gl_ModelViewMatrix * gl_Vertex).xyz;
    normal = normalize(gl_NormalMatrix * gl_Normal);
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
