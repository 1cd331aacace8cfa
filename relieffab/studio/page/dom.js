// Elements by code, and those of the page by name.

/** Return the page's element of that id. */
export function byId(id) {
  return document.getElementById(id);
}

/** Make an element: attributes, listeners (`onclick`), then children or texts. */
export function el(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Whether keys pressed now are being typed into something. */
export function isTyping(event) {
  const { tagName, type } = event.target;
  return tagName === "TEXTAREA" || (tagName === "INPUT" && type !== "range" && type !== "checkbox");
}

/** Read a colour of the style sheet, such as `--paper`. */
export function colourOf(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
