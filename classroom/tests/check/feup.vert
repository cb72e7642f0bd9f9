#version 300 es
// The names of WebCGF (University of Porto): a directional light that the model-view matrix transforms.
in vec3 aVertexPosition;
in vec3 aVertexNormal;

uniform mat4 uMVMatrix;
uniform mat4 uPMatrix;
uniform mat4 uNMatrix;

out vec3 vNormal;
out vec3 vEyeVec;

void main()
{
    vec4 point = uMVMatrix * vec4(aVertexPosition, 1.0);
    vNormal = normalize((uNMatrix * vec4(aVertexNormal, 0.0)).xyz);
    vEyeVec = -point.xyz;
    gl_Position = uPMatrix * point;
}
