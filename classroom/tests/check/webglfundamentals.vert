// WebGL Fundamentals' names, lit in world space by a point light.
attribute vec4 a_position;
attribute vec3 a_normal;

uniform vec3 u_lightWorldPosition;
uniform vec3 u_viewWorldPosition;
uniform mat4 u_world;
uniform mat4 u_worldViewProjection;
uniform mat4 u_worldInverseTranspose;

varying vec3 v_normal;
varying vec3 v_surfaceToLight;
varying vec3 v_surfaceToView;

void main()
{
    vec3 point = (u_world * a_position).xyz;
    v_normal = normalize(mat3(u_worldInverseTranspose) * a_normal);
    v_surfaceToLight = u_lightWorldPosition - point;
    v_surfaceToView = u_viewWorldPosition - point;
    gl_Position = u_worldViewProjection * a_position;
}
