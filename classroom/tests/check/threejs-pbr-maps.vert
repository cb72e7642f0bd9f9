// As threejs-pbr.vert, with the frame of a normal map.
attribute vec4 tangent;

varying vec3 vWorldPosition;
varying vec3 vWorldNormal;
varying vec3 vWorldTangent;
varying vec3 vWorldBitangent;
varying vec2 vUv;

void main()
{
    vec4 world = modelMatrix * vec4(position, 1.0);
    vWorldPosition = world.xyz;
    vWorldNormal = normalize(transpose(inverse(mat3(modelMatrix))) * normal);
    vWorldTangent = normalize(mat3(modelMatrix) * tangent.xyz);
    vWorldBitangent = cross(vWorldNormal, vWorldTangent) * tangent.w;
    vUv = uv;
    gl_Position = projectionMatrix * viewMatrix * world;
}
