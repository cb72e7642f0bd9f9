#version 330 core
// As learnopengl-pbr.vert, with texture coordinates.
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aTexCoords;

uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat3 normalMatrix;

out vec3 WorldPos;
out vec3 Normal;
out vec2 TexCoords;

void main()
{
    WorldPos = vec3(model * vec4(aPos, 1.0));
    Normal = normalize(normalMatrix * aNormal);
    TexCoords = aTexCoords;
    gl_Position = projection * view * vec4(WorldPos, 1.0);
}
