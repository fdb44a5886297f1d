#version 300 es
// Draws a ribbon for each contact, between the centres of its spheres. It faces the eye, and is wider for larger forces.
precision highp float;
precision highp sampler2D;
precision highp usampler2D;

uniform mat3 turn;
uniform vec3 eye;
uniform vec2 lens;
uniform vec2 range;
uniform vec2 layers;
uniform float radius;   // radius of the spheres

uniform sampler2D places;    // centre and layer of the first sphere of each contact
uniform sampler2D others;    // centre and layer of the second sphere
uniform sampler2D tones;     // position on the colour map, and force relative to the largest one
uniform usampler2D marksOf;

out vec3 onRibbon;
out float across;
out float along;
flat out vec3 side;
flat out float thick;
flat out float shade;
flat out uint marks;

const uint OPEN = 1u, PULLS = 2u, CHOSEN = 4u, UNKNOWN = 8u;

const vec2 CORNERS[6] = vec2[6](
  vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1), vec2(1, 1)
);

void main() {
  int contact = gl_VertexID / 6;
  vec2 corner = CORNERS[gl_VertexID % 6];
  ivec2 texel = ivec2(contact & 1023, contact >> 10);
  vec4 upper = texelFetch(places, texel, 0);
  vec4 lower = texelFetch(others, texel, 0);
  vec2 look = texelFetch(tones, texel, 0).rg;
  uint mark = texelFetch(marksOf, texel, 0).r;
  vec3 a = turn * (upper.xyz - eye);
  vec3 b = turn * (lower.xyz - eye);
  shade = look.x;
  marks = mark;
  across = corner.x;
  along = 0.5 + 0.5 * corner.y;
  thick = radius * ((mark & OPEN) != 0u ? 0.035 : 0.05 + 0.2 * sqrt(look.y));
  if ((mark & PULLS) != 0u) thick = max(thick, 0.12 * radius);
  if ((mark & CHOSEN) != 0u) thick = max(thick, 0.09 * radius);
  if ((mark & UNKNOWN) != 0u || upper.w < layers.x || lower.w > layers.y || min(a.z, b.z) < 0.1 * radius) {
    onRibbon = side = vec3(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  side = normalize(cross(b - a, 0.5 * (a + b)));
  onRibbon = mix(a, b, along) + thick * across * side;
  gl_Position = vec4(onRibbon.xy * lens, onRibbon.z * range.x + range.y, onRibbon.z);
}
