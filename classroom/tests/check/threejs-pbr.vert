// A ShaderMaterial of three.js with metalness and roughness, lit in world space.
varying vec3 vWorldPosition;
varying vec3 vWorldNormal;

void main()
{
    vec4 world = modelMatrix * vec4(position, 1.0);
    vWorldPosition = world.xyz;
    vWorldNormal = normalize(transpose(inverse(mat3(modelMatrix))) * normal);
    gl_Position = projectionMatrix * viewMatrix * world;
}
