"use strict";
// The page: data, parts, and the actions of pointers and keys.

const begun = performance.now();
const at = (id) => document.getElementById(id);
const pile = new Pile(JSON.parse(at("data").textContent));
const canvas = at("picture");

const shader = (name) => ({ vertex: at(`${name}-vert`).textContent, fragment: at(`${name}-frag`).textContent });
const shaders = { sphere: shader("sphere"), contact: shader("contact") };

/** Returns the drawing. If the browser cannot draw, it returns null and shows a message. */
const draw = () => {
  try {
    return new Drawing(canvas, pile, shaders);
  } catch (error) {
    at("undrawn").hidden = false;
    at("reason").textContent = error.message;
    document.body.classList.add("undrawn");
    return null;
  }
};

const drawing = draw();
const view = new View(pile, canvas, drawing);
const report = new Report(pile, at("chosen"), (what, shows) => choose(what, shows));

const choose = (what, shows = false) => {
  if (shows && what.sphere !== undefined) uncut(pile.layerOf[what.sphere - 1]);
  view.choose(what);
  at("callout").textContent = report.brief(what);
  if (what.sphere !== undefined) report.sphere(what.sphere);
  else if (what.contact !== undefined) report.contact(what.contact);
  else report.nothing();
};

/** Shows the description of the pile. */
const describe = () => {
  const { data } = pile;
  const count = (number, noun) => `${number} ${noun}${Number(number) === 1 ? "" : "s"}`;
  document.title = data.title;
  at("title").textContent = data.title;
  const parts = [
    count(data.layers, "layer") + (data.stacking === null ? "" : ` of ${data.stacking}`) + (data.anchor === null ? "" : `, ${data.anchor}`),
    count(data.spheres, data.dimension === 2 ? "disc" : "sphere"),
    count(data.contacts, "contact"),
    `a/R = ${data.spacing}`,
    ...(data.weightless ? ["spheres without weight"] : []),
    ...(data.tilt === null ? [] : [data.tilt]),
    ...(data.stiffness_ratio === null ? [] : [`springs κ′/κ = ${data.stiffness_ratio}`]),
  ];
  at("what").textContent = parts.join(" · ");
  at("purpose").textContent = data.purpose;
  at("program").textContent = data.program;
  if (data.scene === null) at("made").hidden = true;
  else at("scene").textContent = data.scene;
  const pulls = view.pulling
    .map((number, n) => [number, pile.states[n].name])
    .filter(([number]) => number > 0)
    .map(([number, name]) => `${count(number, "contact")}${pile.states.length > 1 ? ` of the ${name} state` : ""}`);
  if (pulls.length === 0) return;
  at("verdict").textContent = data.weightless
    ? `In ${pulls.join(", and ")} this response has tensile forces.`
    : `In ${pulls.join(", and ")} equilibrium needs tension: without further contacts the pile is unstable.${
      pulls.length < pile.states.length ? " With horizontal contacts it is stable." : ""}`;
};

/** Shows the legend: the colour bar with its ends, exactly and in N, and the meaning of the patterns. */
const legend = () => {
  const isOfRods = view.showsForces;
  const scale = isOfRods ? view.rodScale : view.sphereScale;
  const ofLoads = !isOfRods && view.sphereColour === "load";
  const quantity = pile.quantities[ofLoads ? "load" : "contact"];
  at("meaning").textContent = isOfRods ? "Force of a contact" : `Colour of a sphere: ${SPHERE_COLOURS[view.sphereColour]}`;
  const colours = pile.data.colours[scale.isAroundZero ? "diverging" : "rising"].match(/.{6}/g);
  const stops = scale.isUniform && !scale.isAroundZero ? [0.5, 0.5] : Array.from({ length: 17 }, (_, n) => n / 16);
  const tones = stops.map((part) => (scale.isAroundZero ? scale.tone(scale.least + part * (scale.most - scale.least)) : part));
  at("bar").style.background = `linear-gradient(to right, ${tones.map((tone) => `#${colours[Math.round(tone * 64)]}`).join(", ")})`;
  const exact = (value) => {
    const text = quantity.exact(quantity.multiples.indexOf(value));
    return text.length <= 12 ? text : short(value);
  };
  const newtons = (value) => short(quantity.newtons[quantity.multiples.indexOf(value)]);
  // Zero has a tick if it is far enough from both ends.
  const zero = -scale.least / (scale.most - scale.least);
  const ends = scale.isUniform ? [scale.most] : zero > 0.25 && zero < 0.75 ? [scale.least, 0, scale.most] : [scale.least, scale.most];
  const tick = (value, text) => {
    const part = scale.isUniform ? 0.5 : (value - scale.least) / (scale.most - scale.least);
    const mark = element("span", { textContent: text });
    mark.style.left = `${100 * part}%`;
    mark.style.transform = `translateX(${-100 * part}%)`;
    return mark;
  };
  at("ticks").replaceChildren(...ends.map((value) => tick(value, value === 0 ? "0" : exact(value))));
  at("ticks-si").replaceChildren(...ends.map((value) => tick(value, value === 0 ? "0" : newtons(value))));
  at("unit").textContent = quantity.unit;
  const hasPull = view.pulling.some((number) => number > 0);
  at("mark-pulls").hidden = !hasPull;
  at("mark-pulls-text").textContent = isOfRods ? "banded: needs tension" : "with a belt: has a contact that needs tension";
  at("mark-open").hidden = !isOfRods;
  at("map").textContent = scale.isAroundZero ? (ofLoads ? "blue: upwards, red: downwards" : "blue: tension, red: compression") : "dark: smallest, bright: largest";
};

/** Shows the layers from `from` to `to`. */
const cut = (from, to) => {
  view.layers = [Math.max(0, Math.min(from, to)), Math.min(pile.layers - 1, Math.max(from, to))];
  at("cut-from").value = view.layers[0];
  at("cut-to").value = view.layers[1];
  at("cut-says").textContent = `k = ${view.layers[0]} to ${view.layers[1]}`;
  view.redraw();
};

/** Extends the visible layers to include this one. */
const uncut = (layer) => {
  if (layer < view.layers[0] || layer > view.layers[1]) cut(Math.min(layer, view.layers[0]), Math.max(layer, view.layers[1]));
};

/** Sets whether spheres without a force are small. */
const shrink = (shrinks) => {
  view.shrinks = shrinks;
  at("shrink").checked = shrinks;
  view.redraw();
};

const showForces = (shows) => {
  view.showsForces = shows;
  at(shows ? "show-forces" : "show-spheres").checked = true;
  for (const id of ["sphere-colour", "shrink"]) at(id).disabled = shows;
  legend();
  view.redraw();
};

/** Shows the names of the states in their panes. */
const label = () => {
  const panes = view.panes();
  at("labels").replaceChildren(...pile.states.map((state, n) => {
    const name = element("span", { textContent: state.name });
    name.style.left = `${panes[n].x + 12}px`;
    name.style.top = `${panes[n].y + 10}px`;
    return name;
  }));
  at("labels").hidden = pile.states.length === 1;
};

/** Selects a contact of the last state: that of greatest or least force, or the next in tension or without force. */
const seek = (wanted) => {
  const state = pile.states[pile.states.length - 1];
  const forces = Array.from(state.forces, (_, contact) => pile.force(state, contact));
  let found = -1;
  if (wanted === "greatest" || wanted === "least") {
    const sign = wanted === "greatest" ? 1 : -1;
    forces.forEach((force, contact) => {
      if (force !== null && (found < 0 || sign * force > sign * forces[found])) found = contact;
    });
  } else {
    const fits = (force) => (wanted === "pulls" ? force !== null && force < 0 : force === 0);
    const start = view.chosen.contact ?? -1;
    for (let n = 1; n <= forces.length && found < 0; n += 1) {
      const contact = (start + n) % forces.length;
      if (fits(forces[contact])) found = contact;
    }
  }
  if (found < 0) {
    at("found").textContent = wanted === "pulls" ? "No contact is in tension." : "There is no such contact.";
    return;
  }
  at("found").textContent = "";
  pile.ends.forEach((ids) => uncut(pile.layerOf[ids[found] - 1]));
  choose({ contact: found });
};

const hands = () => {
  const pointers = new Map();
  let moved = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 0) moved = 0;
    pointers.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (before === undefined) return;
    view.isTurned = true;
    const now = place(event);
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    moved += Math.hypot(dx, dy);
    const shorter = Math.min(canvas.clientWidth, canvas.clientHeight);
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const apart = (a) => Math.hypot(a[0] - other[0], a[1] - other[1]) || 1;
      view.camera.zoom(apart(before) / apart(now));
      view.camera.shift(-dx / 2 / shorter, dy / 2 / shorter);
    } else if (event.shiftKey || event.buttons === 2 || event.buttons === 4) {
      view.camera.shift(-dx / shorter, dy / shorter);
    } else if (moved > 4) {
      view.camera.turn(-4 * dx / shorter, 4 * dy / shorter);
    }
    pointers.set(event.pointerId, now);
    view.redraw();
  });
  const leave = (event) => pointers.delete(event.pointerId);
  canvas.addEventListener("pointercancel", leave);
  canvas.addEventListener("pointerup", (event) => {
    leave(event);
    if (moved > 6 || event.button !== 0) return;
    const { sphere, contact } = view.pickAt(...place(event));
    choose(sphere !== null ? { sphere } : contact !== null ? { contact } : {});
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.isTurned = true;
    view.camera.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.003));
    view.redraw();
  }, { passive: false });
};

/** The actions of keys on the picture. */
const KEYS = {
  ArrowLeft: () => view.camera.turn(-0.1, 0),
  ArrowRight: () => view.camera.turn(0.1, 0),
  ArrowUp: () => view.camera.turn(0, 0.1),
  ArrowDown: () => view.camera.turn(0, -0.1),
  "+": () => view.camera.zoom(0.9),
  "=": () => view.camera.zoom(0.9),
  "-": () => view.camera.zoom(1 / 0.9),
  "[": () => cut(Math.max(view.layers[0] - 1, 0), view.layers[1]),
  "]": () => cut(Math.min(view.layers[0] + 1, view.layers[1]), view.layers[1]),
  Home: () => view.look(),
  f: () => showForces(!view.showsForces),
  Escape: () => choose({}),
  Enter: () => {
    const { width, height, x, y } = view.panes()[0];
    const { sphere, contact } = view.pickAt(x + width / 2, y + height / 2);
    choose(sphere !== null ? { sphere } : contact !== null ? { contact } : { sphere: 1 }, true);
  },
};
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

const keys = () => {
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.shiftKey && WAYS[event.key] !== undefined) {
      const next = view.chosen.sphere === undefined ? 1 : view.neighbour(...WAYS[event.key]);
      if (next !== null) choose({ sphere: next });
    } else if (KEYS[event.key] !== undefined) {
      KEYS[event.key]();
      view.redraw();
    } else {
      return;
    }
    event.preventDefault();
  });
};

const controls = () => {
  for (const [id, value] of [["cut-from", 0], ["cut-to", pile.layers - 1]]) {
    Object.assign(at(id), { min: 0, max: pile.layers - 1, step: 1, value });
    at(id).addEventListener("input", () => {
      // A slider stops at the other one.
      const [from, to] = ["cut-from", "cut-to"].map((name) => Number(at(name).value));
      if (id === "cut-from") cut(Math.min(from, to), to);
      else cut(from, Math.max(from, to));
    });
  }
  at("show-spheres").addEventListener("change", () => showForces(false));
  at("shrink").addEventListener("change", () => shrink(at("shrink").checked));
  at("show-forces").addEventListener("change", () => showForces(true));
  at("sphere-colour").replaceChildren(
    ...Object.entries(SPHERE_COLOURS).map(([value, textContent]) => element("option", { value, textContent })));
  at("sphere-colour").addEventListener("change", () => {
    view.sphereColour = at("sphere-colour").value;
    view.colour();
    legend();
  });
  for (const [id, angles] of Object.entries({ oblique: [], front: [-Math.PI / 2, 0], above: [-Math.PI / 2, Math.PI / 2 - 1e-3] })) {
    at(id).addEventListener("click", () => view.look(...angles));
  }
  at("tools").addEventListener("submit", (event) => event.preventDefault());
  for (const wanted of ["greatest", "least", "pulls", "open"]) at(`seek-${wanted}`).addEventListener("click", () => seek(wanted));
  at("find").addEventListener("submit", (event) => {
    event.preventDefault();
    const id = pile.find(at("sphere").value);
    at("found").textContent = id === null ? `There is no such sphere: give a number from 1 to ${pile.count}, or k, i, j.` : "";
    if (id !== null) choose({ sphere: id }, true);
  });
};

describe();
controls();
hands();
keys();
cut(0, pile.layers - 1);
showForces(false);
shrink(view.shrinks);
report.nothing();
label();
view.look();
new ResizeObserver(() => {
  label();
  if (!view.isTurned) view.look();
  view.redraw();
}).observe(canvas);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => view.redraw());
canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
canvas.addEventListener("webglcontextrestored", () => {
  view.drawing = draw();
  view.drawing?.colour(view.looks);
  view.redraw();
});

// An interface for scripts: positions of spheres on the canvas, and the selection.
globalThis.cannonpile = {
  pile,
  view,
  choose,
  project: (id, state = 0) => view.project(pile.centre(id), state),
  milliseconds: performance.now() - begun,
};
