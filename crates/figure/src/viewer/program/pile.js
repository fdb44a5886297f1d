"use strict";
// The pile: spheres by number, contacts in the order of contacts.csv, and the contacts of each sphere.

/** The steps in i and j to the other sphere of a horizontal contact: alpha-beta, alpha-gamma and gamma-beta. */
const STEPS = [[1, 0], [0, 1], [1, -1]];

/** The forces of one state. */
class State {
  constructor({ name, contacts, loads, shear_x, shear_y, horizontal }, pile) {
    this.name = name;
    this.loads = indicesOf(loads);
    this.shears = [indicesOf(shear_x), indicesOf(shear_y)];
    // The isostatic state has no horizontal contacts.
    this.hasHorizontal = name !== "isostatic";
    // The position of the force of each contact in the list of values; −1 for an open horizontal contact.
    this.forces = new Int32Array(pile.contactCount).fill(-1);
    this.forces.set(indicesOf(contacts));
    horizontal.ids.forEach((id, n) => {
      this.forces[pile.horizontalAt(id, horizontal.axes[n])] = horizontal.forces[n];
    });
  }
}

class Pile {
  constructor(data) {
    this.data = data;
    this.count = data.spheres;
    this.layers = Number(data.layers);
    this.radius = data.radius;
    this.quantities = {};
    for (const [name, quantity] of Object.entries(data.quantities)) this.quantities[name] = new Quantity(quantity);
    this.#placeSpheres();
    this.#linkSpheres();
    this.states = data.states.map((state) => new State(state, this));
    this.special = new Map(data.special.map(([id, weight, load]) => [id, { weight, load }]));
  }

  /** Computes the centres, relative to the middle of the pile and in radii, and the layers and rows of the spheres. */
  #placeSpheres() {
    const { rows } = this.data;
    // The step between neighbours in a row.
    const along = floatsOf(rows.step);
    const [xs, ys, zs] = [floatsOf(rows.x), floatsOf(rows.y), floatsOf(rows.z)];
    this.centres = new Float32Array(3 * this.count);
    this.layerOf = new Float32Array(this.count);
    this.rowOf = new Uint32Array(this.count);
    this.firstOfRow = [];
    this.rowAt = new Map();
    const [least, most] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (let row = 0, id = 0; row < rows.k.length; row += 1) {
      this.firstOfRow.push(id + 1);
      this.rowAt.set(`${rows.k[row]},${rows.j[row]}`, row);
      for (let n = 0; n < rows.spheres[row]; n += 1, id += 1) {
        const centre = [xs[row] + n * along[0], ys[row] + n * along[1], zs[row]];
        this.layerOf[id] = rows.k[row];
        this.rowOf[id] = row;
        centre.forEach((x, axis) => {
          const place = x / this.radius;
          this.centres[3 * id + axis] = place;
          least[axis] = Math.min(least[axis], place);
          most[axis] = Math.max(most[axis], place);
        });
      }
    }
    this.size = Math.hypot(...most.map((x, axis) => x - least[axis])) / 2 + 1;
    for (let n = 0; n < this.centres.length; n += 1) this.centres[n] -= (least[n % 3] + most[n % 3]) / 2;
    this.firstOnFloor = this.firstOfRow[rows.k.indexOf(this.layers - 1)];
  }

  /** Computes both spheres and the direction of each contact, and the contacts of each sphere. */
  #linkSpheres() {
    const { rows, directions, touching } = this.data;
    const ways = directions.length;
    this.sloping = ways * (this.firstOnFloor - 1);
    const axes = touching ? (ways === 2 ? 1 : 3) : 0;
    const ends = [[], []];
    const lies = [];
    for (let id = 1; id < this.firstOnFloor; id += 1) {
      const row = this.rowOf[id - 1];
      rows.below[row].forEach((below, way) => {
        ends[0].push(id);
        ends[1].push(below + id - this.firstOfRow[row]);
        lies.push(way);
      });
    }
    this.horizontals = new Map();
    for (let id = 1; axes > 0 && id < this.firstOnFloor; id += 1) {
      const { k, i, j } = this.indices(id);
      STEPS.slice(0, axes).forEach(([di, dj], axis) => {
        const other = this.idAt(k, i + di, j + dj);
        if (other === null) return;
        this.horizontals.set(3 * id + axis, ends[0].length);
        ends[0].push(id);
        ends[1].push(other);
        lies.push(ways + axis);
      });
    }
    this.ends = ends.map((ids) => Uint32Array.from(ids));
    this.wayOf = Uint8Array.from(lies);
    this.wayNames = [...directions, ...this.data.axes];
    this.contactCount = this.wayOf.length;
    // `touches` lists the contacts of each sphere in turn, from those above it to those below.
    this.starts = new Uint32Array(this.count + 2);
    for (const ids of this.ends) for (const id of ids) this.starts[id + 1] += 1;
    for (let id = 1; id < this.starts.length; id += 1) this.starts[id] += this.starts[id - 1];
    this.touches = new Uint32Array(2 * this.contactCount);
    const next = this.starts.slice();
    for (let contact = 0; contact < this.contactCount; contact += 1) {
      for (const ids of this.ends) this.touches[next[ids[contact]]++] = contact;
    }
  }

  horizontalAt(id, axis) {
    return this.horizontals.get(3 * id + axis);
  }

  /** Returns the indices of a sphere, i and j relative to the first sphere. */
  indices(id) {
    const { rows } = this.data;
    const row = this.rowOf[id - 1];
    return { k: rows.k[row], i: rows.i[row] + id - this.firstOfRow[row], j: rows.j[row] };
  }

  idAt(k, i, j) {
    const { rows } = this.data;
    const row = this.rowAt.get(`${k},${j}`);
    if (row === undefined) return null;
    const n = i - rows.i[row];
    return n >= 0 && n < rows.spheres[row] ? this.firstOfRow[row] + n : null;
  }

  /** Returns the indices k, i, j (for discs k, i) as in tables: `2,1,0`. */
  place(id) {
    const { origin } = this.data.rows;
    const { k, i, j } = this.indices(id);
    const parts = [BigInt(k), BigInt(origin.i) + BigInt(i), BigInt(origin.j) + BigInt(j)];
    return (this.data.dimension === 2 ? parts.slice(0, 2) : parts).join(",");
  }

  /** Returns the sphere with the number, or with the indices k, i, j, in a text. */
  find(text) {
    const numbers = text.trim().split(/[\s,;]+/).map((part) => (/^[-−]?\d+$/.test(part) ? BigInt(part.replace("−", "-")) : null));
    if (numbers.includes(null)) return null;
    if (numbers.length === 1) return numbers[0] >= 1n && numbers[0] <= BigInt(this.count) ? Number(numbers[0]) : null;
    if (numbers.length !== this.data.dimension) return null;
    const { origin } = this.data.rows;
    const [k, i] = [Number(numbers[0]), Number(numbers[1] - BigInt(origin.i))];
    return this.idAt(k, i, numbers.length === 3 ? Number(numbers[2] - BigInt(origin.j)) : 0);
  }

  contactsOf(id) {
    return [...this.touches.subarray(this.starts[id], this.starts[id + 1])];
  }

  other(contact, id) {
    const [first, second] = [this.ends[0][contact], this.ends[1][contact]];
    return first === id ? second : first;
  }

  centre(id) {
    return [...this.centres.subarray(3 * id - 3, 3 * id)];
  }

  /** Returns the force of a contact as a multiple of the unit; null for a horizontal contact of the isostatic state. */
  force(state, contact) {
    const place = state.forces[contact];
    if (place >= 0) return this.quantities.contact.multiples[place];
    return state.hasHorizontal ? 0 : null;
  }

  load(state, id) {
    return this.quantities.load.multiples[state.loads[id - 1]];
  }
}
