#version 300 es
// The names of Khronos' sample renderer, lit in world space.
in vec3 a_position;
in vec3 a_normal;

uniform mat4 u_ModelMatrix;
uniform mat4 u_ViewProjectionMatrix;
uniform mat4 u_NormalMatrix;

out vec3 v_Position;
out vec3 v_Normal;

void main()
{
    vec4 point = u_ModelMatrix * vec4(a_position, 1.0);
    v_Position = point.xyz / point.w;
    v_Normal = normalize(vec3(u_NormalMatrix * vec4(a_normal, 0.0)));
    gl_Position = u_ViewProjectionMatrix * point;
}
