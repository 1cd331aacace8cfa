// Lengths and angles as people type them; the studio judges, the sliders only follow.

const IN_MM = { "": 1, mm: 1, cm: 10, m: 1000, in: 25.4, '"': 25.4, ft: 304.8, um: 0.001, µm: 0.001 };
const IN_DEGREES = { "": 1, deg: 1, "°": 1, rad: 180 / Math.PI };

/** Read "4mm", "0.25in" or "30deg" in mm or degrees; null if it is neither. */
export function quantity(text, unit) {
  const found = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([a-zµ°"]*)\s*$/i.exec(text ?? "");
  if (!found) return null;
  const factor = (unit === "deg" ? IN_DEGREES : IN_MM)[found[2].toLowerCase()];
  return factor === undefined ? null : Number(found[1]) * factor;
}

/** Read two lengths: "120x90mm", in mm; null if they are none. */
export function pair(text) {
  const [first, second] = String(text ?? "").split(/\s*[x×]\s*/i);
  const unit = /[a-zµ"]+\s*$/i.exec(second ?? "")?.[0] ?? "";
  const values = [/[a-zµ"]\s*$/i.test(first) ? first : first + unit, second].map((each) =>
    quantity(each, "mm"),
  );
  return values.includes(null) ? null : values;
}

/** Write a number with no more decimals than its step has. */
export function rounded(value, step) {
  const decimals = Math.max(0, Math.min(6, (String(step).split(".")[1] ?? "").length));
  return String(Number(value.toFixed(decimals)));
}

/** Write seconds for a person: "42 s", "3 min 05 s", "1 h 24 min". */
export function clock(seconds) {
  const whole = Math.round(seconds);
  if (whole < 60) return `${whole} s`;
  const two = (number) => String(number).padStart(2, "0");
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${two(whole % 60)} s`;
  return `${Math.floor(whole / 3600)} h ${two(Math.floor((whole % 3600) / 60))} min`;
}

/** Write a length in mm with a true minus sign. */
export function millimetres(value, decimals = 2) {
  return `${value.toFixed(decimals).replace("-", "−")} mm`;
}
