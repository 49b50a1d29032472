// A theory as a link: raw DEFLATE in base64url, as tools/playground/links.py has it.
import { LONGEST_FRAGMENT, LONGEST_TEXT } from "./vocabulary.js";

const TOO_LONG = "The theory is too long for a link: send it as a file.";
const DAMAGED = "The link is damaged or too long: no theory can be read from it.";

export async function fragmentOf(text) {
  const said = new TextEncoder().encode(text);
  const packed = await read(new Blob([said]).stream().pipeThrough(new CompressionStream("deflate-raw")), Infinity);
  const letters = btoa(Array.from(packed, (it) => String.fromCharCode(it)).join(""));
  const fragment = `t=${letters.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
  if (said.length > LONGEST_TEXT || fragment.length > LONGEST_FRAGMENT) throw new Error(TOO_LONG);
  return fragment;
}

export async function textOf(fragment) {
  if (!fragment.startsWith("t=") || fragment.length > LONGEST_FRAGMENT) throw new Error(DAMAGED);
  try {
    const letters = atob(fragment.slice(2).replaceAll("-", "+").replaceAll("_", "/"));
    const packed = Uint8Array.from(letters, (it) => it.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new TextDecoder("utf-8", { fatal: true }).decode(await read(stream, LONGEST_TEXT));
  } catch {
    throw new Error(DAMAGED);
  }
}

/** All bytes of a stream, which may not have more than this. */
async function read(stream, most) {
  const parts = [];
  let size = 0;
  for (const reader = stream.getReader(); ; ) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) {
      await reader.cancel();
      throw new Error(DAMAGED);
    }
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}
