#version 330
// The names of CC3501 (University of Chile): vertex colours, and lights of two kinds.
in vec3 position;
in vec3 normal;
in vec3 color;

uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;

out vec3 fragPosition;
out vec3 fragNormal;
out vec3 fragColorOfVertex;

void main()
{
    vec4 point = model * vec4(position, 1.0);
    fragPosition = point.xyz;
    fragNormal = normalize(mat3(transpose(inverse(model))) * normal);
    fragColorOfVertex = color;
    gl_Position = projection * view * point;
}
