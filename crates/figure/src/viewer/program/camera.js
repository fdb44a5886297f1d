"use strict";
// The camera: it looks at a target and rotates around it.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a, b, times = 1) => [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]];

/** Half the angle of view, across the shorter side of the picture, in radians. */
const HALF_VIEW = 0.30;

class Camera {
  /** `size` is the radius of a ball around all spheres. */
  constructor(size) {
    Object.assign(this, { size, around: 0, above: 0, target: [0, 0, 0], distance: 2 * size });
  }

  /** Looks at spheres of radius 1, from the smallest distance that shows all of them in a picture of this size. */
  look(around, above, centres, width, height) {
    this.around = around;
    this.above = above;
    const axes = this.axes();
    const lens = this.lens(width, height);
    // The target is the middle of the visible extent, not of the bounding box.
    const [least, most] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    const each = (see) => {
      for (let n = 0; n < centres.length; n += 3) {
        const centre = [centres[n], centres[n + 1], centres[n + 2]];
        see(axes.map((axis) => dot(axis, centre)));
      }
    };
    each((seen) => seen.forEach((x, axis) => {
      least[axis] = Math.min(least[axis], x);
      most[axis] = Math.max(most[axis], x);
    }));
    const middle = least.map((x, axis) => (x + most[axis]) / 2);
    this.target = axes.reduce((sum, axis, n) => plus(sum, axis, middle[n]), [0, 0, 0]);
    this.distance = 3;
    each((seen) => {
      const [x, y, z] = minus(seen, middle);
      const off = Math.max((Math.abs(x) + 1.1) * lens[0], (Math.abs(y) + 1.1) * lens[1]);
      this.distance = Math.max(this.distance, off / 0.93 - z);
    });
  }

  turn(around, above) {
    this.around += around;
    this.above = Math.min(Math.max(this.above + above, -Math.PI / 2 + 1e-3), Math.PI / 2 - 1e-3);
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, 3), (6 * this.size) / Math.sin(HALF_VIEW));
  }

  /** Moves the target, by fractions of the shorter side of the picture. */
  shift(right, up) {
    const [toRight, upwards] = this.axes();
    const scale = 2 * this.distance * Math.tan(HALF_VIEW);
    this.target = plus(plus(this.target, toRight, right * scale), upwards, up * scale);
  }

  /** Returns the unit vectors right, up and forward. */
  axes() {
    const [around, above] = [this.around, this.above];
    const forward = [-Math.cos(above) * Math.cos(around), -Math.cos(above) * Math.sin(around), -Math.sin(above)];
    const right = [-Math.sin(around), Math.cos(around), 0];
    return [right, cross(right, forward), forward];
  }

  eye() {
    return plus(this.target, this.axes()[2], -this.distance);
  }

  /** Returns the scales of x/z and y/z that map a picture of this aspect ratio to −1 … 1. */
  lens(width, height) {
    const unit = 1 / Math.tan(HALF_VIEW);
    const shorter = Math.min(width, height);
    return [(unit * shorter) / width, (unit * shorter) / height];
  }

  /** Returns a and b of the clip depth (a·z + b)/z, which resolves the depths of the pile. */
  range() {
    const far = this.distance + 1.5 * this.size + 5;
    const near = Math.max(this.distance - 2.2 * this.size - 10, 0.3);
    return [(far + near) / (far - near), (-2 * far * near) / (far - near)];
  }

  /** Returns the position of a point in a picture of this size, from the upper left corner, and its depth. */
  project(point, width, height) {
    const from = minus(point, this.eye());
    const [x, y, z] = this.axes().map((axis) => dot(axis, from));
    const lens = this.lens(width, height);
    return [(width * (1 + (x * lens[0]) / z)) / 2, (height * (1 - (y * lens[1]) / z)) / 2, z];
  }

  /** Returns the ray from the eye through a point of the picture. */
  ray(x, y, width, height) {
    const [right, up, forward] = this.axes();
    const lens = this.lens(width, height);
    const along = plus(plus(forward, right, ((2 * x) / width - 1) / lens[0]), up, (1 - (2 * y) / height) / lens[1]);
    const length = Math.hypot(...along);
    return along.map((part) => part / length);
  }
}
