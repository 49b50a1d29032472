// Elements, made without markup: a word can never become an element.

/** An element with properties, attributes and children; texts stay texts. */
export function el(name, properties = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key === "class") made.className = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((it) => it !== null && it !== undefined));
  return made;
}

export function svg(name, attributes = {}) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

export const byId = (id) => document.getElementById(id);

/** A bar as long as a degree. */
export function bar(degree) {
  const filled = el("i");
  filled.style.width = `${Math.round(degree * 100)}%`;
  return el("span", { class: "degree" }, filled);
}

/** What the robot's library has drawn, which has no script and escapes every word. */
export function matrix(html) {
  const parsed = new DOMParser().parseFromString(html, "text/html");
  const made = document.adoptNode(parsed.body.firstElementChild);
  made.tabIndex = 0; // so that keys scroll what is wide
  return made;
}
