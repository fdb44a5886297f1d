#version 300 es
// Draws a square for each sphere, perpendicular to the ray from the eye to its centre, with the apparent size of the
// sphere. Six consecutive vertices form the two triangles of a square. This is much faster than one instance for each
// square.
precision highp float;
precision highp sampler2D;
precision highp usampler2D;

uniform mat3 turn;    // rotation from the axes of the pile to right, up and forward
uniform vec3 eye;
uniform vec2 lens;    // scales of x/z and y/z that map the picture to -1 ... 1
uniform vec2 range;   // coefficients of the clip depth
uniform vec2 layers;  // first and last visible layer
uniform float radius;
uniform bool coloured;
uniform bool shrinks; // draw spheres without a force small

uniform sampler2D places;    // centre and layer of each sphere
uniform sampler2D tones;     // position on the colour map
uniform usampler2D marksOf;

out vec3 onSquare;
flat out vec3 middle;
flat out float shade;
flat out float size;
flat out uint marks;

const uint CHOSEN = 2u, IDLE = 8u;

const vec2 CORNERS[6] = vec2[6](
  vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1), vec2(1, 1)
);

void main() {
  int sphere = gl_VertexID / 6;
  vec2 corner = CORNERS[gl_VertexID % 6];
  ivec2 texel = ivec2(sphere & 1023, sphere >> 10);
  vec4 place = texelFetch(places, texel, 0);
  vec3 centre = place.xyz;
  float layer = place.w;
  uint mark = texelFetch(marksOf, texel, 0).r;
  middle = turn * (centre - eye);
  shade = texelFetch(tones, texel, 0).r;
  marks = mark;
  size = shrinks && (mark & IDLE) != 0u ? min(radius, 0.2) : radius;
  // A selected sphere is larger, to be visible among rods.
  if (!coloured && (mark & CHOSEN) != 0u) size *= 1.6;
  float apart = dot(middle, middle) - size * size;
  if (layer < layers.x || layer > layers.y || apart <= 0.0 || middle.z < size) {
    onSquare = vec3(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec3 ahead = normalize(middle);
  vec3 right = normalize(cross(ahead, vec3(0.0, 1.0, 0.001)));
  vec3 up = cross(right, ahead);
  // The radius of the tangent cone of the sphere at the distance of its centre.
  float reach = size * sqrt(dot(middle, middle) / apart);
  onSquare = middle + reach * (corner.x * right + corner.y * up);
  gl_Position = vec4(onSquare.xy * lens, onSquare.z * range.x + range.y, onSquare.z);
}
