#version 150
// Angel's names, lit per fragment in eye space.
in vec4 vPosition;
in vec3 vNormal;

uniform mat4 ModelView;
uniform mat4 Projection;
uniform vec4 LightPosition;

out vec3 fN;
out vec3 fL;
out vec3 fE;

void main()
{
    vec4 point = ModelView * vPosition;
    fN = normalize(transpose(inverse(mat3(ModelView))) * vNormal);
    fL = LightPosition.xyz - LightPosition.w * point.xyz;
    fE = -point.xyz;
    gl_Position = Projection * point;
}
