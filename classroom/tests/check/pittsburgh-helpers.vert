// The Pittsburgh contract in another style: helper functions, other names of varyings and of the normal matrix.
attribute vec4 vPosition, vNormal;
uniform mat4 model_view, projection, model_view_inverse_transpose;
uniform vec4 light_position;
varying vec3 fN, fL, fV;
vec3 eyespace(vec4 p) { vec4 q = model_view * p; return q.xyz; }
void main() {
    vec3 P = eyespace(vPosition);
    fN = normalize((model_view_inverse_transpose * vec4(vNormal.xyz, 0.0)).xyz);
    vec3 L = eyespace(light_position);
    fL = L - P * light_position.w;
    fV = -P;
    gl_Position = projection * vec4(P, 1.0);
}
