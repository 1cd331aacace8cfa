// What the studio tells by itself, as long as the page lives.

/** Hear facts by their names; of those that nobody hears, nothing comes. */
export function listen(hear) {
  new EventSource("events").addEventListener("message", ({ data }) => {
    for (const [name, fact] of Object.entries(JSON.parse(data))) hear[name]?.(fact);
  });
}
