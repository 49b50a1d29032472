// Elements, made without markup: a word can never become an element.

import { brief } from "./texts.js";

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

/** Put these in the place of an element's children. The focus stays on the one with the
 *  same `data-key` as the one that has it. */
export function renewChildren(parent, ...children) {
  const focused = document.activeElement;
  const key = parent.contains(focused) ? focused.dataset.key : undefined;
  parent.replaceChildren(...children);
  if (key) [...parent.querySelectorAll("[data-key]")].find((it) => it.dataset.key === key)?.focus();
}

/** Do what takes an element away, or disables it. If that has the focus of the keyboard,
 *  it goes to the field; on a phone no keyboard comes up for it. */
export function keepFocus(element, change) {
  const held = element.contains(document.activeElement) && document.activeElement.matches(":focus-visible");
  change();
  if (held && (element.disabled || !element.contains(document.activeElement))) byId("text").focus();
}

/** A bar as long as a degree. */
export function bar(degree) {
  const filled = el("i");
  filled.style.width = `${Math.round(degree * 100)}%`;
  return el("span", { class: "degree" }, filled);
}

/** What the robot's library has drawn, which has no script and escapes every word. Long
 *  numbers are rounded; the pointer shows all their digits. */
export function matrix(html) {
  const parsed = new DOMParser().parseFromString(html, "text/html");
  const made = document.adoptNode(parsed.body.firstElementChild);
  made.tabIndex = 0; // so that keys scroll what is wide
  const texts = document.createTreeWalker(made, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const text = texts.currentNode;
    const short = brief(text.data);
    if (short === text.data) continue;
    text.parentElement.title = text.data.trim();
    text.data = short;
  }
  return made;
}
