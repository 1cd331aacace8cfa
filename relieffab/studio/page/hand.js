// The hand on the view: mouse, fingers and keys, told apart once for all views.

const KEY_STEP = 12; // pixels' worth of an arrow key
const WHEEL = 0.0015;

/**
 * Lead a view by hand.
 *
 * A view has turn, pan, zoom, roll, light (each may do nothing) and reset.
 *
 * @param {HTMLElement} host  has the keyboard's focus
 * @param {HTMLElement} canvas
 * @param {function} view  () -> the view shown
 * @param {function} after  called after whatever was done; true at a gesture's end
 */
export function lead(host, canvas, view, after) {
  const fingers = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return view().point?.(event.offsetX, event.offsetY);
    const now = [event.offsetX, event.offsetY];
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    if (fingers.size === 2) pinch(fingers, event.pointerId, now, view());
    else if (event.buttons & 6 || event.ctrlKey || event.metaKey) view().pan(dx, dy);
    else if (event.altKey) view().roll(dx);
    else if (event.shiftKey) view().light(dx, dy);
    else view().turn(dx, dy);
    fingers.set(event.pointerId, now);
    after(false);
  });
  for (const end of ["pointerup", "pointercancel"])
    canvas.addEventListener(end, (event) => {
      fingers.delete(event.pointerId);
      after(true);
    });
  canvas.addEventListener("pointerleave", () => view().point?.(null));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", () => {
    view().reset();
    after(true);
  });
  host.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      view().zoom(Math.exp(-event.deltaY * WHEEL), event.offsetX, event.offsetY);
      after(false);
    },
    { passive: false },
  );
  host.addEventListener("keydown", (event) => {
    if (event.target !== host || !pressed(event, view())) return;
    event.preventDefault();
    after(true);
  });
}

/** Two fingers: their distance zooms, their middle moves. */
function pinch(fingers, moved, now, view) {
  const [other] = [...fingers].filter(([id]) => id !== moved).map(([, place]) => place);
  const before = fingers.get(moved);
  const apart = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]) || 1;
  view.zoom(apart(now) / apart(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
  view.pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** Do what a key asks for; false if it asks for nothing. */
function pressed(event, view) {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const arrow = ARROWS[event.key];
  if (arrow) {
    const [dx, dy] = arrow.map((way) => way * KEY_STEP);
    if (event.shiftKey) view.light(dx, dy);
    else view.turn(dx, dy);
    return true;
  }
  const other = {
    "+": () => view.zoom(1.15),
    "=": () => view.zoom(1.15),
    "-": () => view.zoom(1 / 1.15),
    0: () => view.reset(),
    Home: () => view.reset(),
    q: () => view.roll(-KEY_STEP),
    e: () => view.roll(KEY_STEP),
  }[event.key];
  other?.();
  return Boolean(other);
}
