#version 120
// Lit per fragment, with the Pittsburgh contract's names. Correct; mistakes.py introduces mistakes.
attribute vec4 vPosition;
attribute vec4 vNormal;

uniform mat4 model_view;
uniform mat4 projection;
uniform mat3 normal_matrix;
uniform vec4 light_position;

varying vec3 N;
varying vec3 L;
varying vec3 V;

void main()
{
    vec4 point = model_view * vPosition;
    N = normalize(normal_matrix * vNormal.xyz);
    vec4 light = model_view * light_position;
    L = light.w == 0.0 ? light.xyz : light.xyz - point.xyz;
    V = -point.xyz;
    gl_Position = projection * point;
}
