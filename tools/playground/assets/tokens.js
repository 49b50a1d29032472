// The words and signs of the notation, as the editor colours them.
import { KEYWORDS, LETTER, LETTER_OR_DIGIT, RESERVED } from "./vocabulary.js";

const keywords = new Set([...KEYWORDS, "acts", "on", "not", "error", "unknown"]);
const reserved = new Set(RESERVED);
const WORDS = new RegExp(
  [
    String.raw`(?<comment>#[^\n]*)`,
    String.raw`(?<quoted>"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*"|'[^'\\\n]*(?:\\[^\n][^'\\\n]*)*')`,
    `(?<name>[${LETTER}][${LETTER_OR_DIGIT}]*)`,
    String.raw`(?<number>[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)`,
    String.raw`(?<sign>:=|<:|<=|->|/\\|\\/|\|\||[^\s])`,
  ].join("|"),
  "g",
);

/** The words and signs, each with its kind, start and end. */
export function tokens(text) {
  return [...text.matchAll(WORDS)].map((found) => {
    const kind = Object.keys(found.groups).find((it) => found.groups[it] !== undefined);
    return { kind, start: found.index, end: found.index + found[0].length };
  });
}

/** The class of colour of a word. */
export function colour(kind, word) {
  if (kind !== "name") return kind;
  if (keywords.has(word)) return "keyword";
  if (reserved.has(word)) return "reserved";
  return /^\p{Lu}/u.test(word) ? "type" : "name";
}
