#version 120
// With the mistakes that the Pittsburgh lecture prints: lighting after the projection, a name that is not declared.
attribute vec4 vPosition;
attribute vec4 vNormal;

uniform mat4 model_view;
uniform mat4 projection;
uniform vec4 light_position;
uniform vec4 eye_point;

varying vec4 N;
varying vec4 L;
varying vec4 V;
varying float distance;

void main()
{
    mat4 both = projection * model_view;
    N = both * vNormal;
    L = both * (light_position - vPosition);
    V = eye_position - both * vPosition;
    distance = length(L);
    gl_position = both * vPosition;
}
