"use strict";
// Exact numbers: integers over a common denominator, as multiples of a unit and in SI, and their rounded floats.

/** Decodes base64. */
const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

/** Decodes floats of 64 bits. All browsers with WebGL2 are little-endian. */
const floatsOf = (base64) => new Float64Array(bytesOf(base64).buffer);

/** Decodes indices of 1, 2 or 4 bytes. */
const indicesOf = ({ bytes, base64 }) => {
  const Kind = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[bytes];
  return new Kind(bytesOf(base64).buffer);
};

const gcd = (a, b) => {
  let [x, y] = [a < 0n ? -a : a, b < 0n ? -b : b];
  while (y > 0n) [x, y] = [y, x % y];
  return x;
};

/** Returns a fraction in lowest terms: `7/3` or `4`. */
const fraction = (numerator, denominator) => {
  const common = gcd(numerator, denominator);
  const [n, d] = [numerator / common, denominator / common];
  return d === 1n ? `${n}` : `${n}/${d}`;
};

/** The values of a quantity. Spheres and contacts refer to them by their position in the list. */
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

  /** Returns a value as a multiple of the unit: `5/2`. */
  exact(place) {
    return fraction(BigInt(this.numerators[place]), this.denominator);
  }

  /** Returns a value in N: `5/39*sqrt(13)`. */
  exactNewtons(place) {
    const { numerator, denominator, radicand } = this.si;
    const coefficient = fraction(BigInt(this.numerators[place]) * numerator, this.denominator * denominator);
    if (radicand === "1" || coefficient === "0") return coefficient;
    if (coefficient === "1") return `sqrt(${radicand})`;
    return coefficient === "-1" ? `-sqrt(${radicand})` : `${coefficient}*sqrt(${radicand})`;
  }
}

/** A colour scale: from the smallest value, or around zero if a value is negative. */
class Scale {
  /** `palest` is the fraction of the map left out on each side of zero, so that thin rods show their sign. */
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

  /** Returns the position of a value on the colour map, 0 to 1. A map around zero is used without its darkest ends. */
  tone(value) {
    if (this.isAroundZero) {
      // Small tensile forces are visible too.
      const palest = value < 0 ? 2 * this.palest : this.palest;
      const part = Math.sign(value) * (palest + (1 - palest) * Math.abs(value / this.reach));
      return 0.5 - 0.4 * part;
    }
    return this.isUniform ? 0.5 : Math.min(Math.max((value - this.least) / (this.most - this.least), 0), 1);
  }
}

/** Returns a float with four digits. */
const short = (value) => String(Number(value.toPrecision(4)));
