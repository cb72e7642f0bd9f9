#version 330 core
// The Pittsburgh contract in the core profile: attribute locations, and an interface block between the stages.
layout(location = 5) in vec4 vPosition;
layout(location = 2) in vec3 vNormal;
uniform mat4 model_view; uniform mat4 projection; uniform vec4 light_position;
out Surface { vec3 normal; vec3 point; vec4 light; } surface;
void main() {
    vec4 p = model_view * vPosition;
    surface.normal = normalize(transpose(inverse(mat3(model_view))) * vNormal);
    surface.point = p.xyz;
    surface.light = model_view * light_position;
    gl_Position = projection * p;
}
