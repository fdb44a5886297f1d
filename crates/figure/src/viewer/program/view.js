"use strict";
// The view: the states in their panes, colours and flags, visible layers, and the selection.

/** The quantities that the colour of a sphere can show. */
const SPHERE_COLOURS = {
  load: "load transmitted",
  most: "greatest contact force",
  least: "least contact force",
};

class View {
  constructor(pile, canvas, drawing) {
    this.pile = pile;
    this.canvas = canvas;
    this.drawing = drawing;
    this.camera = new Camera(pile.size);
    this.layers = [0, pile.layers - 1];
    this.showsForces = false;
    // Small spheres without a force do not hide the others.
    this.shrinks = pile.data.weightless;
    this.sphereColour = "load";
    this.chosen = {};
    this.colour();
  }

  /** Returns the value that the colour of a sphere shows, in its unit. */
  #value(state, id) {
    const { pile, sphereColour } = this;
    if (sphereColour === "load") return pile.load(state, id);
    let value = sphereColour === "most" ? -Infinity : Infinity;
    for (let n = pile.starts[id]; n < pile.starts[id + 1]; n += 1) {
      const force = pile.force(state, pile.touches[n]);
      if (force !== null) value = sphereColour === "most" ? Math.max(value, force) : Math.min(value, force);
    }
    return Number.isFinite(value) ? value : 0;
  }

  /** Computes the colours of all spheres and contacts, on one scale for all states. */
  colour() {
    const { pile } = this;
    const ids = Array.from({ length: pile.count }, (_, n) => n + 1);
    const values = pile.states.map((state) => Float64Array.from(ids, (id) => this.#value(state, id)));
    // NaN for the horizontal contacts of the isostatic state.
    const forces = pile.states.map((state) => Float64Array.from(state.forces, (_, contact) => pile.force(state, contact) ?? NaN));
    this.sphereScale = new Scale(values);
    this.rodScale = new Scale(forces, 0.3);
    this.pulling = forces.map((list) => list.reduce((count, force) => count + (force < 0), 0));
    this.looks = pile.states.map((state, n) => {
      const sphereMarks = new Uint8Array(pile.count);
      const rodMarks = Uint8Array.from(forces[n], (force) =>
        force < 0 ? ROD.pulls : force === 0 ? ROD.open : Number.isNaN(force) ? ROD.unknown : 0);
      values[n].forEach((value, id) => {
        if (value === 0) sphereMarks[id] = SPHERE.idle;
      });
      forces[n].forEach((force, contact) => {
        if (!(force < 0)) return;
        for (const ends of pile.ends) sphereMarks[ends[contact] - 1] |= SPHERE.pulls;
      });
      // The colour of each contact, and its force relative to the largest one.
      const rodTones = new Float32Array(2 * pile.contactCount);
      forces[n].forEach((force, contact) => {
        rodTones[2 * contact] = this.rodScale.tone(force || 0);
        rodTones[2 * contact + 1] = Math.abs(force || 0) / this.rodScale.reach;
      });
      return {
        sphereTones: Float32Array.from(values[n], (value) => this.sphereScale.tone(value)),
        sphereMarks,
        rodTones,
        rodMarks,
      };
    });
    this.#mark(true);
    this.drawing?.colour(this.looks);
    this.redraw();
  }

  #marked() {
    const { sphere, contact } = this.chosen;
    if (contact !== undefined) return { spheres: this.pile.ends.map((ids) => [ids[contact], SPHERE.neighbour]), rods: [[contact, ROD.chosen]] };
    if (sphere === undefined) return { spheres: [], rods: [] };
    const around = this.pile.contactsOf(sphere).map((touch) => [this.pile.other(touch, sphere), SPHERE.neighbour]);
    return { spheres: [...around, [sphere, SPHERE.chosen]], rods: [] };
  }

  #mark(isOn) {
    const { spheres, rods } = this.#marked();
    for (const { sphereMarks, rodMarks } of this.looks) {
      for (const [id, mark] of spheres) sphereMarks[id - 1] = isOn ? sphereMarks[id - 1] | mark : sphereMarks[id - 1] & ~mark;
      for (const [contact, mark] of rods) rodMarks[contact] = isOn ? rodMarks[contact] | mark : rodMarks[contact] & ~mark;
    }
    return [spheres.map(([id]) => id - 1), rods.map(([contact]) => contact)];
  }

  choose(what) {
    const off = this.#mark(false);
    this.chosen = what;
    const on = this.#mark(true);
    this.drawing?.mark([...off[0], ...on[0]], [...off[1], ...on[1]]);
    this.redraw();
  }

  /** Returns a pane of the canvas for each state: side by side, or stacked if the canvas is narrow. */
  panes() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const count = this.pile.states.length;
    if (count === 1) return [{ x: 0, y: 0, width, height }];
    const part = 1 / count;
    return this.pile.states.map((_, n) =>
      width >= height
        ? { x: n * part * width, y: 0, width: part * width, height }
        : { x: 0, y: n * part * height, width, height: part * height });
  }

  /** Returns the pane that contains a point of the canvas, and the position of the point in it. */
  pane(x, y) {
    const panes = this.panes();
    const state = Math.max(panes.findIndex((of) => x >= of.x && x < of.x + of.width && y >= of.y && y < of.y + of.height), 0);
    const pane = panes[state];
    return { state, pane, x: x - pane.x, y: y - pane.y };
  }

  pickAt(x, y) {
    const at = this.pane(x, y);
    const ray = this.camera.ray(at.x, at.y, at.pane.width, at.pane.height);
    const { sphereMarks } = this.looks[at.state];
    return pick(this.pile, this.camera.eye(), ray, this, sphereMarks);
  }

  /** Looks at the whole pile from these angles. By default the view is from a corner and a little above, for discs from the front. */
  look(around, above) {
    const [first, second] = this.pile.data.dimension === 2 ? [-Math.PI / 2, 0] : [-Math.PI / 3 - 0.35, 0.42];
    const { width, height } = this.panes()[0];
    this.camera.look(around ?? first, above ?? second, this.pile.centres, width, height);
    this.isTurned = false;
    this.redraw();
  }

  /** Returns the position of a point of the pile on the canvas, in the pane of a state. */
  project(point, state = 0) {
    const pane = this.panes()[state];
    const [x, y, depth] = this.camera.project(point, pane.width, pane.height);
    return [pane.x + x, pane.y + y, depth];
  }

  /** Returns the neighbour of the selected sphere that is farthest in a direction of the picture. */
  neighbour(right, up) {
    const { sphere } = this.chosen;
    if (sphere === undefined) return null;
    const axes = this.camera.axes();
    const steps = this.#nearby(sphere).map((id) => {
      const way = minus(this.pile.centre(id), this.pile.centre(sphere));
      const [x, y, z] = axes.map((axis) => dot(axis, way));
      return { id, part: (right * x + up * y) / (Math.hypot(x, y, z) + 0.2 * Math.abs(z)) };
    });
    steps.sort((a, b) => b.part - a.part);
    return steps.length > 0 && steps[0].part > 0.3 ? steps[0].id : null;
  }

  /** Returns the visible spheres that touch a sphere, and its visible neighbours in the layer. */
  #nearby(sphere) {
    const { pile } = this;
    const { k, i, j } = pile.indices(sphere);
    const beside = STEPS.flatMap(([di, dj]) => [pile.idAt(k, i + di, j + dj), pile.idAt(k, i - di, j - dj)]);
    const ids = new Set([...beside, ...pile.contactsOf(sphere).map((contact) => pile.other(contact, sphere))]);
    return [...ids].filter((id) => id !== null && pile.layerOf[id - 1] >= this.layers[0] && pile.layerOf[id - 1] <= this.layers[1]);
  }

  redraw() {
    if (this.drawing === null || this.isAwaited) return;
    this.isAwaited = true;
    requestAnimationFrame(() => {
      this.isAwaited = false;
      this.#draw();
    });
  }

  #draw() {
    const { canvas } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((length) => Math.max(Math.round(length * ratio), 1));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    this.drawing.draw(this.panes(), this.camera, {
      layers: this.layers,
      showsForces: this.showsForces,
      shrinks: this.shrinks,
      sphereMap: this.sphereScale.isAroundZero ? "diverging" : "rising",
      rodMap: this.rodScale.isAroundZero ? "diverging" : "rising",
      hasChoice: this.chosen.sphere !== undefined || this.chosen.contact !== undefined,
      theme: this.theme(),
    });
    this.frames = (this.frames ?? 0) + 1;
  }

  /** Returns the colours of the page, from its style. */
  theme() {
    const style = getComputedStyle(this.canvas);
    const colour = (name) => style.getPropertyValue(name).trim().match(/[0-9a-f]{2}/gi).map((digits) => parseInt(digits, 16) / 255);
    return { ground: colour("--ground"), grey: colour("--neutral"), accent: colour("--accent") };
  }
}
