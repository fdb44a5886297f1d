"use strict";
// The report on a sphere or a contact: a table, also for screen readers.

/** Creates an element with properties and content. Texts never become markup. */
const element = (name, properties = {}, ...inside) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...inside);
  return made;
};

const NAMES = { alpha: "α", beta: "β", gamma: "γ", "alpha-beta": "αβ", "alpha-gamma": "αγ", "gamma-beta": "γβ" };

class Report {
  /** A click on a sphere or a contact in the report calls `choose`. */
  constructor(pile, place, choose) {
    this.pile = pile;
    this.place = place;
    this.choose = choose;
    this.isNarrow = pile.states.length > 1;
    this.columns = this.isNarrow ? 1 : 2;
  }

  sphereName(id) {
    return `${this.pile.data.dimension === 2 ? "disc" : "sphere"} ${id} (${this.pile.place(id)})`;
  }

  contactName(contact) {
    const [first, second] = this.pile.ends.map((ids) => ids[contact]);
    return `contact of ${first} and ${second} along ${NAMES[this.pile.wayNames[this.pile.wayOf[contact]]]}`;
  }

  /** Returns the side and the direction of the other sphere. */
  #lies(contact, id) {
    const way = NAMES[this.pile.wayNames[this.pile.wayOf[contact]]];
    if (contact >= this.pile.sloping) return `beside, ${way}`;
    return `${this.pile.ends[0][contact] === id ? "below" : "above"}, ${way}`;
  }

  /** Returns the cells of a value: exact and as a float. */
  #cells(quantity, place, mark = null) {
    const word = mark === null ? [] : [" ", element("span", { className: `mark ${mark}`, textContent: mark })];
    const exact = element("span", { className: "exact", textContent: quantity.exact(place) });
    const small = (textContent) => element("small", { textContent });
    const [multiple, newtons] = [small(String(quantity.multiples[place])), String(quantity.newtons[place])];
    const exactNewtons = quantity.exactNewtons(place);
    // With two states each has a single column.
    const si = element("span", { className: "exact", textContent: exactNewtons + (this.isNarrow ? " N" : "") });
    if (this.isNarrow) return [element("td", {}, exact, ...word, multiple, si, small(newtons))];
    return [element("td", {}, exact, ...word, multiple), element("td", {}, si, small(newtons))];
  }

  /** Returns the cells of the force of a contact in a state, exactly and in N. */
  #force(state, contact) {
    const place = state.forces[contact];
    const { contact: quantity } = this.pile.quantities;
    if (place < 0 && !state.hasHorizontal) return [element("td", { colSpan: this.columns, className: "none", textContent: "not included" })];
    const value = place < 0 ? 0 : quantity.multiples[place];
    if (value === 0) {
      const word = contact < this.pile.sloping ? "no force" : "open";
      const open = element("span", { className: "mark open", textContent: word });
      const cell = element("td", { colSpan: this.columns }, element("span", { className: "exact", textContent: "0" }), " ", open);
      return [cell];
    }
    return this.#cells(quantity, place, value < 0 ? "pulls" : null);
  }

  #button(text, what) {
    const button = element("button", { type: "button", textContent: text });
    button.addEventListener("click", () => this.choose(what, true));
    return button;
  }

  /** Returns the head of a table, with two columns for each state, or one if there are two states. */
  #heads(words, unit) {
    const { states } = this.pile;
    const head = (textContent, ...inside) => element("th", { scope: "col", textContent }, ...inside);
    const forces = this.isNarrow
      ? states.map(({ name }) => head(name, element("small", { textContent: `${unit}, N` })))
      : [unit, "N"].map((text) => head(text));
    return element("thead", {}, element("tr", {}, ...words.map((word) => head(word)), ...forces));
  }

  /** Returns a row with a value of each state. */
  #row(head, quantity, places, unit) {
    const name = element("th", { scope: "row", textContent: head }, element("small", { textContent: unit }));
    name.colSpan = 2;
    return element("tr", {}, name, ...places.flatMap((place) => this.#cells(quantity, place)));
  }

  sphere(id) {
    const { pile } = this;
    const { load, shear_x, shear_y, contact: unit } = pile.quantities;
    const own = pile.special.get(id) ?? { weight: pile.data.weight, load: "0" };
    const below = id - pile.firstOnFloor;
    const onFloor = below >= 0;
    const contacts = pile.contactsOf(id);
    const pulling = contacts.filter((contact) => pile.states.some((state) => pile.force(state, contact) < 0)).length;
    const says = [
      `Weight ${own.weight} mg${own.load === "0" ? "" : `, load ${own.load} on it`}.`,
      `It touches ${contacts.length} other${contacts.length === 1 ? "" : "s"}${onFloor ? " and the floor" : ""}.`,
      pulling > 0 ? `${pulling} of its contacts need${pulling === 1 ? "s" : ""} tension.` : "",
    ];
    const whole = element("tbody", {},
      this.#row(onFloor ? "normal force on the floor" : "load transmitted", load, pile.states.map((state) => state.loads[id - 1]), load.unit));
    if (onFloor) {
      [[shear_x, "x"], [shear_y, "y"]].slice(0, pile.data.dimension - 1).forEach(([shear, axis], n) => {
        whole.append(this.#row(`shear force on the floor, ${axis}`, shear, pile.states.map((state) => state.shears[n][below]), shear.unit));
      });
    }
    const rows = contacts.map((contact) => {
      const other = pile.other(contact, id);
      return element("tr", {},
        element("th", { scope: "row" }, this.#button(this.#lies(contact, id), { contact })),
        element("td", {}, this.#button(`${other} (${pile.place(other)})`, { sphere: other })),
        ...pile.states.flatMap((state) => this.#force(state, contact)));
    });
    const table = element("table", {},
      element("caption", { textContent: `Forces on ${this.sphereName(id)}: exact, and correctly rounded` }),
      this.#heads(["contact", "with"], unit.unit), element("tbody", {}, ...rows), whole);
    this.#show(`${this.sphereName(id)[0].toUpperCase()}${this.sphereName(id).slice(1)}`, says.join(" "), table);
  }

  contact(contact) {
    const { pile } = this;
    const { contact: quantity } = pile.quantities;
    const [first, second] = pile.ends.map((ids) => ids[contact]);
    const rows = pile.states.map((state) => element("tr", {},
      element("th", { scope: "row", textContent: state.name }), ...this.#force(state, contact)));
    const heads = this.isNarrow ? ["state", `${quantity.unit}, N`] : ["state", quantity.unit, "N"];
    const head = element("tr", {}, ...heads.map((text) => element("th", { scope: "col", textContent: text })));
    const table = element("table", {},
      element("caption", { textContent: `Force of the ${this.contactName(contact)}: exact, and correctly rounded` }),
      element("thead", {}, head), element("tbody", {}, ...rows));
    const between = element("p", {}, "Between ", this.#button(this.sphereName(first), { sphere: first }), " and ",
      this.#button(this.sphereName(second), { sphere: second }), ".");
    this.#show(this.contactName(contact).replace("contact", "Contact"), between, table);
  }

  /** Returns the report in one line, for the text below the picture. */
  brief({ sphere, contact }) {
    const { pile } = this;
    const { load, contact: force } = pile.quantities;
    const joined = (texts) =>
      new Set(texts).size === 1 ? texts[0] : texts.map((text, n) => `${pile.states[n].name} ${text}`).join(", ");
    const value = (quantity, place) => `${quantity.exact(place)} ${quantity.unit} = ${short(quantity.newtons[place])} N`;
    if (sphere !== undefined) {
      const verb = sphere >= pile.firstOnFloor ? "presses on the floor with" : "transmits";
      return `${this.sphereName(sphere)} ${verb} ${joined(pile.states.map((state) => value(load, state.loads[sphere - 1])))}`;
    }
    if (contact === undefined) return "";
    const forces = pile.states.map((state) => {
      const place = state.forces[contact];
      return place >= 0 ? value(force, place) : state.hasHorizontal ? "open" : "not included";
    });
    return `${this.contactName(contact)}: ${joined(forces)}`;
  }

  nothing() {
    this.#show("No selection", "Select a sphere or a contact in the picture, or a sphere by its number or its indices k, i, j.", "");
  }

  #show(heading, says, table) {
    const text = typeof says === "string" ? element("p", { textContent: says }) : says;
    this.place.replaceChildren(element("h2", { textContent: heading }), text, element("div", { className: "scrolls" }, table));
  }
}
