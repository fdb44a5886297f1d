#version 300 es
// Shades the ribbon of a contact so that it looks like a rod, and writes its depth. Tensile rods are banded, open ones
// dashed.
precision highp float;
precision highp sampler2D;

uniform vec2 range;
uniform sampler2D colours;
uniform vec3 upwards;
uniform vec3 grey;
uniform vec3 accent;
uniform bool ghost;

in vec3 onRibbon;
in float across;
in float along;
flat in vec3 side;
flat in float thick;
flat in float shade;
flat in uint marks;

out vec4 colour;

const uint OPEN = 1u, PULLS = 2u, CHOSEN = 4u;

void main() {
  float soft = max(fwidth(across), 1e-3);
  float covered = clamp((1.0 - abs(across)) / soft, 0.0, 1.0);
  vec3 toEye = normalize(cross(side, cross(-onRibbon, side)));
  float bulge = sqrt(max(1.0 - across * across, 0.0));
  vec3 normal = across * side + bulge * toEye;
  bool chosen = (marks & CHOSEN) != 0u;
  if (ghost) {
    if (!chosen) discard;
    colour = vec4(accent, covered * 0.5);
    gl_FragDepth = 0.0;
    return;
  }
  if ((marks & OPEN) != 0u && !chosen && fract(along * 9.0) > 0.5) discard;
  vec3 base = (marks & OPEN) != 0u ? grey : texture(colours, vec2(shade, 0.5)).rgb;
  if ((marks & PULLS) != 0u && fract(along * 10.0) > 0.6) base = vec3(0.98);
  if (chosen) base = accent;
  float lit = max(dot(normal, normalize(vec3(-0.45, 0.65, -0.75))), 0.0);
  float light = 0.5 + 0.15 * dot(normal, upwards) + 0.5 * lit;
  colour = vec4(base * light, covered);
  float depth = (onRibbon + thick * bulge * toEye).z;
  gl_FragDepth = 0.5 + 0.5 * (range.x + range.y / depth);
}
