"use strict";
// Exact numbers: integers over one denominator, as multiples of a unit and in SI, and the floats nearest to them.

/** The bytes that base64 stands for. */
const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

/** Floats of 64 bits; browsers that have WebGL2 are all little-endian. */
const floatsOf = (base64) => new Float64Array(bytesOf(base64).buffer);

/** Indices of 1, 2 or 4 bytes. */
const indicesOf = ({ bytes, base64 }) => {
  const Kind = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[bytes];
  return new Kind(bytesOf(base64).buffer);
};

const gcd = (a, b) => {
  let [x, y] = [a < 0n ? -a : a, b < 0n ? -b : b];
  while (y > 0n) [x, y] = [y, x % y];
  return x;
};

/** `7/3`, or `4`, in lowest terms. */
const fraction = (numerator, denominator) => {
  const common = gcd(numerator, denominator);
  const [n, d] = [numerator / common, denominator / common];
  return d === 1n ? `${n}` : `${n}/${d}`;
};

/** The numbers of one kind that occur in the pile, each by its place in a list. */
class Quantity {
  constructor({ unit, newtons, denominator, numerators, multiples, floats }) {
    this.unit = unit;
    this.denominator = BigInt(denominator);
    this.numerators = numerators === "" ? [] : numerators.split(" ");
    this.multiples = floatsOf(multiples);
    this.newtons = floatsOf(floats);
    this.si = {
      numerator: BigInt(newtons.numerator),
      denominator: BigInt(newtons.denominator),
      radicand: newtons.radicand,
    };
  }

  /** As a multiple of the unit: `5/2`. */
  exact(place) {
    return fraction(BigInt(this.numerators[place]), this.denominator);
  }

  /** In N: `5/39*sqrt(13)`. */
  exactNewtons(place) {
    const { numerator, denominator, radicand } = this.si;
    const coefficient = fraction(BigInt(this.numerators[place]) * numerator, this.denominator * denominator);
    if (radicand === "1" || coefficient === "0") return coefficient;
    if (coefficient === "1") return `sqrt(${radicand})`;
    return coefficient === "-1" ? `-sqrt(${radicand})` : `${coefficient}*sqrt(${radicand})`;
  }
}

/** Which colour a number has: rising from the least, or around zero where one of them is negative. */
class Scale {
  /** `palest` is the part of the map on each side of zero that is left out, so that thin rods show their sign. */
  constructor(lists, palest = 0) {
    this.palest = palest;
    let [least, most] = [Infinity, -Infinity];
    for (const values of lists) {
      for (const value of values) {
        if (value < least) least = value;
        if (value > most) most = value;
      }
    }
    if (!(least <= most)) least = most = 0;
    this.least = least;
    this.most = most;
    this.isAroundZero = least < 0;
    this.isUniform = most - least <= 1e-12 * Math.max(Math.abs(most), Math.abs(least));
    this.reach = Math.max(Math.abs(least), Math.abs(most)) || 1;
  }

  /** The number as a part of the colour map, from 0 to 1; the darkest ends of the map around zero are left out. */
  tone(value) {
    if (this.isAroundZero) {
      // Where spheres pull is seen, however little they do.
      const palest = value < 0 ? 2 * this.palest : this.palest;
      const part = Math.sign(value) * (palest + (1 - palest) * Math.abs(value / this.reach));
      return 0.5 - 0.4 * part;
    }
    return this.isUniform ? 0.5 : Math.min(Math.max((value - this.least) / (this.most - this.least), 0), 1);
  }
}

/** A float for a legend: four digits. */
const short = (value) => String(Number(value.toPrecision(4)));
