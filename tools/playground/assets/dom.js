// Elements, made without markup: a word can never become an element.

export function el(name, properties = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key === "class") made.className = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((it) => it !== null && it !== undefined && it !== ""));
  return made;
}

export const byId = (id) => document.getElementById(id);

/** A value drawn by ttr, which has escaped all words in it. */
export function drawn(html) {
  const made = el("div", { class: "drawn", tabindex: "0" });
  made.innerHTML = html;
  return made;
}
