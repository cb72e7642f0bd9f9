#version 330 core
// The contract of `lambent shader`, written by hand.
in vec3 position;
in vec3 normal;

uniform mat4 model_view;
uniform mat4 model_view_projection;
uniform mat3 normal_matrix;

out vec3 eye_position;
out vec3 eye_normal;

void main()
{
    eye_position = (model_view * vec4(position, 1.0)).xyz;
    eye_normal = normalize(normal_matrix * normal);
    gl_Position = model_view_projection * vec4(position, 1.0);
}
