"use strict";
// The drawing: the shaders turn squares into spheres and ribbons into rods.

/** The flags of spheres and rods in the shaders. */
const SPHERE = { pulls: 1, chosen: 2, neighbour: 4, idle: 8 };
const ROD = { open: 1, pulls: 2, chosen: 4, unknown: 8 };

/** The number of spheres or contacts in a row of a texture. */
const ROW = 1024;

/** The radius of spheres among rods. */
const SMALL = 0.3;

/** The radius of spheres without a force, if these are small. */
const IDLE = 0.2;

class Drawing {
  constructor(canvas, pile, shaders) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "high-performance" });
    if (gl === null) throw new Error("this browser has no WebGL2");
    this.gl = gl;
    this.pile = pile;
    this.spheres = this.#program(shaders.sphere);
    this.rods = this.#program(shaders.contact);
    this.maps = Object.fromEntries(
      Object.entries(pile.data.colours).map(([name, colours]) => [name, this.#map(colours)]),
    );
    this.spheres.places = { places: this.#places(Uint32Array.from({ length: pile.count }, (_, n) => n + 1)) };
    const [places, others] = pile.ends.map((ids) => this.#places(ids));
    this.rods.places = { places, others };
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
  }

  #program({ vertex, fragment }) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source.trim());
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const places = new Map();
    const at = (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name);
    };
    return { program, at };
  }

  /** Returns a texture with `parts` values for each sphere or contact, which the shaders read. */
  #table(values, parts) {
    const { gl } = this;
    const rows = Math.max(Math.ceil(values.length / parts / ROW), 1);
    const whole = new values.constructor(rows * ROW * parts);
    whole.set(values);
    const [inside, format, kind] = {
      Uint8Array: [gl.R8UI, gl.RED_INTEGER, gl.UNSIGNED_BYTE],
      Float32Array: [[gl.R32F, gl.RG32F, null, gl.RGBA32F][parts - 1], [gl.RED, gl.RG, null, gl.RGBA][parts - 1], gl.FLOAT],
    }[values.constructor.name];
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, inside, ROW, rows, 0, format, kind, whole);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    return texture;
  }

  /** Returns a colour map as a texture of one row. */
  #map(colours) {
    const { gl } = this;
    const bytes = Uint8Array.from(colours.match(/../g), (digits) => parseInt(digits, 16));
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, bytes.length / 3, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, bytes);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    return texture;
  }

  /** Returns a texture with the centres and layers of some spheres. */
  #places(ids) {
    const { centres, layerOf } = this.pile;
    const places = new Float32Array(4 * ids.length);
    ids.forEach((id, n) => {
      places.set(centres.subarray(3 * id - 3, 3 * id), 4 * n);
      places[4 * n + 3] = layerOf[id - 1];
    });
    return this.#table(places, 4);
  }

  /** Sets the colours and flags of each state. */
  colour(looks) {
    const { gl } = this;
    for (const texture of (this.looks ?? []).flatMap(({ sphere, rod }) => [sphere, rod].flatMap(Object.values))) gl.deleteTexture(texture);
    this.looks = looks.map((look) => ({
      ...look,
      sphere: { tones: this.#table(look.sphereTones, 1), marksOf: this.#table(look.sphereMarks, 1) },
      rod: { tones: this.#table(look.rodTones, 2), marksOf: this.#table(look.rodMarks, 1) },
    }));
  }

  /** Updates the flags of some spheres and rods. */
  mark(spheres, rods) {
    const { gl } = this;
    for (const { sphere, rod, sphereMarks, rodMarks } of this.looks) {
      for (const [{ marksOf }, marks, changed] of [[sphere, sphereMarks, spheres], [rod, rodMarks, rods]]) {
        gl.bindTexture(gl.TEXTURE_2D, marksOf);
        for (const n of changed) {
          gl.texSubImage2D(gl.TEXTURE_2D, 0, n % ROW, Math.floor(n / ROW), 1, 1, gl.RED_INTEGER, gl.UNSIGNED_BYTE, marks, n);
        }
      }
    }
  }

  /** Draws each state into its pane. Panes are rectangles in CSS pixels, from the upper left corner. */
  draw(panes, camera, scene) {
    const { gl } = this;
    const { width, height } = gl.canvas;
    const ratio = width / gl.canvas.clientWidth;
    gl.viewport(0, 0, width, height);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...scene.theme.ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
    panes.forEach((pane, n) => {
      const box = [pane.x, gl.canvas.clientHeight - pane.y - pane.height, pane.width, pane.height];
      const pixels = box.map((length) => Math.round(length * ratio));
      gl.viewport(...pixels);
      gl.scissor(...pixels);
      const look = this.looks[n];
      const passes = scene.hasChoice ? [false, true] : [false];
      for (const ghost of passes) {
        if (ghost) gl.depthFunc(gl.ALWAYS);
        if (scene.showsForces) this.#draw(this.rods, look, "rod", pane, camera, scene, ghost);
        this.#draw(this.spheres, look, "sphere", pane, camera, scene, ghost);
        gl.depthFunc(gl.LESS);
      }
    });
  }

  #draw(kind, look, name, pane, camera, scene, ghost) {
    const { gl } = this;
    const { program, at, places } = kind;
    const axes = camera.axes();
    gl.useProgram(program);
    const colours = this.maps[name === "rod" ? scene.rodMap : scene.sphereMap];
    Object.entries({ colours, ...places, ...look[name] }).forEach(([table, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(at(table), unit);
    });
    gl.activeTexture(gl.TEXTURE0);
    gl.uniformMatrix3fv(at("turn"), true, axes.flat());
    gl.uniform3fv(at("eye"), camera.eye());
    gl.uniform2fv(at("lens"), camera.lens(pane.width, pane.height));
    gl.uniform2fv(at("range"), camera.range());
    gl.uniform2fv(at("layers"), scene.layers);
    gl.uniform1f(at("radius"), name === "sphere" && scene.showsForces ? SMALL : 1);
    gl.uniform3fv(at("upwards"), axes.map((axis) => axis[2]));
    gl.uniform3fv(at("grey"), scene.theme.grey);
    gl.uniform3fv(at("accent"), scene.theme.accent);
    gl.uniform1i(at("shrinks"), scene.shrinks ? 1 : 0);
    gl.uniform1i(at("coloured"), scene.showsForces ? 0 : 1);
    gl.uniform1i(at("ghost"), ghost ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * (name === "rod" ? this.pile.contactCount : this.pile.count));
  }
}

/** Returns the sphere or, if contacts are visible, the contact that a ray from the eye meets first. */
const pick = (pile, eye, ray, { layers, showsForces, shrinks }, marks) => {
  let met = { depth: Infinity, sphere: null, contact: null };
  for (let id = 1; id <= pile.count; id += 1) {
    const layer = pile.layerOf[id - 1];
    if (layer < layers[0] || layer > layers[1]) continue;
    const radius = showsForces ? SMALL : shrinks && (marks[id - 1] & SPHERE.idle) !== 0 ? IDLE : 1;
    const from = minus(pile.centre(id), eye);
    const along = dot(from, ray);
    const apart = dot(from, from) - along * along;
    if (along <= 0 || apart > radius * radius) continue;
    const depth = along - Math.sqrt(radius * radius - apart);
    if (depth < met.depth) met = { depth, sphere: id, contact: null };
  }
  for (let contact = 0; showsForces && contact < pile.contactCount; contact += 1) {
    const [first, second] = [pile.ends[0][contact], pile.ends[1][contact]];
    if (pile.layerOf[first - 1] < layers[0] || pile.layerOf[second - 1] > layers[1]) continue;
    const from = minus(pile.centre(first), eye);
    const way = minus(pile.centre(second), pile.centre(first));
    // The points of smallest distance between the ray and the line through the centres.
    const normal = cross(ray, way);
    const square = dot(normal, normal);
    if (square === 0) continue;
    const across = Math.abs(dot(from, normal)) / Math.sqrt(square);
    const depth = dot(cross(from, way), normal) / square;
    const part = dot(cross(from, ray), normal) / square;
    if (across < 0.16 && depth > 0 && part > 0.1 && part < 0.9 && depth < met.depth) met = { depth, sphere: null, contact };
  }
  return met;
};
