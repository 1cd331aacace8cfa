// The light: a sun over a small dome, dragged or moved by arrow keys.

const LOWEST = 0.985; // of the dome's radius: 10 degrees over the panel
const KEY = 0.06;
const PER_PIXEL = 1 / 110;
const WAYS = ["right", "upper right", "top", "upper left", "left", "lower left", "bottom", "lower right"];

export class Sun {
  /** @param {HTMLElement} host  the dome @param {function} moved */
  constructor(host, moved) {
    Object.assign(this, { host, moved, dot: host.querySelector("i") });
    this.place = [-0.6, 0.6]; // from the upper left, as reliefs are lit by custom
    host.addEventListener("pointerdown", (event) => {
      host.setPointerCapture(event.pointerId);
      this.#follow(event);
    });
    host.addEventListener(
      "pointermove",
      (event) => host.hasPointerCapture(event.pointerId) && this.#follow(event),
    );
    host.addEventListener("keydown", (event) => this.#key(event));
    this.#tell();
  }

  /** Towards the light, a unit vector: X right, Y away, Z to the viewer. */
  get direction() {
    const [x, y] = this.place;
    return [x, y, Math.sqrt(1 - x * x - y * y)];
  }

  /** Move by pixels of the view. */
  move(dx, dy) {
    const [x, y] = this.place;
    this.#put(x + dx * PER_PIXEL, y - dy * PER_PIXEL);
  }

  #follow(event) {
    const { left, top, width, height } = this.host.getBoundingClientRect();
    this.#put((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
  }

  #key(event) {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!way) return;
    event.preventDefault();
    this.#put(this.place[0] + KEY * way[0], this.place[1] + KEY * way[1]);
  }

  #put(x, y) {
    const far = Math.hypot(x, y);
    const held = far > LOWEST ? LOWEST / far : 1;
    this.place = [x * held, y * held];
    this.#tell();
    this.moved(this.direction);
  }

  #tell() {
    const [x, y] = this.place;
    const turn = (Math.atan2(y, x) * 180) / Math.PI;
    const height = Math.round((Math.acos(Math.min(1, Math.hypot(x, y))) * 180) / Math.PI);
    const way = WAYS[((Math.round(turn / 45) % 8) + 8) % 8];
    this.dot.style.left = `${50 + 50 * x}%`;
    this.dot.style.top = `${50 - 50 * y}%`;
    this.host.setAttribute("aria-valuenow", Math.round((turn + 360) % 360));
    this.host.setAttribute(
      "aria-valuetext",
      height > 85 ? "straight above" : `from the ${way}, ${height} degrees high`,
    );
  }
}
