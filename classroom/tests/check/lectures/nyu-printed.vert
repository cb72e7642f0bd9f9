// With the mistakes that the NYU lecture prints: the normal is normalized with its w.
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
    varyingNormal = normalize(normalMatrix * normal).xyz;
    varyingPosition = point.xyz;
    gl_Position = projectionMatrix * point;
}
