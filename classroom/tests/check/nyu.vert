#version 120
// NYU's contract, a list of point lights.
attribute vec4 position;
attribute vec4 normal;

uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat4 normalMatrix;

varying vec3 varyingNormal;
varying vec3 varyingPosition;

void main()
{
    vec4 point = modelViewMatrix * position;
    varyingPosition = point.xyz;
    varyingNormal = normalize((normalMatrix * normal).xyz);
    gl_Position = projectionMatrix * point;
}
