// How a view is looked at: straight down on the panel, or walking round it.

import { OrthographicCamera, PerspectiveCamera, Vector3 } from "./three.js";

const ROOM = 1.08; // of what must be seen
const RADIANS = Math.PI / 180;
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

/** Straight down on the panel, in mm. */
export class FlatRig {
  constructor() {
    this.camera = new OrthographicCamera(-1, 1, 1, -1, 0, 20000);
    this.size = [120, 90];
    this.view = [1, 1];
    this.reset();
  }

  reset() {
    this.scale = 1;
    this.centre = null;
  }

  fit(width, height) {
    const [w, h] = this.size;
    this.pixel = Math.max((w * ROOM) / width, (h * ROOM) / height) / this.scale;
    const [x, y] = this.centre ?? [w / 2, h / 2];
    Object.assign(this.camera, {
      left: (-width / 2) * this.pixel,
      right: (width / 2) * this.pixel,
      top: (height / 2) * this.pixel,
      bottom: (-height / 2) * this.pixel,
    });
    this.camera.position.set(x, y, 10000);
    this.camera.updateProjectionMatrix();
    this.view = [width, height];
  }

  /** Where on the panel a pixel of the view lies, mm. */
  at(px, py) {
    const [width, height] = this.view;
    const { x, y } = this.camera.position;
    return [x + (px - width / 2) * this.pixel, y - (py - height / 2) * this.pixel];
  }

  pan(dx, dy) {
    const { x, y } = this.camera.position;
    const [w, h] = this.size;
    this.centre = [clamp(x - dx * this.pixel, 0, w), clamp(y + dy * this.pixel, 0, h)];
    this.camera.position.set(...this.centre, 10000);
  }

  zoom(factor, px = this.view[0] / 2, py = this.view[1] / 2) {
    const before = this.at(px, py);
    this.scale = clamp(this.scale * factor, 0.5, 40);
    this.fit(...this.view);
    const after = this.at(px, py);
    this.pan((after[0] - before[0]) / this.pixel, (before[1] - after[1]) / this.pixel);
  }
}

/** Round the panel, always towards it. */
export class OrbitRig {
  constructor() {
    this.camera = new PerspectiveCamera(24, 1, 1, 20000);
    this.size = [120, 90, 12];
    this.reset();
  }

  reset() {
    Object.assign(this, { azimuth: -14, elevation: 58, scale: 1, aside: [0, 0] });
  }

  turn(dx, dy) {
    this.azimuth = ((this.azimuth - dx * 0.4 + 540) % 360) - 180;
    this.elevation = clamp(this.elevation + dy * 0.4, 5, 90);
  }

  pan(dx, dy) {
    this.aside = [clamp(this.aside[0] + dx, -800, 800), clamp(this.aside[1] + dy, -800, 800)];
  }

  zoom(factor) {
    this.scale = clamp(this.scale * factor, 0.5, 12);
  }

  fit(width, height) {
    const [w, h, thick] = this.size;
    const a = this.azimuth * RADIANS;
    const e = this.elevation * RADIANS;
    const towards = new Vector3(Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e));
    const middle = new Vector3(w / 2, h / 2, -thick / 2);
    // Seen from straight above, the far edge is up.
    this.camera.up.set(-Math.sin(a) * Math.sin(e), Math.cos(a) * Math.sin(e), Math.cos(e));
    this.camera.aspect = width / height;
    const distance = this.#distance(towards, middle) / this.scale;
    this.camera.near = Math.max(distance / 50, 0.5);
    this.camera.far = distance * 4 + 2000;
    this.camera.position.copy(middle).addScaledVector(towards, distance);
    this.camera.lookAt(middle);
    const [x, y] = this.aside;
    this.camera.setViewOffset(width, height, -x, -y, width, height);
    this.view = [width, height];
  }

  /** Find how far the camera must stand to see all corners. */
  #distance(towards, middle) {
    const right = new Vector3().crossVectors(this.camera.up, towards).normalize();
    const upward = new Vector3().crossVectors(towards, right);
    const high = Math.tan((this.camera.fov * RADIANS) / 2) / ROOM;
    const wide = high * this.camera.aspect;
    const [w, h, thick] = this.size;
    let distance = 1;
    for (const x of [0, w])
      for (const y of [0, h])
        for (const z of [0, -thick]) {
          const corner = new Vector3(x, y, z).sub(middle);
          const nearer = corner.dot(towards);
          distance = Math.max(
            distance,
            nearer + Math.abs(corner.dot(right)) / wide,
            nearer + Math.abs(corner.dot(upward)) / high,
          );
        }
    return distance;
  }
}
