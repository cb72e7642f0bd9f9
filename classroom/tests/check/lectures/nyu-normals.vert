// The normals are normalized as vectors of three components.
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
    varyingNormal = normalize((normalMatrix * normal).xyz);
    varyingPosition = point.xyz;
    gl_Position = projectionMatrix * point;
}
