// A RawShaderMaterial of three.js, lit in eye space by three.js' own lights.
precision highp float;
attribute vec3 position;
attribute vec3 normal;

uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;

varying vec3 vNormal;
varying vec3 vViewPosition;

void main()
{
    vec4 point = modelViewMatrix * vec4(position, 1.0);
    vNormal = normalize(normalMatrix * normal);
    vViewPosition = -point.xyz;
    gl_Position = projectionMatrix * point;
}
