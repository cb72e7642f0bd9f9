// MDN's names: one directional light, whose colours and direction are numbers.
attribute vec4 aVertexPosition;
attribute vec3 aVertexNormal;
attribute vec2 aTextureCoord;

uniform mat4 uNormalMatrix;
uniform mat4 uModelViewMatrix;
uniform mat4 uProjectionMatrix;

varying highp vec2 vTextureCoord;
varying highp vec3 vLighting;

void main(void)
{
    gl_Position = uProjectionMatrix * uModelViewMatrix * aVertexPosition;
    vTextureCoord = aTextureCoord;
    highp vec3 ambientLight = vec3(0.3, 0.3, 0.3);
    highp vec3 directionalLightColor = vec3(1.0, 1.0, 1.0);
    highp vec3 directionalVector = normalize(vec3(0.85, 0.8, 0.75));
    highp vec3 normal = normalize((uNormalMatrix * vec4(aVertexNormal, 0.0)).xyz);
    vLighting = ambientLight + directionalLightColor * max(dot(normal, directionalVector), 0.0);
}
