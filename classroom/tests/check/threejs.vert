// A ShaderMaterial of three.js, lit in world space; three.js declares the attributes and matrices.
varying vec3 vWorldPosition;
varying vec3 vWorldNormal;

void main()
{
    vec4 point = modelMatrix * vec4(position, 1.0);
    vWorldPosition = point.xyz;
    vWorldNormal = normalize(transpose(inverse(mat3(modelMatrix))) * normal);
    gl_Position = projectionMatrix * viewMatrix * point;
}
