// Angel's names, lit per vertex, in the form for WebGL.
attribute vec4 aPosition;
attribute vec3 aNormal;

uniform mat4 uModelViewMatrix, uProjectionMatrix;
uniform mat3 uNormalMatrix;
uniform vec4 uLightPosition, uAmbientProduct, uDiffuseProduct, uSpecularProduct;
uniform float uShininess;

varying vec4 vColor;

void main()
{
    vec3 pos = (uModelViewMatrix * aPosition).xyz;
    vec3 L = normalize(uLightPosition.w == 0.0 ? uLightPosition.xyz : uLightPosition.xyz - pos);
    vec3 N = normalize(uNormalMatrix * aNormal);
    vec3 H = normalize(L - normalize(pos));
    float d = max(dot(L, N), 0.0);
    float s = d > 0.0 ? pow(max(dot(N, H), 0.0), uShininess) : 0.0;
    vColor = uAmbientProduct + d * uDiffuseProduct + s * uSpecularProduct;
    vColor.a = 1.0;
    gl_Position = uProjectionMatrix * vec4(pos, 1.0);
}
