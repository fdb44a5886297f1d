#version 300 es
// A square for each sphere, across the ray from the eye to its centre, as large as the sphere looks from there. Six corners in
// a row make two triangles: squares of their own, one by one, would take far longer.
precision highp float;
precision highp sampler2D;
precision highp usampler2D;

uniform mat3 turn;    // from the pile's axes to right, up and forward
uniform vec3 eye;
uniform vec2 lens;    // how much of a unit at a distance of one fills half the picture
uniform vec2 range;   // what depths are made of
uniform vec2 layers;  // the first and the last that are shown
uniform float radius;
uniform bool coloured;
uniform bool shrinks; // spheres that bear nothing

uniform sampler2D places;    // of each sphere its centre and its layer
uniform sampler2D tones;     // and where its colour is on the map
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
  // What is chosen is seen among rods, too.
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
  // Where the cone that touches the sphere is cut.
  float reach = size * sqrt(dot(middle, middle) / apart);
  onSquare = middle + reach * (corner.x * right + corner.y * up);
  gl_Position = vec4(onSquare.xy * lens, onSquare.z * range.x + range.y, onSquare.z);
}
