#version 300 es
// As gltf.vert, with texture coordinates and the frame of the normal map.
in vec3 a_position;
in vec3 a_normal;
in vec4 a_tangent;
in vec2 a_texcoord_0;

uniform mat4 u_ModelMatrix;
uniform mat4 u_ViewProjectionMatrix;
uniform mat4 u_NormalMatrix;

out vec3 v_Position;
out vec2 v_texcoord_0;
out mat3 v_TBN;

void main()
{
    vec4 point = u_ModelMatrix * vec4(a_position, 1.0);
    vec3 N = normalize(vec3(u_NormalMatrix * vec4(a_normal, 0.0)));
    vec3 T = normalize(vec3(u_ModelMatrix * vec4(a_tangent.xyz, 0.0)));
    vec3 B = cross(N, T) * a_tangent.w;
    v_TBN = mat3(T, B, N);
    v_Position = point.xyz / point.w;
    v_texcoord_0 = a_texcoord_0;
    gl_Position = u_ViewProjectionMatrix * point;
}
