#version 300 es
// Shades the square of a sphere so that it looks like the sphere, and writes the depth of the sphere.
precision highp float;
precision highp sampler2D;

uniform vec2 range;
uniform sampler2D colours;
uniform vec3 upwards;   // axis z of the pile, in the axes of the camera
uniform vec3 grey;      // colour of spheres without a value
uniform vec3 accent;    // colour of the selection
uniform bool coloured;
uniform bool shrinks;
uniform bool ghost;     // draw only the outline of the selection, over everything else

in vec3 onSquare;
flat in vec3 middle;
flat in float shade;
flat in float size;
flat in uint marks;

out vec4 colour;

const uint PULLS = 1u, CHOSEN = 2u, NEIGHBOUR = 4u, IDLE = 8u;

void main() {
  vec3 ray = normalize(onSquare);
  float along = dot(ray, middle);
  // The squared distance of the ray from the centre, in radii.
  vec3 passing = along * ray - middle;
  float off = dot(passing, passing) / (size * size);
  float soft = max(fwidth(off), 1e-4);
  float covered = clamp((1.0 - off) / soft, 0.0, 1.0);
  if (covered <= 0.0) discard;
  float inside = sqrt(max(1.0 - off, 0.0));
  vec3 point = ray * (along - inside * size);
  vec3 normal = (point - middle) / size;
  float rim = 1.0 - inside;

  if (ghost) {
    if ((marks & CHOSEN) == 0u || rim < 0.55) discard;
    colour = vec4(accent, covered);
    gl_FragDepth = 0.0;
    return;
  }

  vec3 base = coloured && !(shrinks && (marks & IDLE) != 0u) ? texture(colours, vec2(shade, 0.5)).rgb : grey;
  if (!coloured && (marks & CHOSEN) != 0u) base = accent;
  float height = dot(normal, upwards);
  if (coloured && (marks & PULLS) != 0u) {
    // The belt always faces the eye, and shows tension without colours.
    float edge = max(fwidth(normal.y), 1e-3);
    vec3 belt = vec3(dot(base, vec3(0.3, 0.59, 0.11)) > 0.45 ? 0.08 : 0.97);
    base = mix(base, belt, 1.0 - smoothstep(0.11 - edge, 0.11 + edge, abs(normal.y)));
  }
  float lit = max(dot(normal, normalize(vec3(-0.45, 0.65, -0.75))), 0.0);
  float sky = 0.5 + 0.5 * height;
  float light = 0.52 + 0.2 * sky + 0.42 * lit;
  vec3 seen = base * light * (1.0 - 0.5 * smoothstep(0.75, 1.0, rim));
  seen += 0.10 * pow(lit, 24.0);
  if ((marks & CHOSEN) != 0u) {
    seen = mix(seen, accent, smoothstep(0.42, 0.5, rim));
  } else if ((marks & NEIGHBOUR) != 0u) {
    seen = mix(seen, accent, smoothstep(0.6, 0.66, rim));
  }
  colour = vec4(seen, covered);
  gl_FragDepth = 0.5 + 0.5 * (range.x + range.y / point.z);
}
